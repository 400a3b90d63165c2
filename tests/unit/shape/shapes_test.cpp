#include "shape/bounds.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/shape/hull_bytes.h"

/// Cylinders, cones, hulls and rounded shapes as bodies: volume, moments, bounds and limits.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_pi = 3.14159265358979323846;
constexpr double k_mass_error = DETENT_FIXED ? 0x1p-24 : 16 * (sizeof(Real) == 4 ? 0x1p-24 : 0x1p-52);

const Asset k_assets[] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
const AssetTable k_table = {k_assets, 2};

BodyProperties hull_properties(uint32_t asset, double rounding) {
  BodyProperties properties{};
  EXPECT_OK(set_shape_properties(rounded(hull(asset), real_near(rounding)), properties, k_table));
  return properties;
}

/// The volume and moments of a solid of revolution about y, by slices. `radius_at` is linear, so Gaussian quadrature
/// with three points is exact.
struct Revolved {
  double volume = 0, along = 0, across = 0;  ///< moments over the volume

  template <class Function>
  Revolved(double low, double high, const Function& radius_at) {
    const double middle = (low + high) / 2, half = (high - low) / 2;
    double angular_velocity = 0, tumble = 0;
    for (const double at : {-sqrt(0.6), 0.0, sqrt(0.6)}) {
      const double y = middle + half * at, weight = half * (at == 0 ? 8 : 5) / 9;
      const double square = radius_at(y) * radius_at(y);
      volume += weight * k_pi * square;
      angular_velocity += weight * k_pi * square * square / 2;
      tumble += weight * k_pi * square * (square / 4 + y * y);
    }
    along = angular_velocity / volume;
    across = tumble / volume;
  }
};

void expect_mass(const BodyProperties& shape, double volume, const Vector& inertia, const AssetTable& assets = {}) {
  BodyProperties properties = shape;
  set_inverse_inertia(properties, assets);
  EXPECT_NEAR(scaled_to_host(shape_volume(properties, assets)) / volume, 1, k_mass_error);
  for (int i = 0; i < 3; ++i) {
    const double inverse_inertia =
        fmin(unit_of(properties) * unit_of(properties) / inertia[i], scaled_to_host(k_inverse_inertia_max));
    EXPECT_NEAR(scaled_to_host(properties.inverse_inertia[i]) / inverse_inertia, 1, k_mass_error);
  }
}

DETENT_TEST(shapes, cylinders_and_cones_sharp_and_rounded_have_the_mass_of_their_slices) {
  Samples samples = {11};
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    const double radius = exp2(uniform(samples, -14, 11)), half = fmin(radius * exp2(uniform(samples, -11, 11)), 8192);
    if (half < 0x1p-14) continue;
    const double ball = i % 2 == 0 ? 0 : fmax(fmin(radius, half) * exp2(uniform(samples, -2, 2)), 0x1p-14);
    const BodyProperties tin = properties_of(rounded(cylinder(real_near(radius), real_near(half)), real_near(ball)));
    const BodyProperties hat = properties_of(rounded(cone(real_near(radius), real_near(half)), real_near(ball)));
    const double unit = unit_of(tin), r = (host(tin.size.x) + host(tin.rounding)) * unit,
                 h = (host(tin.size.y) + host(tin.rounding)) * unit;
    const Revolved straight(-h, h, [&](double) { return r; });
    expect_mass(tin, straight.volume, {{straight.across, straight.along, straight.across}});
    const double s = unit_of(hat), rr = (host(hat.size.x) + host(hat.rounding)) * s,
                 hh = (host(hat.size.y) + host(hat.rounding)) * s;
    const Revolved pointed(-hh / 2, 1.5 * hh, [&](double y) { return rr * (1.5 * hh - y) / (2 * hh); });
    expect_mass(hat, pointed.volume, {{pointed.across, pointed.along, pointed.across}});
  }
}

DETENT_TEST(shapes, a_rounded_box_has_the_mass_of_the_box_around_it) {
  BodyProperties properties = properties_of(rounded(box(reals_near({{1, 2, 0.5}})), real_near(0.25)));
  const double x = 1.25, y = 2.25, z = 0.75;
  expect_mass(properties, 8 * x * y * z, {{(y * y + z * z) / 3, (z * z + x * x) / 3, (x * x + y * y) / 3}});
}

