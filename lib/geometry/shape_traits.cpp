#include "geometry/shape_traits.h"

#include "math/arithmetic.h"
#include "math/root.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_size_min = 0x1p-14;
constexpr Real k_size_max = 0x1p14;
constexpr Real k_bound_limit = 0x1p15;
constexpr Scaled k_pi = 3.14159265358979323846;

bool is_size(Real value) { return value >= k_size_min && value <= k_size_max; }

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

/// A size with the ball that rounds the shape.
Scaled grown(const BodyTraits& traits, Unit size) {
  const Scaled sharp = scaled_from(size);
  return traits.rounding == Unit(0.0) ? sharp : add(sharp, scaled_from(traits.rounding));
}

/// Moments of a capsule over m unit^2: about its axis and across it.
void capsule_moments(Unit radius, Unit half_length, Scaled& along, Scaled& across) {
  const Scaled r = scaled_from(radius);
  const Scaled l = scaled_from(half_length);
  const Scaled rr = multiply(r, r);
  const Scaled ll = multiply(l, l);
  const Scaled total = add(multiply(Scaled(3.0), l), multiply(Scaled(2.0), r));
  const Scaled cylinder = divide(multiply(Scaled(3.0), l), total);  // share of the mass
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

Status set_shape(const Shape& shape, BodyTraits& traits, const AssetTable& assets) {
  const Real zero = 0.0;
  Vec3<Real> size = {zero, zero, zero};
  Real smallest = k_size_max, bound = zero;
  int32_t exponent_min = -14;
  if (!(shape.rounding == zero)) {
    if (!can_be_rounded(shape.type)) return Status::bad_argument;
    if (!is_size(shape.rounding)) return Status::out_of_range;
    smallest = shape.rounding;
  }
  switch (shape.type) {
    case ShapeType::sphere:
      if (!is_size(shape.radius)) return Status::out_of_range;
      size.x = shape.radius;
      break;
    case ShapeType::capsule:
      if (!is_size(shape.radius) || !(shape.half_length >= zero && shape.half_length <= k_size_max)) {
        return Status::out_of_range;
      }
      size = {shape.radius, shape.half_length, zero};
      smallest = size.x;
      break;
    case ShapeType::cylinder:
    case ShapeType::cone:
      if (!is_size(shape.radius) || !is_size(shape.half_length)) return Status::out_of_range;
      size = {shape.radius, shape.half_length, zero};
      smallest = min(smallest, min(size.x, size.y));
      break;
    case ShapeType::box:
      size = shape.half_extents;
      if (!is_size(size.x) || !is_size(size.y) || !is_size(size.z)) return Status::out_of_range;
      smallest = min(smallest, min(min(size.x, size.y), size.z));
      break;
    case ShapeType::hull: {
      if (shape.asset >= assets.count || assets.assets[shape.asset].bytes == nullptr) return Status::asset_missing;
      const HullView hull = hull_of(assets, shape.asset);
      exponent_min = hull.exponent();
      const Vec3<Unit> half = hull_half_extents(hull, exponent_min);
      bound = real_from_unit(hull_radius(hull, exponent_min), exponent_min);
      smallest = min(smallest, real_from_unit(min(min(half.x, half.y), half.z), exponent_min));
      break;
    }
    case ShapeType::half_space:
      break;
    default:
      return Status::bad_argument;
  }
  const bool bounded = shape.type != ShapeType::half_space;
  if (shape.type != ShapeType::hull) bound = core_bound(shape.type, size);
  bound += shape.rounding;
  if (bound >= k_bound_limit) return Status::out_of_range;
  if (bounded && shape.type != ShapeType::sphere && scale_by_power(bound, -14) > smallest) return Status::out_of_range;
  int32_t exponent = bounded ? exponent_above(bound) : 0;
  if (bounded && exponent < exponent_min) exponent = exponent_min;
  traits.shape = static_cast<uint32_t>(shape.type);
  traits.size_exponent = exponent;
  traits.size = {unit_from_real(size.x, exponent), unit_from_real(size.y, exponent), unit_from_real(size.z, exponent)};
  if (shape.type == ShapeType::hull) traits.size = hull_half_extents(hull_of(assets, shape.asset), exponent);
  traits.bounding_radius = unit_from_real(bound, exponent);
  traits.rounding = unit_from_real(shape.rounding, exponent);
  traits.asset = shape.type == ShapeType::hull ? shape.asset : 0;
  return Status::ok;
}

Scaled shape_volume(const BodyTraits& traits, const AssetTable& assets) {
  const Scaled x = grown(traits, traits.size.x);
  const Scaled y = grown(traits, traits.size.y);
  const Scaled z = grown(traits, traits.size.z);
  Scaled volume = 0.0;
  switch (shape_of(traits)) {
    case ShapeType::sphere:
      volume = multiply(multiply(k_pi, Scaled(4.0 / 3.0)), multiply(x, multiply(x, x)));
      break;
    case ShapeType::capsule:
      volume = multiply(multiply(k_pi, multiply(x, x)), add(multiply(Scaled(2.0), y), multiply(Scaled(4.0 / 3.0), x)));
      break;
    case ShapeType::box:
      volume = multiply(Scaled(8.0), multiply(x, multiply(y, z)));
      break;
    case ShapeType::cylinder:
      volume = multiply(multiply(k_pi, Scaled(2.0)), multiply(y, multiply(x, x)));
      break;
    case ShapeType::cone:
      volume = multiply(multiply(k_pi, Scaled(2.0 / 3.0)), multiply(y, multiply(x, x)));
      break;
    case ShapeType::hull: {
      const HullView hull = hull_of(assets, traits.asset);
      volume = scaled_by_power(scaled_from_hull(hull.volume()), 3 * (hull.exponent() - traits.size_exponent));
      if (traits.rounding == Unit(0.0)) break;
      volume = multiply(volume, divide(x, scaled_from(traits.size.x)));
      volume = multiply(volume, divide(y, scaled_from(traits.size.y)));
      volume = multiply(volume, divide(z, scaled_from(traits.size.z)));
      break;
    }
    default:
      break;
  }
  return scaled_by_power(volume, 3 * traits.size_exponent);
}

void set_gyration(BodyTraits& traits, const AssetTable& assets) {
  const Scaled one = 1.0;
  const Scaled xx = square(grown(traits, traits.size.x));
  const Scaled yy = square(grown(traits, traits.size.y));
  const Scaled zz = square(grown(traits, traits.size.z));
  switch (shape_of(traits)) {
    case ShapeType::sphere:
      traits.gyration[0] = traits.gyration[1] = traits.gyration[2] = divide(Scaled(2.5), xx);
      break;
    case ShapeType::capsule: {
      Scaled along, across;
      capsule_moments(traits.size.x, traits.size.y, along, across);
      traits.gyration[0] = traits.gyration[2] = divide(one, across);
      traits.gyration[1] = divide(one, along);
      break;
    }
    case ShapeType::box:
      traits.gyration[0] = divide(Scaled(3.0), add(yy, zz));
      traits.gyration[1] = divide(Scaled(3.0), add(zz, xx));
      traits.gyration[2] = divide(Scaled(3.0), add(xx, yy));
      break;
    case ShapeType::cylinder:  // (3 r^2 + 4 h^2) / 12 across, r^2 / 2 along
      traits.gyration[0] = traits.gyration[2] =
          divide(Scaled(12.0), add(multiply(Scaled(3.0), xx), multiply(Scaled(4.0), yy)));
      traits.gyration[1] = divide(Scaled(2.0), xx);
      break;
    case ShapeType::cone:  // 3 (r^2 + h^2) / 20 across, 3 r^2 / 10 along, for the height 2 h
      traits.gyration[0] = traits.gyration[2] = divide(Scaled(20.0 / 3.0), add(xx, yy));
      traits.gyration[1] = divide(Scaled(10.0 / 3.0), xx);
      break;
    case ShapeType::hull: {
      const HullView hull = hull_of(assets, traits.asset);
      const Scaled grown_squares[3] = {add(yy, zz), add(zz, xx), add(xx, yy)};
      const Scaled x = square(scaled_from(traits.size.x)), y = square(scaled_from(traits.size.y)),
                   z = square(scaled_from(traits.size.z));
      const Scaled squares[3] = {add(y, z), add(z, x), add(x, y)};
      for (uint32_t axis = 0; axis < 3; ++axis) {
        Scaled& gyration = traits.gyration[axis];
        gyration = scaled_by_power(scaled_from_hull(hull.gyration(axis)), 2 * (traits.size_exponent - hull.exponent()));
        if (traits.rounding == Unit(0.0)) continue;
        gyration = multiply(gyration, divide(squares[axis], grown_squares[axis]));
      }
      break;
    }
    default:
      break;
  }
}

Real shape_extent(const BodyTraits& traits) {
  Unit smallest = traits.size.x;
  switch (shape_of(traits)) {
    case ShapeType::half_space:
      return k_size_max;
    case ShapeType::cylinder:
    case ShapeType::cone:
      smallest = min(smallest, traits.size.y);
      break;
    case ShapeType::box:
    case ShapeType::hull:
      smallest = min(smallest, min(traits.size.y, traits.size.z));
      break;
    default:
      break;
  }
  return real_from_unit(smallest + traits.rounding, traits.size_exponent + 1);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
