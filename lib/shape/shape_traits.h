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

/// A body's radius of gyration about an axis counts as at least 2^-7.5 of its unit: 5.5 mm of a rod of 1.6 m. What an
/// impulse far off a thinner one's axis does to its spin would leave a Real's range, for two bodies at once.
inline constexpr Scaled k_gyration_max = 0x1p15;

/// Of any unit of length.
inline constexpr int k_size_exponent_min = -14;

/// Of all of the shape from its origin, m.
inline Real bounding_radius_of(const BodyTraits& traits) {
  return real_from_unit(traits.bounding_radius, traits.size_exponent);
}

/// The greatest distance of a point of the core from the origin; not for hulls, surfaces and compounds. T: Real or
/// Unit, of both sides.
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

/// What a shape's sizes come to, m.
struct ShapeMeasure {
  Vec3<Real> size;  ///< as BodyTraits::size
  Real smallest;    ///< of its sizes, and of the rounding
  Real bound;       ///< the greatest distance of a point of the core from the origin
  int32_t exponent_min;
  Real thickness = 0.0;  ///< of a compound: BodyTraits::rounding
};

/// One shape's own part of set_shape_traits(), shape_volume() and set_gyration(): the linker keeps those that a table
/// names.
struct ShapeOps {
  Status (*measure)(const Shape& shape, const AssetTable& assets, ShapeMeasure& measure);
  void (*set_size)(const Shape& shape, const AssetTable& assets, BodyTraits& traits);  ///< null: from the measure
  Scaled (*volume)(const BodyTraits& traits, const Vec3<Scaled>& sizes, const AssetTable& assets);  ///< null: none
  void (*set_gyration)(BodyTraits& traits, const Vec3<Scaled>& squares, const AssetTable& assets);
};

/// Null if the shape is not linked.
const ShapeOps* ops_of(const FeatureTable& features, ShapeType type);

/// Fills shape, size_exponent, size, bounding_radius, rounding and asset of `traits`. A hull, surface or
/// compound is that of the table, whose bytes read_hull(), read_surface() or read_compound() has accepted. Errors:
/// bad_argument, out_of_range, asset_missing, feature_missing.
Status set_shape_traits(const Shape& shape, BodyTraits& traits, const AssetTable& assets = {},
                        const FeatureTable& features = feature_table<Features::all>);

/// Volume of the shape, m^3. Relative error below 2^-26. 0 for half-spaces and surfaces. A rounded shape counts as the
/// sharp one whose sizes (of a hull: half extents, by which it is stretched) are greater by the rounding.
Scaled shape_volume(const BodyTraits& traits, const AssetTable& assets = {},
                    const FeatureTable& features = feature_table<Features::all>);

/// m (2^size_exponent)^2 / I about the body's axes, for uniform density: it does not depend on mass or scale. 0 about a
/// locked axis.
/// Relative error below 2^-24; a hull's is its file's. Rounded shapes as in shape_volume().
/// Source: the standard moments of the box, ball, cylinder, cone and half-ball.
void set_gyration(BodyTraits& traits, const AssetTable& assets = {},
                  const FeatureTable& features = feature_table<Features::all>);

/// Smallest diameter of the shape, m; what tolerances of a pair are fractions of. 2^14 for half-spaces and surfaces. Of
/// a cone the lesser of height and base, up to 12 % too much; of a hull twice the least half extent, up to 50 %; of a
/// compound that of its thinnest child.
Real shape_extent(const BodyTraits& traits);
/// Of what is round about it, in the body's unit of length: of a ball, capsule or cylinder the radius, of others their
/// rounding.
Unit round_radius(const BodyTraits& traits);
/// What the margins of the shape's bounds are parts of, m: its extent; of a surface 2^-8 of its bounding radius.
Real bounds_extent(const BodyTraits& traits);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
