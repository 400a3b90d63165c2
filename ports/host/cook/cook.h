#pragma once
#include <stdint.h>

#include <array>
#include <string>
#include <vector>

/// Cooking: from a cloud of points to the bytes of a `.hull` (docs/hull.md). On the host, where floating point and
/// allocation are at hand; the same bytes on every host, for it computes with integers and with +, -, *, / and sqrt of
/// doubles alone.
namespace detent_cook {

using Point = std::array<double, 3>;  ///< m

enum class Frame {
  principal,  ///< of a body: origin at the centre of mass, principal axes
  source,     ///< origin and axes of the points: for queries; of a compound, the body's
};

struct CookOptions {
  Frame frame = Frame::principal;
  double weld = 0;              ///< m; a point this near to another one that is kept is left out. 0: only equal points
  uint32_t vertex_limit = 255;  ///< 4 to 255
  bool reduce = true;           ///< a hull of more vertices is reduced to the limit, with `error`; else refused
};

struct CookResult {
  std::vector<uint8_t> bytes{};  ///< of the .hull; empty if it is refused
  std::string reason{};          ///< why it is refused: one line
  uint32_t vertex_count = 0, face_count = 0, edge_count = 0;
  int32_t exponent = 0;  ///< of the unit of length, 2^exponent m
  bool reduced = false;  ///< to the vertex limit
  double volume = 0;     ///< m^3; relative error below 2^-44 for the vertices as they are stored
  Point centre{};        ///< m; of mass, in the source frame
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w: from the body to the source frame
  std::array<double, 3> gyration{};               ///< unit^2 / (I / m) about each axis; 0 in the source frame
  double width = 0;                               ///< m; at least the width, at most a few times it
  double error = 0;  ///< m; no point of the cloud lies further than this above any face's plane
};

/// The convex hull of the points, or the reason why there is none: fewer than four points, a coordinate that is no
/// number or beyond 2^31 m, all points equal, on a line or in a plane, a thickness below 2^-24 of the size, a size
/// outside [2^-15, 2^15] m, too many vertices. Neither the points' order nor equal points matter.
///
/// Precision: a vertex is a point of the cloud, rounded to nearest in the body's frame, 2^-30 of the unit a step.
/// Points less than a step outside the hull of the others may be left out. The centre of mass lies within a step of the
/// body's origin, if the origin's doubles allow; the products of inertia are below 2^-22 of the geometric mean of their
/// moments, or the axes within 2^-29 rad. The faces are flat within 2^-20 of the unit and within 2^-10 of the width, or
/// four steps.
CookResult cook_hull(const std::vector<Point>& points, const CookOptions& options = {});

}  // namespace detent_cook
