#pragma once
#include <detent/detail/state.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Fills shape, size_exponent, size and bounding_radius of `traits`. Errors: bad_argument, out_of_range.
Status set_shape(const Shape& shape, BodyTraits& traits);

/// Volume of the shape, m^3. Relative error below 2^-26. 0 for a half-space.
Scaled shape_volume(const BodyTraits& traits);

/// m (2^size_exponent)^2 / I about the body's axes, for uniform density: it does not depend on mass or scale.
/// Relative error below 2^-24. Source: the standard moments of the box, ball, cylinder and half-ball.
void set_gyration(BodyTraits& traits);

/// Smallest diameter of the shape, m; what tolerances of a pair are fractions of. 2^14 for a half-space.
Real shape_extent(const BodyTraits& traits);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
