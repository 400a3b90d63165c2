#include "shape/shape_properties.h"

#include "math/arithmetic.h"
#include "math/root.h"
#include "math/scaled.h"
#include "shape/compound.h"
#include "shape/terrain.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_size_min = 0x1p-14;
constexpr Real k_size_max = 0x1p14;
constexpr Real k_bound_limit = 0x1p15;
constexpr Scaled k_scaled_pi = 3.14159265358979323846;

bool is_size(Real value) { return value >= k_size_min && value <= k_size_max; }

/// Whether a body can have this shape. A body cannot be a triangle.
bool is_world_shape(ShapeType type) {
  return (type >= ShapeType::sphere && type <= ShapeType::hull) || type == ShapeType::terrain ||
         type == ShapeType::compound;
}

bool can_be_rounded(ShapeType type) {
  return type == ShapeType::box || type == ShapeType::cylinder || type == ShapeType::cone || type == ShapeType::hull;
}

HullView hull_of(const AssetTable& assets, uint32_t asset) { return hull_view(assets.assets[asset].bytes); }

Unit unit_from_steps(int32_t steps) {
#if DETENT_FIXED
  return Unit::from_raw(steps);
#else
  return float_from_integer<Unit>(steps, -30);
#endif
}

Scaled scaled_from_hull(const HullScaled& value) {
#if DETENT_FIXED
  return Scaled::from_parts(value.mantissa, value.exponent);
#else
  return float_from_integer<Scaled>(value.mantissa, value.exponent);
#endif
}

Scaled square(Scaled value) { return multiply(value, value); }

/// Returns `size`, a size of the core, plus the rounding of the shape, in the body's unit of length.
Scaled grown(const BodyProperties& properties, Unit size) {
  const Scaled sharp = scaled_from(size);
  return properties.rounding == Unit(0.0) ? sharp : add(sharp, scaled_from(properties.rounding));
}

/// Moments of inertia of a capsule divided by m unit^2, about its axis and across it.
void capsule_moments(Unit radius, Unit half_length, Scaled& along, Scaled& across) {
  const Scaled r = scaled_from(radius);
  const Scaled l = scaled_from(half_length);
  const Scaled rr = multiply(r, r);
  const Scaled ll = multiply(l, l);
  const Scaled total = add(multiply(Scaled(3.0), l), multiply(Scaled(2.0), r));
  const Scaled cylinder = divide(multiply(Scaled(3.0), l), total);  // fraction of the mass
  const Scaled balls = divide(multiply(Scaled(2.0), r), total);
  along = multiply(rr, add(multiply(Scaled(0.5), cylinder), multiply(Scaled(0.4), balls)));
  const Scaled cylinder_across = add(multiply(Scaled(0.25), rr), divide(ll, Scaled(3.0)));
  const Scaled balls_across = add(add(multiply(Scaled(0.4), rr), ll), multiply(Scaled(0.75), multiply(r, l)));
  across = add(multiply(cylinder, cylinder_across), multiply(balls, balls_across));
}

}  // namespace

Vec3<Unit> hull_half_extents(const HullView& hull, int32_t exponent) {
  int32_t most[3] = {0, 0, 0};
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const int32_t vertex[3] = {hull.x(i), hull.y(i), hull.z(i)};
    for (int axis = 0; axis < 3; ++axis) {
      const int32_t far = vertex[axis] < 0 ? -vertex[axis] : vertex[axis];
      most[axis] = far > most[axis] ? far : most[axis];
    }
  }
  const int power = hull.exponent() - exponent;
  return {scale_by_power(unit_from_steps(most[0]), power), scale_by_power(unit_from_steps(most[1]), power),
          scale_by_power(unit_from_steps(most[2]), power)};
}

Unit hull_radius(const HullView& hull, int32_t exponent) {
  return scale_by_power(unit_from_steps(hull.core_radius()), hull.exponent() - exponent);
}

