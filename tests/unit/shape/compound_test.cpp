#include "shape/compound.h"

#include <math.h>

#include <algorithm>

#include "base/crc.h"
#include "tests/unit/shape/compounds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_compounds::cooked;
using detent_compounds::Parts;
using detent_terrains::Bytes;

Asset asset_of(const Bytes& bytes) { return {bytes.data(), bytes.count()}; }

void put(Bytes& bytes, uint32_t at, uint32_t value) {
  for (uint32_t k = 0; k < 4; ++k) bytes.data()[at + k] = static_cast<uint8_t>(value >> (8 * k));
}

void seal(Bytes& bytes) {
  constexpr uint32_t k_from = k_cooked_checksum_at;
  put(bytes, k_from, crc32(bytes.data() + k_from + 4, bytes.count() - k_from - 4, crc32(bytes.data(), k_from)));
}

void flip(Bytes& bytes, uint32_t bit) {
  bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
}

/// A hull, a rounded hull, a ball and a capsule.
Parts mixed() {
  return {detent_compounds::box({0, 0, 0}, {0.5, 0.3, 0.2}), detent_compounds::box({1, 0, 0.1}, {0.2, 0.3, 0.1}, 0.05),
          detent_compounds::ball(-1, 0.5, 0, 0.25), detent_compounds::capsule({0, 1, 0}, {0.5, 0.5, 0.5}, 0.1)};
}

double number(HullScaled value) { return ldexp(value.mantissa, value.exponent); }

DETENT_TEST(compound, is_read_as_it_was_cooked) {
  const Bytes bytes = cooked(mixed());
  CompoundView compound;
  ASSERT_OK(read_compound(asset_of(bytes), compound));
  EXPECT_EQ(compound.child_count, 4u);
  CompoundInfo info;
  ASSERT_OK(compound_info(asset_of(bytes), info));
  EXPECT_EQ(info.child_count, 4u);
  EXPECT_EQ(info.hull_count, 2u);
  EXPECT_EQ(info.exponent, 1);
  EXPECT_NEAR(ldexp(info.half_thickness, info.exponent - 30), 0.1, 1e-6);
  const double capsule_length = sqrt(0.75);
  const double volume = 8 * 0.5 * 0.3 * 0.2 + 8 * 0.25 * 0.35 * 0.15 + 4 * M_PI / 3 * pow(0.25, 3) +
                        M_PI * 0.01 * capsule_length + 4 * M_PI / 3 * 0.001;
  EXPECT_NEAR(ldexp(info.volume_mantissa, info.volume_exponent), volume, 1e-7 * volume);
}

/// The unit of the coordinates holds the radius of a ball whose centre is the origin.
DETENT_TEST(compound, of_balls_about_one_centre_is_read_as_it_was_cooked) {
  for (const double radius : {0.25, 0.3, 1.0, 1000.0}) {
    for (const Parts& parts :
         {Parts{detent_compounds::ball(0, 0, 0, radius)},
          Parts{detent_compounds::ball(0, 0, 0, radius / 2), detent_compounds::ball(0, 0, 0, radius)}}) {
      const Bytes bytes = cooked(parts);
      CompoundInfo info;
      ASSERT_OK(compound_info(asset_of(bytes), info)) << radius;
      const double volume = 4 * M_PI / 3 * pow(radius, 3) * (parts.size() == 2 ? 1.125 : 1);
      EXPECT_NEAR(ldexp(info.volume_mantissa, info.volume_exponent) / volume, 1, 1e-7) << radius;
    }
  }
}

