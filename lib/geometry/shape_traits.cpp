#include "geometry/shape_traits.h"

#include "math/arithmetic.h"
#include "math/root.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_size_min = 0x1p-14;
constexpr Real k_size_max = 0x1p14;
constexpr Scaled k_pi = 3.14159265358979323846;

bool is_size(Real value) { return value >= k_size_min && value <= k_size_max; }

Scaled square(Unit value) { return multiply(scaled_from(value), scaled_from(value)); }

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

Status set_shape(const Shape& shape, BodyTraits& traits) {
  const Real zero = 0.0;
  Vec3<Real> size = {zero, zero, zero};
  Real bound = zero;
  if (!(shape.rounding == zero)) return Status::bad_argument;  // a world's bodies are not rounded yet
  switch (shape.type) {
    case ShapeType::sphere:
      if (!is_size(shape.radius)) return Status::out_of_range;
      size.x = shape.radius;
      bound = shape.radius;
      break;
    case ShapeType::capsule:
      if (!is_size(shape.radius) || !(shape.half_length >= zero && shape.half_length <= k_size_max)) {
        return Status::out_of_range;
      }
      size = {shape.radius, shape.half_length, zero};
      bound = shape.radius + shape.half_length;
      break;
    case ShapeType::box:
      size = shape.half_extents;
      if (!is_size(size.x) || !is_size(size.y) || !is_size(size.z)) return Status::out_of_range;
      bound = length(size);
      break;
    case ShapeType::half_space:
      break;
    default:
      return Status::bad_argument;
  }
  if (shape.type != ShapeType::half_space && shape.type != ShapeType::sphere) {
    const Real smallest = shape.type == ShapeType::capsule ? size.x : min(min(size.x, size.y), size.z);
    if (scale_by_power(bound, -14) > smallest) return Status::out_of_range;
  }
  traits.shape = static_cast<uint32_t>(shape.type);
  traits.size_exponent = shape.type == ShapeType::half_space ? 0 : exponent_above(bound);
  traits.size = {unit_from_real(size.x, traits.size_exponent), unit_from_real(size.y, traits.size_exponent),
                 unit_from_real(size.z, traits.size_exponent)};
  traits.bounding_radius = unit_from_real(bound, traits.size_exponent);
  return Status::ok;
}

Scaled shape_volume(const BodyTraits& traits) {
  const Scaled x = scaled_from(traits.size.x);
  const Scaled y = scaled_from(traits.size.y);
  const Scaled z = scaled_from(traits.size.z);
  Scaled volume = 0.0;
  switch (static_cast<ShapeType>(traits.shape)) {
    case ShapeType::sphere:
      volume = multiply(multiply(k_pi, Scaled(4.0 / 3.0)), multiply(x, multiply(x, x)));
      break;
    case ShapeType::capsule:
      volume = multiply(multiply(k_pi, multiply(x, x)), add(multiply(Scaled(2.0), y), multiply(Scaled(4.0 / 3.0), x)));
      break;
    case ShapeType::box:
      volume = multiply(Scaled(8.0), multiply(x, multiply(y, z)));
      break;
    default:
      break;
  }
  return scaled_by_power(volume, 3 * traits.size_exponent);
}

void set_gyration(BodyTraits& traits) {
  const Scaled one = 1.0;
  switch (static_cast<ShapeType>(traits.shape)) {
    case ShapeType::sphere: {
      const Scaled gyration = divide(Scaled(2.5), square(traits.size.x));
      traits.gyration[0] = traits.gyration[1] = traits.gyration[2] = gyration;
      break;
    }
    case ShapeType::capsule: {
      Scaled along, across;
      capsule_moments(traits.size.x, traits.size.y, along, across);
      traits.gyration[0] = traits.gyration[2] = divide(one, across);
      traits.gyration[1] = divide(one, along);
      break;
    }
    case ShapeType::box: {
      const Scaled xx = square(traits.size.x);
      const Scaled yy = square(traits.size.y);
      const Scaled zz = square(traits.size.z);
      traits.gyration[0] = divide(Scaled(3.0), add(yy, zz));
      traits.gyration[1] = divide(Scaled(3.0), add(zz, xx));
      traits.gyration[2] = divide(Scaled(3.0), add(xx, yy));
      break;
    }
    default:
      break;
  }
}

Real shape_extent(const BodyTraits& traits) {
  Unit smallest = traits.size.x;
  if (static_cast<ShapeType>(traits.shape) == ShapeType::half_space) return k_size_max;
  if (static_cast<ShapeType>(traits.shape) == ShapeType::box) {
    smallest = min(smallest, min(traits.size.y, traits.size.z));
  }
  return real_from_unit(smallest, traits.size_exponent + 1);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