namespace {

using Sizes = Vec3<Scaled>;

Sizes grown_sizes(const BodyProperties& properties) {
  return {grown(properties, properties.size.x), grown(properties, properties.size.y),
          grown(properties, properties.size.z)};
}
Sizes squares_of(const Sizes& sizes) { return {square(sizes.x), square(sizes.y), square(sizes.z)}; }

Status measure_sphere(const Shape& shape, const AssetTable&, ShapeMeasure& measure) {
  if (!is_size(shape.radius)) return Status::out_of_range;
  measure.size.x = measure.bound = shape.radius;
  return Status::ok;
}
Scaled sphere_volume(const BodyProperties&, const Sizes& size, const AssetTable&) {
  return multiply(multiply(k_scaled_pi, Scaled(4.0 / 3.0)), multiply(size.x, multiply(size.x, size.x)));
}
void set_sphere_inverse_inertia(BodyProperties& properties, const Sizes& squares, const AssetTable&) {
  properties.inverse_inertia[0] = properties.inverse_inertia[1] = properties.inverse_inertia[2] =
      divide(Scaled(2.5), squares.x);
}

Status measure_capsule(const Shape& shape, const AssetTable&, ShapeMeasure& measure) {
  const Real zero = 0.0;
  if (!is_size(shape.radius) || !(shape.half_length >= zero && shape.half_length <= k_size_max)) {
    return Status::out_of_range;
  }
  measure.size = {shape.radius, shape.half_length, zero};
  measure.smallest = shape.radius;
  measure.bound = core_bound(ShapeType::capsule, measure.size);
  return Status::ok;
}
Scaled capsule_volume(const BodyProperties&, const Sizes& size, const AssetTable&) {
  const Scaled &x = size.x, &y = size.y;
  return multiply(multiply(k_scaled_pi, multiply(x, x)), add(multiply(Scaled(2.0), y), multiply(Scaled(4.0 / 3.0), x)));
}
void set_capsule_inverse_inertia(BodyProperties& properties, const Sizes&, const AssetTable&) {
  Scaled along, across;
  capsule_moments(properties.size.x, properties.size.y, along, across);
  properties.inverse_inertia[0] = properties.inverse_inertia[2] = divide(Scaled(1.0), across);
  properties.inverse_inertia[1] = divide(Scaled(1.0), along);
}

Status measure_box(const Shape& shape, const AssetTable&, ShapeMeasure& measure) {
  const Vec3<Real>& size = measure.size = shape.half_extents;
  if (!is_size(size.x) || !is_size(size.y) || !is_size(size.z)) return Status::out_of_range;
  measure.smallest = min(measure.smallest, min(min(size.x, size.y), size.z));
  measure.bound = core_bound(ShapeType::box, size);
  return Status::ok;
}
Scaled box_volume(const BodyProperties&, const Sizes& size, const AssetTable&) {
  return multiply(Scaled(8.0), multiply(size.x, multiply(size.y, size.z)));
}
void set_box_inverse_inertia(BodyProperties& properties, const Sizes& squares, const AssetTable&) {
  properties.inverse_inertia[0] = divide(Scaled(3.0), add(squares.y, squares.z));
  properties.inverse_inertia[1] = divide(Scaled(3.0), add(squares.z, squares.x));
  properties.inverse_inertia[2] = divide(Scaled(3.0), add(squares.x, squares.y));
}

template <ShapeType type>
Status measure_upright(const Shape& shape, const AssetTable&, ShapeMeasure& measure) {
  if (!is_size(shape.radius) || !is_size(shape.half_length)) return Status::out_of_range;
  measure.size = {shape.radius, shape.half_length, Real(0.0)};
  measure.smallest = min(measure.smallest, min(shape.radius, shape.half_length));
  measure.bound = core_bound(type, measure.size);
  return Status::ok;
}
Scaled cylinder_volume(const BodyProperties&, const Sizes& size, const AssetTable&) {
  return multiply(multiply(k_scaled_pi, Scaled(2.0)), multiply(size.y, multiply(size.x, size.x)));
}
Scaled cone_volume(const BodyProperties&, const Sizes& size, const AssetTable&) {
  return multiply(multiply(k_scaled_pi, Scaled(2.0 / 3.0)), multiply(size.y, multiply(size.x, size.x)));
}
/// I / m = (3 r^2 + 4 h^2) / 12 across the axis and r^2 / 2 about it, for the height 2 h.
void set_cylinder_inverse_inertia(BodyProperties& properties, const Sizes& squares, const AssetTable&) {
  properties.inverse_inertia[0] = properties.inverse_inertia[2] =
      divide(Scaled(12.0), add(multiply(Scaled(3.0), squares.x), multiply(Scaled(4.0), squares.y)));
  properties.inverse_inertia[1] = divide(Scaled(2.0), squares.x);
}
/// I / m = 3 (r^2 + h^2) / 20 across the axis and 3 r^2 / 10 about it, for the height 2 h.
void set_cone_inverse_inertia(BodyProperties& properties, const Sizes& squares, const AssetTable&) {
  properties.inverse_inertia[0] = properties.inverse_inertia[2] = divide(Scaled(20.0 / 3.0), add(squares.x, squares.y));
  properties.inverse_inertia[1] = divide(Scaled(10.0 / 3.0), squares.x);
}

Status measure_hull(const Shape& shape, const AssetTable& assets, ShapeMeasure& measure) {
  if (!is_in(assets, shape.asset)) return Status::asset_missing;
  const HullView hull = hull_of(assets, shape.asset);
  const int32_t exponent = measure.exponent_min = hull.exponent();
  const Vec3<Unit> half = hull_half_extents(hull, exponent);
  measure.bound = real_from_unit(hull_radius(hull, exponent), exponent);
  measure.smallest = min(measure.smallest, real_from_unit(min(min(half.x, half.y), half.z), exponent));
  return Status::ok;
}
void set_hull_size(const Shape& shape, const AssetTable& assets, BodyProperties& properties) {
  properties.size = hull_half_extents(hull_of(assets, shape.asset), properties.size_exponent);
  properties.asset = shape.asset;
}
Scaled hull_volume(const BodyProperties& properties, const Sizes& size, const AssetTable& assets) {
  const HullView hull = hull_of(assets, properties.asset);
  Scaled volume = scaled_by_power(scaled_from_hull(hull.volume()), 3 * (hull.exponent() - properties.size_exponent));
  if (properties.rounding == Unit(0.0)) return volume;
  volume = multiply(volume, divide(size.x, scaled_from(properties.size.x)));
  volume = multiply(volume, divide(size.y, scaled_from(properties.size.y)));
  return multiply(volume, divide(size.z, scaled_from(properties.size.z)));
}
void set_hull_inverse_inertia(BodyProperties& properties, const Sizes& grown_squares, const AssetTable& assets) {
  const HullView hull = hull_of(assets, properties.asset);
  const auto sums = [](const Sizes& s, Scaled(&sum)[3]) {
    sum[0] = add(s.y, s.z);
    sum[1] = add(s.z, s.x);
    sum[2] = add(s.x, s.y);
  };
  Scaled round[3], sharp[3];
  sums(grown_squares, round);
  sums(squares_of({scaled_from(properties.size.x), scaled_from(properties.size.y), scaled_from(properties.size.z)}),
       sharp);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    Scaled& inverse_inertia = properties.inverse_inertia[axis];
    inverse_inertia =
        scaled_by_power(scaled_from_hull(hull.inverse_inertia(axis)), 2 * (properties.size_exponent - hull.exponent()));
    if (!(properties.rounding == Unit(0.0)))
      inverse_inertia = multiply(inverse_inertia, divide(sharp[axis], round[axis]));
  }
}