DETENT_TEST(shapes, hulls_have_the_mass_that_their_files_say) {
  for (uint32_t asset = 0; asset < 2; ++asset) {
    const HullView view = hull_view(k_assets[asset].bytes);
    const double volume = ldexp(view.volume().mantissa, view.volume().exponent + 3 * view.exponent());
    Vector inertia;
    for (uint32_t i = 0; i < 3; ++i) {
      inertia[static_cast<int>(i)] =
          ldexp(1.0, 2 * view.exponent()) / ldexp(view.inverse_inertia(i).mantissa, view.inverse_inertia(i).exponent);
    }
    expect_mass(hull_properties(asset, 0), volume, inertia, k_table);
  }
  EXPECT_NEAR(scaled_to_host(shape_volume(hull_properties(0, 0), k_table)), 1.0 / 6, 1e-7);
  EXPECT_NEAR(scaled_to_host(shape_volume(hull_properties(1, 0), k_table)), 1.5 * sqrt(3.0) * 0.16 * 1.6, 1e-6);
}

DETENT_TEST(shapes, a_rounded_hull_is_stretched_to_the_box_around_it) {
  for (uint32_t asset = 0; asset < 2; ++asset) {
    BodyProperties sharp = hull_properties(asset, 0), round = hull_properties(asset, 0.125);
    double grown = 1;
    const Vector before = host(sharp.size) * unit_of(sharp), after = before + Vector{{0.125, 0.125, 0.125}};
    for (int i = 0; i < 3; ++i) grown *= after[i] / before[i];
    const double ratio = scaled_to_host(shape_volume(round, k_table)) / scaled_to_host(shape_volume(sharp, k_table));
    EXPECT_NEAR(ratio, grown, 1e-6);
    set_inverse_inertia(sharp, k_table);
    set_inverse_inertia(round, k_table);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double inertia_before = unit_of(sharp) * unit_of(sharp) / scaled_to_host(sharp.inverse_inertia[i]);
      const double inertia_after = unit_of(round) * unit_of(round) / scaled_to_host(round.inverse_inertia[i]);
      const double squares =
          (after[j] * after[j] + after[k] * after[k]) / (before[j] * before[j] + before[k] * before[k]);
      EXPECT_NEAR(inertia_after / inertia_before, squares, 1e-5);
    }
  }
}

double box_extent_of(const BodyProperties& properties, const Quat& rotation, int axis) {
  double sum = host(properties.rounding);
  for (int i = 0; i < 3; ++i) {
    sum += fabs(detent_oracle::axis_of(host(rotation), i)[axis]) * host(properties.size)[i];
  }
  return sum * unit_of(properties);
}

/// The greatest distance of a core point along a world axis, in either direction; and the radius of the ball.
double extent_of(const BodyProperties& properties, const Quat& rotation, int axis) {
  const Vector size = host(properties.size) * unit_of(properties);
  Vector local;
  for (int i = 0; i < 3; ++i) local[i] = detent_oracle::axis_of(host(rotation), i)[axis];
  const double across = hypot(local[0], local[2]), ball = host(properties.rounding) * unit_of(properties);
  switch (shape_of(properties)) {
    case ShapeType::cylinder:
      return size[0] * across + size[1] * fabs(local[1]) + ball;
    case ShapeType::cone:
      return fmax(1.5 * size[1] * fabs(local[1]), 0.5 * size[1] * fabs(local[1]) + size[0] * across) + ball;
    case ShapeType::hull: {
      const HullView view = hull_view(k_assets[properties.asset].bytes);
      double far = 0;
      for (uint32_t i = 0; i < view.vertex_count; ++i) {
        const double along = local[0] * view.x(i) + local[1] * view.y(i) + local[2] * view.z(i);
        far = fmax(far, fabs(ldexp(along, view.exponent() - 30)));
      }
      return far + ball;
    }
    default:
      return box_extent_of(properties, rotation, axis);
  }
}

DETENT_TEST(shapes, bounds_contain_the_shape_and_are_tight_but_for_hulls) {
  Samples samples = {12};
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    const double size = exp2(uniform(samples, -14, 10)), other = fmin(size * exp2(uniform(samples, 0, 12)), 8192);
    const Real ball = real_near(i % 2 == 0 ? 0 : size * uniform(samples, 1, 4));
    const Real a = real_near(size), b = real_near(other);
    const Quat rotation = rotation_near(i % 5 == 0 ? Quaternion{0, 0, 0, 1} : any_rotation(samples));
    const double part = i % 2 == 0 ? 0 : uniform(samples, 0.01, 0.5);
    const BodyProperties shapes[] = {properties_of(rounded(cylinder(a, b), ball)),
                                     properties_of(rounded(cylinder(b, a), ball)),
                                     properties_of(rounded(cone(a, b), ball)),
                                     properties_of(rounded(cone(b, a), ball)),
                                     properties_of(rounded(box({a, b, a}), ball)),
                                     hull_properties(0, part),
                                     hull_properties(1, part)};
    for (const BodyProperties& properties : shapes) {
      const Vec3<Real> half = half_bounds(properties, matrix_from(rotation));
      const double given[3] = {real_to_host(half.x), real_to_host(half.y), real_to_host(half.z)};
      const double error = unit_of(properties) * (DETENT_FIXED ? 0x1p-28 : unit_steps(16));
      const double ball_around = host(properties.bounding_radius) * unit_of(properties);
      for (int axis = 0; axis < 3; ++axis) {
        const double right = extent_of(properties, rotation, axis);
        EXPECT_GE(given[axis], right - error);
        EXPECT_LE(right, ball_around + error);
        if (shape_of(properties) != ShapeType::hull) {
          EXPECT_LE(given[axis], right + error);
        } else {
          EXPECT_LE(given[axis], fmin(box_extent_of(properties, rotation, axis), ball_around) + error);
        }
      }
    }
  }
}