/// The mass properties of the L: two boxes by the parallel axis theorem, rotated in the plane by the angle at which the
/// product of inertia vanishes.
DETENT_TEST(compound, mass_is_that_of_its_parts) {
  const Bytes bytes = cooked(detent_compounds::letter_l());
  CompoundView compound;
  ASSERT_OK(read_compound(asset_of(bytes), compound));
  CompoundInfo info;
  ASSERT_OK(compound_info(asset_of(bytes), info));
  const double m1 = 1, m2 = 0.75, m = m1 + m2;
  const double cx = m2 * -0.75 / m, cy = (m1 * 0.25 + m2 * 1.25) / m;
  EXPECT_NEAR(info.origin[0], cx, 1e-9);
  EXPECT_NEAR(info.origin[1], cy, 1e-9);
  EXPECT_NEAR(info.origin[2], 0, 1e-9);
  const auto square = [](double a) { return a * a; };
  const double xx = (m1 * (1.0 / 3 + square(cx)) + m2 * (square(0.25) / 3 + square(-0.75 - cx))) / m;
  const double yy = (m1 * (square(0.25) / 3 + square(0.25 - cy)) + m2 * (square(0.75) / 3 + square(1.25 - cy))) / m;
  const double xy = (m1 * (0 - cx) * (0.25 - cy) + m2 * (-0.75 - cx) * (1.25 - cy)) / m;
  const double zz = square(0.5) / 3;
  const double mean = (xx + yy) / 2, off = sqrt(square((xx - yy) / 2) + xy * xy);
  double expected[3] = {mean - off + zz, mean + off + zz, 2 * mean}, found[3];
  const double unit = ldexp(1, compound.exponent());
  for (uint32_t axis = 0; axis < 3; ++axis) found[axis] = unit * unit / number(compound.inverse_inertia(axis));
  std::sort(found, found + 3);
  std::sort(expected, expected + 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-7 * expected[k]) << k;
  EXPECT_NEAR(number(compound.volume()) * pow(unit, 3), m, 1e-8);
}

DETENT_TEST(compound, in_the_source_frame_has_its_centre_where_the_points_have_their_origin) {
  const detent_cook::CompoundResult cooked_there =
      detent_cook::cook_compound(detent_compounds::letter_l(), detent_cook::Frame::source);
  ASSERT_EQ(cooked_there.reason, "");
  const Bytes bytes(cooked_there.bytes);
  CompoundInfo info;
  CompoundView compound;
  ASSERT_OK(compound_info(asset_of(bytes), info));
  ASSERT_OK(read_compound(asset_of(bytes), compound));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(info.origin[k], 0) << k;
  const double m1 = 1, m2 = 0.75, m = m1 + m2, unit = ldexp(1, compound.exponent());
  const auto square = [](double a) { return a * a; };
  const double xx = (m1 / 3 + m2 * (square(0.25) / 3 + square(0.75))) / m;
  const double yy = (m1 * (square(0.25) / 3 + square(0.25)) + m2 * (square(0.75) / 3 + square(1.25))) / m;
  const double zz = square(0.5) / 3, expected[3] = {yy + zz, zz + xx, xx + yy};
  for (uint32_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(unit * unit / number(compound.inverse_inertia(axis)), expected[axis], 1e-7) << axis;
}

DETENT_TEST(compound, mass_of_a_capsule_is_the_standard_one) {
  const double r = 0.25, h = 0.75;
  const Bytes bytes = cooked({detent_compounds::capsule({0, -h, 0}, {0, h, 0}, r)});
  CompoundView compound;
  ASSERT_OK(read_compound(asset_of(bytes), compound));
  const double cylinder = M_PI * r * r * 2 * h, balls = 4 * M_PI / 3 * r * r * r, m = cylinder + balls;
  const double along = (cylinder * r * r / 2 + balls * 0.4 * r * r) / m;
  const double across = (cylinder * (r * r / 4 + h * h / 3) + balls * (0.4 * r * r + h * h + 0.75 * r * h)) / m;
  const double unit = ldexp(1, compound.exponent());
  EXPECT_NEAR(unit * unit / number(compound.inverse_inertia(1)), along, 1e-8);
  EXPECT_NEAR(unit * unit / number(compound.inverse_inertia(0)), across, 1e-8);
  EXPECT_NEAR(unit * unit / number(compound.inverse_inertia(2)), across, 1e-8);
}

DETENT_TEST(compound, every_flipped_bit_is_refused) {
  Bytes bytes = cooked(mixed());
  CompoundView compound;
  ASSERT_OK(read_compound(asset_of(bytes), compound));
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    flip(bytes, bit);
    EXPECT_NE(read_compound(asset_of(bytes), compound), Status::ok) << bit;
    flip(bytes, bit);
  }
}