/// The greatest |x|, |y| and |z| of the vertices.
Vec3<Real> terrain_half_extents(const Terrain& terrain) {
  const GridBox box = terrain.bounds();
  const auto most = [&](int32_t low, int32_t high) {
    return real_from_unit(unit_from_steps(-low > high ? -low : high), terrain.exponent());
  };
  return {most(box.low.x, box.high.x), most(box.low.y, box.high.y), most(box.low.z, box.high.z)};
}
Status measure_terrain(const Shape& shape, const AssetTable& assets, ShapeMeasure& measure) {
  if (!is_in(assets, shape.asset)) return Status::asset_missing;
  measure.size = terrain_half_extents(terrain_view(assets.assets[shape.asset].bytes));
  measure.bound = length(measure.size);
  return measure.bound < k_size_min ? Status::out_of_range : Status::ok;
}
void set_terrain_asset(const Shape& shape, const AssetTable&, BodyProperties& properties) {
  properties.asset = shape.asset;
}

CompoundView compound_of(const AssetTable& assets, uint32_t asset) { return compound_view(assets.assets[asset].bytes); }
Status measure_compound(const Shape& shape, const AssetTable& assets, ShapeMeasure& measure) {
  if (!is_in(assets, shape.asset)) return Status::asset_missing;
  const CompoundView compound = compound_of(assets, shape.asset);
  const int32_t exponent = measure.exponent_min = compound.exponent();
  const auto metres = [exponent](int32_t steps) { return real_from_unit(unit_from_steps(steps), exponent); };
  const Vec32 half = compound.half_extents();
  measure.size = {metres(half.x), metres(half.y), metres(half.z)};
  measure.bound = metres(compound.radius());
  measure.smallest = measure.thickness = metres(compound.half_thickness());
  return Status::ok;
}
void set_compound_asset(const Shape& shape, const AssetTable&, BodyProperties& properties) {
  properties.asset = shape.asset;
}
Scaled compound_volume(const BodyProperties& properties, const Sizes&, const AssetTable& assets) {
  const CompoundView compound = compound_of(assets, properties.asset);
  return scaled_by_power(scaled_from_hull(compound.volume()), 3 * (compound.exponent() - properties.size_exponent));
}
void set_compound_inverse_inertia(BodyProperties& properties, const Sizes&, const AssetTable& assets) {
  const CompoundView compound = compound_of(assets, properties.asset);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    properties.inverse_inertia[axis] = scaled_by_power(scaled_from_hull(compound.inverse_inertia(axis)),
                                                       2 * (properties.size_exponent - compound.exponent()));
  }
}

