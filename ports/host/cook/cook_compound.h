#pragma once
#include <string_view>

#include "cook.h"

namespace detent_cook {

/// A convex part of a compound.
struct CompoundPart {
  enum class Kind { ball, capsule, hull };
  Kind kind = Kind::hull;
  std::vector<Point> points{};  ///< m: a ball's centre, a capsule's two ends, or a hull's points
  double radius = 0;            ///< m; for a hull the radius of the ball that rounds it, or 0
  double density = 1;           ///< multiple of the body's density
};

struct CompoundResult {
  std::vector<uint8_t> bytes{};  ///< of the .compound; empty if refused
  std::string reason{};          ///< why it is refused, in one line; empty if not
};

/// Cooks a compound of 1 to 64 parts, or gives the reason why it is refused: a part that cook_hull() refuses, a radius
/// or a size outside [2^-15, 2^15] m (a hull may have the radius 0), a density outside [2^-20, 2^20] times the body's.
///
/// Mass: each part counts in full, so the common volume of two parts counts twice. A rounded hull counts as the hull of
/// its points, each replaced by a cube of half side `radius` along the axes of the source, as for boxes elsewhere.
/// Volume and inverse inertia have a relative error below 2^-28; products of inertia are as in cook_hull(). With
/// Frame::source, the body's centre of mass is the origin of the points, and its inertia is that of the parts about the
/// axes of the source, without the products of inertia.
CompoundResult cook_compound(const std::vector<CompoundPart>& parts, Frame frame = Frame::principal);

/// The corners of a box about `centre`. `rotation`: a quaternion x, y, z, w of any length but 0.
std::vector<Point> box_points(const Point& centre, const Point& half, const std::array<double, 4>& rotation);

struct CompoundRead {
  std::vector<CompoundPart> parts{};
  std::string problem{};  ///< one line, with the line number if known; empty if there is none
};

/// Reads a Wavefront OBJ with additional lines (docs/compound.md). The faces of each group, of each object, or of a
/// file without either form a hull. Each `ball`, `capsule` or `box` line is a part.
CompoundRead read_compound_text(std::string_view text);

}  // namespace detent_cook