DETENT_TEST(shapes, sizes_and_rounding_are_allowed_up_to_their_limits_and_no_further) {
  BodyProperties properties{};
  const auto status = [&](const Shape& shape) { return set_shape_properties(shape, properties, k_table); };
  const Real one = 1.0, least = 0x1p-14, most = 0x1p14, small = 0x1.ffffp-15, large = 0x1.0001p14, none = 0.0;
  EXPECT_OK(status(cylinder(one, least * real_near(4))));
  EXPECT_EQ(status(cylinder(one, small)), Status::out_of_range);
  EXPECT_EQ(status(cylinder(large, one)), Status::out_of_range);
  EXPECT_EQ(status(cylinder(none, one)), Status::out_of_range);
  EXPECT_EQ(status(cone(real_near(0.5), small)), Status::out_of_range);
  EXPECT_OK(status(cone(most, most)));
  EXPECT_OK(status(rounded(cylinder(most, most), real_near(8192))));
  EXPECT_EQ(status(rounded(cylinder(most, most), most)), Status::out_of_range) << "a bounding radius of 2^15 m or more";
  EXPECT_EQ(status(capsule(most, most)), Status::out_of_range);
  EXPECT_OK(status(rounded(box({most, most, most}), real_near(4096))));
  EXPECT_LE(host(properties.bounding_radius), 1.0);
  EXPECT_EQ(status(cylinder(most, real_near(0.5))), Status::out_of_range) << "too flat";
  EXPECT_EQ(status(rounded(cone(one, one), small)), Status::out_of_range);
  EXPECT_EQ(status(rounded(cone(one, one), -one)), Status::out_of_range);
  EXPECT_EQ(status(rounded(box({one, one, one}), large)), Status::out_of_range);
  EXPECT_EQ(status(rounded(box({least, least, least}), real_near(2))), Status::out_of_range) << "a core too small";
  EXPECT_EQ(status(rounded(sphere(one), one)), Status::bad_argument);
  EXPECT_EQ(status(rounded(capsule(one, one), one)), Status::bad_argument);
  EXPECT_EQ(status(rounded(half_space(), one)), Status::bad_argument);
  EXPECT_EQ(status(hull(2)), Status::asset_missing);
  EXPECT_EQ(set_shape_properties(hull(0), properties), Status::asset_missing);
  EXPECT_OK(status(rounded(hull(0), real_near(2048))));
  EXPECT_EQ(status(rounded(hull(0), most)), Status::out_of_range) << "a core too small";
  Shape triangle;
  triangle.type = ShapeType::triangle;
  EXPECT_EQ(status(triangle), Status::bad_argument);
}

DETENT_TEST(shapes, the_smallest_diameter_is_that_of_the_least_size_and_the_rounding) {
  const auto extent = [](const Shape& shape) { return real_to_host(shape_extent(properties_of(shape))); };
  const Real two = 2.0, one = 1.0, quarter = 0.25;
  EXPECT_EQ(extent(cylinder(two, one)), 2);
  EXPECT_EQ(extent(cone(one, two)), 2);
  EXPECT_EQ(extent(rounded(cylinder(two, one), quarter)), 2.5);
  EXPECT_EQ(extent(rounded(box({two, two, quarter}), quarter)), 1);
  // Between the width along that axis and 3/2 of it.
  const HullView view = hull_view(k_assets[0].bytes);
  int32_t low = 0, high = 0;
  for (uint32_t i = 0; i < view.vertex_count; ++i) {
    low = view.x(i) < low ? view.x(i) : low;
    high = view.x(i) > high ? view.x(i) : high;
  }
  const BodyProperties tetrahedron = hull_properties(0, 0);
  const double width = ldexp(static_cast<double>(high) - low, view.exponent() - 30);
  const double given = real_to_host(shape_extent(tetrahedron));
  EXPECT_LE(given, 2 * width);
  EXPECT_GE(given, 0.5 * width);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