Status measure_half_space(const Shape&, const AssetTable&, ShapeMeasure&) { return Status::ok; }

}  // namespace

const ShapeOps k_sphere_ops = {measure_sphere, nullptr, sphere_volume, set_sphere_inverse_inertia};
const ShapeOps k_capsule_ops = {measure_capsule, nullptr, capsule_volume, set_capsule_inverse_inertia};
const ShapeOps k_box_ops = {measure_box, nullptr, box_volume, set_box_inverse_inertia};
const ShapeOps k_cylinder_ops = {measure_upright<ShapeType::cylinder>, nullptr, cylinder_volume,
                                 set_cylinder_inverse_inertia};
const ShapeOps k_cone_ops = {measure_upright<ShapeType::cone>, nullptr, cone_volume, set_cone_inverse_inertia};
const ShapeOps k_hull_shape_ops = {measure_hull, set_hull_size, hull_volume, set_hull_inverse_inertia};
const ShapeOps k_terrain_shape_ops = {measure_terrain, set_terrain_asset, nullptr, nullptr};
const ShapeOps k_compound_shape_ops = {measure_compound, set_compound_asset, compound_volume,
                                       set_compound_inverse_inertia};
const ShapeOps k_half_space_shape_ops = {measure_half_space, nullptr, nullptr, nullptr};

const ShapeOps* ops_of(const FeatureTable& features, ShapeType type) {
  switch (type) {
    case ShapeType::sphere:
      return features.sphere;
    case ShapeType::capsule:
      return features.capsule;
    case ShapeType::box:
      return features.box;
    case ShapeType::half_space:
      return features.half_space_shape;
    case ShapeType::cylinder:
      return features.cylinder;
    case ShapeType::cone:
      return features.cone;
    case ShapeType::hull:
      return features.hull_shape;
    case ShapeType::terrain:
      return features.terrain_shape;
    case ShapeType::compound:
      return features.compound_shape;
    default:
      return nullptr;
  }
}

