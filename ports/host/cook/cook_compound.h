#pragma once
#include <string_view>

#include "cook.h"

namespace detent_cook {

/// A convex part of a compound.
struct CompoundPart {
  enum class Kind { ball, capsule, hull };
  Kind kind = Kind::hull;
  std::vector<Point> points{};  ///< m: a ball's centre, a capsule's two ends, or the cloud that a hull is of
  double radius = 0;            ///< m; of a hull that of the ball that rounds it, or 0
  double density = 1;           ///< as a multiple of the body's
};

struct CompoundResult {
  std::vector<uint8_t> bytes{};  ///< of the .compound; empty if it is refused
  std::string reason{};          ///< why it is refused: one line
};

/// A compound of 1 to 64 parts, or the reason why there is none: a part that cook_hull() refuses, a radius or density
/// that is no positive number, a size outside [2^-15, 2^15] m.
///
/// Mass: parts are taken as apart, so what two of them share counts twice. A rounded hull counts as its points grown by
/// a cube of half the size `radius` in the axes of the source, as boxes along them do everywhere. Volume and gyration
/// err by less than 2^-28; products of inertia as in cook_hull(). In the source frame the body's centre of mass is the
/// origin of the points, and its gyration that of the parts about their axes, without the products.
CompoundResult cook_compound(const std::vector<CompoundPart>& parts, Frame frame = Frame::principal);

/// The corners of a box about `centre`, turned by the quaternion x, y, z, w of any length but 0.
std::vector<Point> box_points(const Point& centre, const Point& half, const std::array<double, 4>& rotation);

struct CompoundRead {
  std::vector<CompoundPart> parts{};
  std::string problem{};  ///< one line, with the line's number where there is one; empty if all is well
};

/// A Wavefront OBJ with lines of our own (docs/compound.md): the faces of each group, object or file without either are
/// a hull; `ball`, `capsule` and `box` lines are parts each.
CompoundRead read_compound_text(std::string_view text);

}  // namespace detent_cook
