#pragma once
#include <vector>

#include "tests/common/queries/random.h"

/// Shapes drawn for queries. Every number of theirs is a float.
namespace detent_queries {

/// What a set draws from. Hulls are points on an ellipsoid or prisms.
enum class Drawn { sphere, capsule, box, ellipsoid, prism, cylinder, cone };

/// Greatest distance of a point of the solid from its origin, m.
double bound_of(const Solid& solid);

/// That of its core: without the ball that rounds it; of a sphere 0.
double core_bound_of(const Solid& solid);

/// The larger of the two core extents, m; of two spheres the larger diameter.
double size_of(const Query& query);

/// A box, a hull or a triangle that no ball rounds.
bool is_polytope(const Solid& solid);
/// The vertices of a polytope, m.
std::vector<Triple> vertices_of(const Solid& solid);

/// Grown by a ball. For a solid that is not a sphere or capsule.
Solid rounded(Solid solid, double rounding);

Solid sphere(double radius);
Solid capsule(double radius, double half_length);
Solid box(const Triple& half_extents);
Solid cylinder(double radius, double half_length);
Solid cone(double radius, double half_length);
/// `count` points spread on an ellipsoid.
Solid ellipsoid_hull(Random& random, const Triple& semi_axes, uint32_t count);
/// In the plane z = 0, about its centroid. `side` is the longest, `height` is over it: at most sqrt(3)/2 of it.
Solid triangle(Random& random, double side, double height);
/// Along y, its sides' corners on a circle (scaled by `flat` in z).
Solid prism(double radius, double half_length, uint32_t sides, double flat = 1);

/// A solid `extent` long, its smallest width at least a fifth of that.
Solid draw(Random& random, Drawn kind, double extent);
/// One of the kinds, `extent_min` to `extent_max` long.
Solid draw(Random& random, const std::vector<Drawn>& kinds, double extent_min, double extent_max);
/// `size` long in one direction (needle) or two (plate), `size` times `aspect` in the others.
Solid draw_thin(Random& random, bool needle, double size, double aspect);
/// Along y: a capsule, a box or a prism; with `round` also a cylinder or a long cone.
Solid draw_rod(Random& random, double rod_length, double thickness, bool round);

}  // namespace detent_queries