Status set_shape_properties(const Shape& shape, BodyProperties& properties, const AssetTable& assets,
                            const FeatureTable& features) {
  const Real zero = 0.0;
  ShapeMeasure measure = {{zero, zero, zero}, k_size_max, zero, -14};
  if (!is_world_shape(shape.type)) return Status::bad_argument;
  Features needed = feature_of(shape.type);
  if (!(shape.rounding == zero)) {
    if (!can_be_rounded(shape.type)) return Status::bad_argument;
    if (!is_size(shape.rounding)) return Status::out_of_range;
    measure.smallest = shape.rounding;
    needed = needed | Features::rounding;
  }
  if (!contains(features.features, needed)) return Status::feature_missing;
  const ShapeOps& ops = *ops_of(features, shape.type);
  if (const Status status = ops.measure(shape, assets, measure); status != Status::ok) return status;
  const bool bounded = shape.type != ShapeType::half_space;
  const Real bound = measure.bound + shape.rounding;
  if (bound >= k_bound_limit) return Status::out_of_range;
  if (bounded && shape.type != ShapeType::sphere && shape.type != ShapeType::terrain &&
      scale_by_power(bound, -14) > measure.smallest) {
    return Status::out_of_range;
  }
  int32_t exponent = bounded ? exponent_above(bound) : 0;
  if (bounded && exponent < measure.exponent_min) exponent = measure.exponent_min;
  const Vec3<Real>& size = measure.size;
  properties.shape = static_cast<uint32_t>(shape.type);
  properties.size_exponent = exponent;
  properties.size = unit_from_real(size, exponent);
  properties.bounding_radius = unit_from_real(bound, exponent);
  properties.rounding = unit_from_real(shape.rounding + measure.thickness, exponent);
  properties.asset = 0;
  if (ops.set_size != nullptr) ops.set_size(shape, assets, properties);
  return Status::ok;
}

Scaled shape_volume(const BodyProperties& properties, const AssetTable& assets, const FeatureTable& features) {
  const ShapeOps* ops = ops_of(features, shape_of(properties));
  const Scaled none = 0.0;
  if (ops == nullptr || ops->volume == nullptr) return none;
  return scaled_by_power(ops->volume(properties, grown_sizes(properties), assets), 3 * properties.size_exponent);
}

void set_inverse_inertia(BodyProperties& properties, const AssetTable& assets, const FeatureTable& features) {
  const ShapeOps* ops = ops_of(features, shape_of(properties));
  if (ops == nullptr || ops->set_inverse_inertia == nullptr) return;
  ops->set_inverse_inertia(properties, squares_of(grown_sizes(properties)), assets);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    if (less(k_inverse_inertia_max, properties.inverse_inertia[axis]))
      properties.inverse_inertia[axis] = k_inverse_inertia_max;
    if ((properties.rotation_locks >> axis & 1) != 0) properties.inverse_inertia[axis] = Scaled(0.0);
  }
}

Unit round_radius(const BodyProperties& properties) {
  switch (shape_of(properties)) {
    case ShapeType::sphere:
    case ShapeType::capsule:
    case ShapeType::cylinder:
      return properties.size.x;
    case ShapeType::box:
    case ShapeType::cone:
    case ShapeType::hull:
      return properties.rounding;
    default:
      return 0.0;
  }
}

Real shape_extent(const BodyProperties& properties) {
  const Unit none = 0.0;
  Unit smallest = properties.size.x;
  switch (shape_of(properties)) {
    case ShapeType::half_space:
    case ShapeType::terrain:
      return k_size_max;
    case ShapeType::cylinder:
    case ShapeType::cone:
      smallest = min(smallest, properties.size.y);
      break;
    case ShapeType::box:
    case ShapeType::hull:
      smallest = min(smallest, min(properties.size.y, properties.size.z));
      break;
    case ShapeType::compound:
      smallest = none;
      break;
    default:
      break;
  }
  return real_from_unit(smallest + properties.rounding, properties.size_exponent + 1);
}

Real bounds_extent(const BodyProperties& properties) {
  if (!is_terrain(properties)) return shape_extent(properties);
  return real_from_unit(properties.bounding_radius, properties.size_exponent - 8);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
