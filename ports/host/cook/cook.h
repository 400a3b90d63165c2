#pragma once
#include <stdint.h>

#include <array>
#include <string>
#include <vector>

/// Cooking: converts a cloud of points to the bytes of a `.hull` (docs/hull.md). Cooking runs on the host, which has
/// floating point and allocation. It gives the same bytes on every host, because it computes only with integers and
/// with +, -, *, / and sqrt of doubles.
namespace detent_cook {

using Point = std::array<double, 3>;  ///< m

enum class Frame {
  principal,  ///< a body's frame: the origin is the centre of mass, the axes are the principal axes
  source,     ///< the frame of the source points: for queries; in a compound, the body's frame
};

struct CookOptions {
  Frame frame = Frame::principal;
  /// m; a point this near to a kept point is left out. 0: only equal points are left out.
  double weld = 0;
  uint32_t vertex_limit = 255;  ///< 4 to 255
  /// What happens to a hull of more than vertex_limit vertices. true: it is reduced to the limit (CookResult::error);
  /// false: it is refused.
  bool reduce = true;
};

struct CookResult {
  std::vector<uint8_t> bytes{};  ///< of the .hull; empty if refused
  std::string reason{};          ///< why it is refused, in one line; empty if not
  uint32_t vertex_count = 0, face_count = 0, edge_count = 0;
  int32_t exponent = 0;                           ///< of the unit of length, 2^exponent m
  bool reduced = false;                           ///< the hull was reduced to the vertex limit
  double volume = 0;                              ///< m^3; relative error below 2^-44 for the stored vertices
  Point centre{};                                 ///< m; centre of mass in the source frame
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w: from the body to the source frame
  /// Inverse inertia per unit mass, unit^2 / (I / m), about each axis; 0 in the source frame.
  std::array<double, 3> inverse_inertia{};
  double width = 0;  ///< m; an upper bound of the width, at most a few times the width
  double error = 0;  ///< m; no point of the cloud lies further than this above any face's plane
};

/// Cooks the convex hull of the points, or gives the reason why it is refused: fewer than four points, a coordinate
/// that is not a number or beyond 2^31 m, all points equal, on a line or in a plane, a thickness below 2^-24 of the
/// size, a size outside [2^-15, 2^15] m, too many vertices. The result does not depend on the order of the points or on
/// repeated points.
///
/// Precision: a *step* is 2^-30 of the unit of length. A vertex is a point of the cloud, rounded in the body's frame to
/// the nearest step. Points less than a step outside the hull of the other points may be left out. The centre of mass
/// lies within a step of the body's origin, if the origin's doubles are precise enough. Each product of inertia is
/// below 2^-22 of the geometric mean of its two moments, or the axes are within 2^-29 rad. The faces are flat within
/// 2^-20 of the unit and within 2^-10 of the width, or within four steps.
CookResult cook_hull(const std::vector<Point>& points, const CookOptions& options = {});

}  // namespace detent_cook
