#pragma once
#include <detent/asset.h>
#include <detent/detail/state.h>
#include <detent/features.h>
#include <detent/status.h>

#include "math/root.h"
#include "shape/body.h"
#include "shape/hull.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The greatest inverse inertia per unit mass. With this limit, sqrt(I / m) about any axis is at least 2^-7.5 of the
/// body's unit of length: 5.5 mm for a rod of 1.6 m. For a thinner body, an impulse far off its axis would change the
/// angular velocity so much that the sum of two bodies' changes would leave the range of Real.
inline constexpr Scaled k_inverse_inertia_max = 0x1p15;

/// The least size_exponent of a body.
inline constexpr int k_size_exponent_min = -14;

/// The greatest distance of a point of the shape from its origin, m.
inline Real bounding_radius_of(const BodyProperties& properties) {
  return real_from_unit(properties.bounding_radius, properties.size_exponent);
}

/// The greatest distance from the origin to a point of a sphere or capsule, or to a point of the core of a box,
/// cylinder or cone; 0 for other shapes. `size`: as BodyProperties::size. T: Real or Unit, for the sizes and the
/// result.
template <class T>
T core_bound(ShapeType type, const Vec3<T>& size) {
  const T zero = 0.0;
  switch (type) {
    case ShapeType::sphere:
      return size.x;
    case ShapeType::capsule:
      return size.x + size.y;
    case ShapeType::box:
    case ShapeType::cylinder:
      return length(size);
    case ShapeType::cone: {
      const T base = scale_by_power(size.y, -1);
      return max(length(Vec3<T>{size.x, base, zero}), size.y + base);
    }
    default:
      return zero;
  }
}

/// The greatest |x|, |y| and |z| of the vertices, in the unit 2^exponent m, which is at least the hull's own.
Vec3<Unit> hull_half_extents(const HullView& hull, int32_t exponent);
/// The hull's core radius, in the unit 2^exponent m.
Unit hull_radius(const HullView& hull, int32_t exponent);

/// Sizes derived from a shape, m.
struct ShapeMeasure {
  Vec3<Real> size;       ///< as BodyProperties::size; of a hull: 0
  Real smallest;         ///< the least of its sizes and its rounding
  Real bound;            ///< the greatest distance from the origin to a point of the shape without Shape::rounding
  int32_t exponent_min;  ///< lower limit of size_exponent: of a hull or compound, the exponent of its asset
  Real thickness = 0.0;  ///< of a compound: the half thickness, kept in BodyProperties::rounding
};

/// The shape-specific parts of set_shape_properties(), shape_volume() and set_inverse_inertia(). The linker keeps only
/// the shapes that a feature table refers to.
struct ShapeOps {
  Status (*measure)(const Shape& shape, const AssetTable& assets, ShapeMeasure& measure);
  void (*set_size)(const Shape& shape, const AssetTable& assets,
                   BodyProperties& properties);  ///< null: `measure` suffices
  Scaled (*volume)(const BodyProperties& properties, const Vec3<Scaled>& sizes,
                   const AssetTable& assets);  ///< null: volume 0
  void (*set_inverse_inertia)(BodyProperties& properties, const Vec3<Scaled>& squares, const AssetTable& assets);
};

/// The functions of a shape type; null if the feature table lacks the shape.
const ShapeOps* ops_of(const FeatureTable& features, ShapeType type);

/// Fills shape, size_exponent, size, bounding_radius, rounding and asset of `properties`. A hull, terrain or compound
/// is taken from the asset table; read_hull(), read_terrain() or read_compound() must have accepted its bytes. Errors:
/// bad_argument, out_of_range, asset_missing, feature_missing.
Status set_shape_properties(const Shape& shape, BodyProperties& properties, const AssetTable& assets = {},
                            const FeatureTable& features = feature_table<Features::all>);

/// Volume of the shape, m^3. Relative error below 2^-26. 0 for half-spaces and terrain. A rounded shape is treated as a
/// sharp shape whose sizes are greater by the rounding; a hull is stretched so that its half extents grow by the
/// rounding.
Scaled shape_volume(const BodyProperties& properties, const AssetTable& assets = {},
                    const FeatureTable& features = feature_table<Features::all>);

/// Sets the inverse inertia (per unit mass), m (2^size_exponent)^2 / I, about the body's axes for uniform density. It
/// depends on the sizes of the shape, relative to the unit of length, but not on the mass. It is 0 about a locked axis,
/// and at most k_inverse_inertia_max. Changes nothing for a half-space or a terrain.
/// Relative error below 2^-24; for a hull or a compound, that of the values in its file. Rounded shapes are treated as
/// in shape_volume().
/// Source: the standard moments of the box, ball, cylinder, cone and half-ball.
void set_inverse_inertia(BodyProperties& properties, const AssetTable& assets = {},
                         const FeatureTable& features = feature_table<Features::all>);

/// Smallest diameter of the shape, m; the tolerances of a pair are fractions of it. Half-spaces and terrain: 2^14.
/// Cone: the lesser of height and base diameter, up to 12 % too large. Hull: twice the least half extent, up to 50 %
/// too large. Compound: the smallest diameter of its thinnest child.
Real shape_extent(const BodyProperties& properties);
/// Radius of the shape's round parts, in the body's unit of length. Ball, capsule and cylinder: the radius. Box, cone
/// and hull: the rounding. Other shapes: 0.
Unit round_radius(const BodyProperties& properties);
/// The length, m, of which the margin of the shape's bounds is a fraction: shape_extent(), or 2^-8 of the bounding
/// radius for a terrain.
Real bounds_extent(const BodyProperties& properties);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