/// With a correct checksum, only a changed value that is not checked against the children is accepted: volume, inverse
/// inertia, origin, rotation.
DETENT_TEST(compound, every_flipped_bit_under_a_right_checksum_is_refused_or_harmless) {
  Bytes bytes = cooked(mixed());
  uint32_t let_in = 0;
  const uint32_t children_end = k_compound_header_bytes + 4 * k_compound_child_bytes;
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    if (bit / 32 == k_cooked_checksum_at / 4) continue;
    flip(bytes, bit);
    seal(bytes);
    CompoundView compound;
    if (read_compound(asset_of(bytes), compound) == Status::ok) {
      ++let_in;
      const uint32_t at = bit / 8;
      // A ball or capsule may move within the bounds, unless the bounds depend on it.
      EXPECT_TRUE((at >= k_compound_volume_at && at < k_compound_rotation_at + 16) ||
                  (at >= k_compound_header_bytes + 2 * k_compound_child_bytes && at < children_end))
          << bit;
      for (uint32_t i = 0; i < compound.child_count; ++i) {
        const ChildBox box = child_box(compound.child(i));
        const Vec32 half = compound.half_extents();
        EXPECT_TRUE(-box.low.x <= half.x && box.high.x <= half.x && -box.low.y <= half.y && box.high.y <= half.y &&
                    -box.low.z <= half.z && box.high.z <= half.z);
      }
    }
    flip(bytes, bit);
  }
  EXPECT_GT(let_in, 0u);
}

DETENT_TEST(compound, cut_short_at_any_byte_is_refused) {
  const Bytes whole = cooked(mixed());
  CompoundView compound;
  for (uint32_t count = 0; count < whole.count(); ++count) {
    std::vector<uint64_t> words(count / 8 + 1);
    if (count > 0) memcpy(words.data(), whole.data(), count);
    EXPECT_NE(read_compound({reinterpret_cast<const uint8_t*>(words.data()), count}, compound), Status::ok);
  }
  EXPECT_EQ(read_compound({nullptr, 0}, compound), Status::truncated);
  EXPECT_EQ(read_compound({whole.data() + 4, whole.count() - 4}, compound), Status::buffer_misaligned);
}

DETENT_TEST(compound, that_cannot_be_is_refused_by_the_cook) {
  const auto reason = [](const Parts& parts) { return detent_cook::cook_compound(parts).reason; };
  EXPECT_NE(reason({}), "");
  EXPECT_NE(reason(Parts(65, detent_compounds::ball(0, 0, 0, 1))), "");
  EXPECT_NE(reason({detent_compounds::ball(0, 0, 0, 0)}), "");
  EXPECT_NE(reason({detent_compounds::ball(0, 0, 0, -1)}), "");
  EXPECT_NE(reason({detent_compounds::ball(0, NAN, 0, 1)}), "");
  EXPECT_NE(reason({detent_compounds::ball(-40000, 0, 0, 1), detent_compounds::ball(40000, 0, 0, 1)}), "");
  EXPECT_NE(reason({detent_compounds::capsule({1, 2, 3}, {1, 2, 3}, 1)}), "");
  EXPECT_NE(reason({detent_compounds::box({0, 0, 0}, {1, 0, 1})}), "");
}

DETENT_TEST(compound, is_read_from_text) {
  const detent_cook::CompoundRead read = detent_cook::read_compound_text(
      "o foot\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1/1 4/2 3/3\n"
      "density 2\nball 1 2 3 0.5\nrounding 0.1\nbox 0 0 0 1 2 3\ncapsule 0 0 0 1 0 0 0.25\n");
  EXPECT_EQ(read.problem, "");
  ASSERT_EQ(read.parts.size(), 4u);
  EXPECT_EQ(read.parts[0].points.size(), 12u);
  EXPECT_EQ(read.parts[0].density, 1);
  EXPECT_EQ(read.parts[1].density, 2);
  EXPECT_EQ(read.parts[1].radius, 0.5);
  EXPECT_EQ(read.parts[2].points.size(), 8u);
  EXPECT_EQ(read.parts[2].radius, 0.1);
  EXPECT_EQ(read.parts[3].points.size(), 2u);
  EXPECT_EQ(detent_cook::cook_compound(read.parts).reason, "");
  EXPECT_EQ(detent_cook::read_compound_text("ball 1 2\n").problem, "line 1: numbers are missing");
  EXPECT_EQ(detent_cook::read_compound_text("f 1 2 3\n").problem, "line 1: '1' names no vertex before this line");
  EXPECT_NE(detent_cook::read_compound_text("").problem, "");
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
