#pragma once
#include "tests/common/oracle/convex_solid.h"

/// The distance and the depth of two convex solids, with a certificate.
///
/// What is certified, and how. Every figure is an upper or a lower bound by itself, whatever path found it:
/// - `distance` is that of two points of the cores, given with it (convex combinations of support points): the true
///   core distance is not above it.
/// - `separation` is n.offset + min over B of n.b - max over A of n.a for the unit axis n: the plain separating axis,
///   from support points alone. The true core distance is not below it; if negative, the depth is not above its
///   negative.
/// - `depth_floor`: a closed surface of triangles in the Minkowski difference winds around the origin, and no plane of
///   theirs, less the error of its normal, is nearer than this: the depth is not below it. (The surface begins with a
///   tetrahedron and grows by tetrahedra, whose orientations are larger than their rounding errors.)
/// All hold to the rounding of a handful of `long double` operations on the coordinates, rounding_of().
///
/// The search is GJK, then, where cores overlap, the expanding polytope. It runs in `long double`, and if upper and
/// lower bound stay apart, again in __float128 where there is one. What the cores are, apart or overlapped, is what the
/// bounds say: nearer than rounding_of() both answers are right, and `gap` is continuous between them.
/// A depth is only sought to k_depth_relative of itself (polytopes end at the exact one), so that it is sharp where it
/// matters, at contact; `gap` then is minus the depth's upper bound, of all axes tried.
namespace detent_oracle {

constexpr Number k_depth_relative = 1e-6L;

struct Separation {
  bool overlap = false;    ///< the cores
  Number distance = 0;     ///< m, of the cores' points below: upper bound; 0 if they overlap
  Number separation = 0;   ///< m, of the cores along `axis`: lower bound; minus the depth's upper bound if they overlap
  Number depth_floor = 0;  ///< m, lower bound of the depth if they overlap
  Number gap = 0;  ///< m, of the rounded solids: distance less both roundings; minus depth and roundings if overlapped
  Number gap_floor = 0;    ///< m, the gap's lower bound
  Number slack = 0;        ///< m, upper less lower bound
  Arrow axis = {};         ///< unit, from A to B, world axes
  Arrow point_a = {};      ///< on A's core, from A's position, m, world axes; if they overlap of no meaning
  Arrow point_b = {};      ///< on B's core, from B's position, m, world axes; if they overlap of no meaning
  int iterations = 0;      ///< support points asked for
  bool quadruple = false;  ///< long double did not decide
};

/// How narrow the bounds shall be: absolute, m, or a part of the gap, whichever is wider.
struct Accuracy {
  Number absolute = 0;  ///< 0: rounding_of() or 1e-16 of the size, the best that is meaningful
  Number relative = 0;
};

/// The rounding errors' bound of one separating axis, m.
Number rounding_of(const ConvexSolid& a, const ConvexSolid& b, const Arrow& offset);

/// The separation of the cores along a unit axis (half-spaces: along their own normal only), m.
Number separation_along(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement, const Arrow& axis);

/// The least distance or depth. `hint` is an axis to start from, of any length; zero for none.
Separation separation_of(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement,
                         const Accuracy& accuracy = {}, const Arrow& hint = {0, 0, 0});

/// The same at the start of a query.
Separation separation_of(const detent_queries::Query& query);

}  // namespace detent_oracle
