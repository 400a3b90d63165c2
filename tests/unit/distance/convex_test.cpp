
#include <detent/distance.h>
#include <string.h>

#include <functional>

#include "tests/unit/distance/closed_form.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_least = 0x1p-14, k_most = 0x1p14;
constexpr double k_below_least = 0x1.fffffep-15, k_above_most = 0x1.000002p14;  // the next floats

/// Calls with a result that is filled with a pattern, and checks that a failing call does not change it.
template <class Result, class Call>
Status call_with_pattern(const Call& call) {
  Result result;
  unsigned char before[sizeof(Result)];
  memset(static_cast<void*>(&result), 0x5a, sizeof result);
  memcpy(before, &result, sizeof result);
  const Status status = call(result);
  EXPECT_TRUE(status == Status::ok || memcmp(before, &result, sizeof result) == 0) << "the result was touched";
  return status;
}

Status make(const Shape& shape) {
  return call_with_pattern<Convex>([&](Convex& convex) { return make_convex(shape, convex); });
}
Status make(const Asset& asset, Real rounding) {
  return call_with_pattern<Convex>([&](Convex& convex) { return make_hull(asset, rounding, convex); });
}
Status make(const Vec3<Real> (&corners)[3], Real rounding) {
  return call_with_pattern<Convex>([&](Convex& convex) { return make_triangle(corners, rounding, convex); });
}

/// A shape of each kind that has sizes, one of them `size` and the others 1 m; none for `which` beyond the last.
struct Sized {
  const char* text;
  Shape (*make)(Real size);
};
const Sized k_sized[] = {
    {"sphere", [](Real size) { return sphere(size); }},
    {"capsule's radius", [](Real size) { return capsule(size, 1.0); }},
    {"box's x",
     [](Real size) {
       return box({size, 1.0, 1.0});
     }},
    {"box's y",
     [](Real size) {
       return box({1.0, size, 1.0});
     }},
    {"box's z",
     [](Real size) {
       return box({1.0, 1.0, size});
     }},
    {"cylinder's radius", [](Real size) { return cylinder(size, 1.0); }},
    {"cylinder's half length", [](Real size) { return cylinder(1.0, size); }},
    {"cone's radius", [](Real size) { return cone(size, 1.0); }},
    {"cone's half length", [](Real size) { return cone(1.0, size); }},
    {"box's rounding",
     [](Real size) {
       return rounded(box({1.0, 1.0, 1.0}), size);
     }},
    {"cylinder's rounding", [](Real size) { return rounded(cylinder(1.0, 1.0), size); }},
    {"cone's rounding", [](Real size) { return rounded(cone(1.0, 1.0), size); }},
};

DETENT_TEST(convex, refuses_sizes_beyond_the_range_and_leaves_the_result) {
  for (const Sized& sized : k_sized) {
    SCOPED_TRACE(sized.text);
    for (const double size : {-1.0, -k_least, -k_most, k_below_least, k_above_most, 1e5, -1e5})
      EXPECT_EQ(make(sized.make(real(size))), Status::out_of_range) << size;
    const bool may_be_zero = strstr(sized.text, "rounding") != nullptr;
    EXPECT_EQ(make(sized.make(real(0))), may_be_zero ? Status::ok : Status::out_of_range);
    EXPECT_OK(make(sized.make(real(1))));
  }
  for (const double half_length : {-1.0, -k_least, k_above_most})
    EXPECT_EQ(make(capsule(real(1), real(half_length))), Status::out_of_range) << half_length;
}

DETENT_TEST(convex, accepts_the_ends_of_the_range) {
  const Real least = real(k_least), most = real(k_most), zero = real(0);
  for (const Real size : {least, most}) {
    EXPECT_OK(make(sphere(size)));
    EXPECT_OK(make(capsule(size, zero)));
    EXPECT_OK(make(capsule(size, most)));
    EXPECT_OK(make(capsule(size, least)));
    EXPECT_OK(make(box({size, size, size})));
    EXPECT_OK(make(cylinder(size, size)));
    EXPECT_OK(make(cone(size, size)));
    for (const Real ball : {zero, least, most}) {
      EXPECT_OK(make(rounded(box({size, size, size}), ball)));
      EXPECT_OK(make(rounded(cylinder(size, size), ball)));
      EXPECT_OK(make(rounded(cone(size, size), ball)));
      EXPECT_OK(make(tetrahedron_bytes(), ball));
    }
  }
  EXPECT_OK(make(half_space()));
}

DETENT_TEST(convex, refuses_a_core_whose_sizes_differ_too_much) {
  for (const double thick : {k_least, 0x1p-3, 1.0}) {
    // Twice the permitted ratio, for either shape; and half of it.
    const Real thin = real(thick), too_long = real(thick * 0x1p15 <= k_most ? thick * 0x1p15 : k_most);
    const Real wide = real(thick * 0x1p13);
    if (host(too_long) > host(thin) * 0x1p14) {
      EXPECT_EQ(make(box({thin, too_long, too_long})), Status::out_of_range);
      EXPECT_EQ(make(box({too_long, thin, too_long})), Status::out_of_range);
      EXPECT_EQ(make(box({thin, thin, too_long})), Status::out_of_range);
      EXPECT_EQ(make(cylinder(thin, too_long)), Status::out_of_range);
      EXPECT_EQ(make(cylinder(too_long, thin)), Status::out_of_range);
      EXPECT_EQ(make(cone(thin, too_long)), Status::out_of_range);
      EXPECT_EQ(make(cone(too_long, thin)), Status::out_of_range);
    }
    EXPECT_OK(make(box({thin, wide, wide})));
    EXPECT_OK(make(box({wide, thin, thin})));
    EXPECT_OK(make(cylinder(thin, wide)));
    EXPECT_OK(make(cylinder(wide, thin)));
    EXPECT_OK(make(cone(thin, wide)));
    EXPECT_OK(make(cone(wide, thin)));
  }
}

DETENT_TEST(convex, accepts_a_core_of_the_very_ratio_that_is_stated) {
  const Real thin = real(0.5), wide = real(0x1p13);
  EXPECT_OK(make(box({thin, thin, wide})));
  EXPECT_OK(make(box({thin, wide, wide})));
  EXPECT_OK(make(cylinder(thin, wide)));
  EXPECT_OK(make(cylinder(wide, thin)));
  EXPECT_OK(make(cone(thin, wide)));
  EXPECT_OK(make(cone(wide, thin)));
}

#if !DETENT_FIXED
DETENT_TEST(convex, refuses_nan_and_infinity_in_every_size) {
  const Real bad[] = {Real(__builtin_nan("")), Real(__builtin_inf()), Real(-__builtin_inf()), Real(1e30)};
  for (const Real size : bad) {
    for (const Sized& sized : k_sized) EXPECT_EQ(make(sized.make(size)), Status::out_of_range) << sized.text;
    EXPECT_EQ(make(capsule(Real(1), size)), Status::out_of_range);
    EXPECT_EQ(make(tetrahedron_bytes(), size), Status::out_of_range);
    const Vec3<Real> sound[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(make(sound, size), Status::out_of_range);
    const Vec3<Real> corners[3][3] = {{{size, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      {{1, 0, 0}, {0, size, 0}, {0, 0, 1}},
                                      {{1, 0, 0}, {0, 1, 0}, {0, 0, size}}};
    for (const auto& triangle : corners) EXPECT_EQ(make(triangle, Real(0)), Status::out_of_range);
  }
}
#endif

DETENT_TEST(convex, refuses_a_type_that_is_none_or_is_made_elsewhere) {
  for (const uint32_t type : {0u, 9u, 255u, 0xffffffffu}) {
    Shape shape = sphere(1.0);
    shape.type = static_cast<ShapeType>(type);
    EXPECT_EQ(make(shape), Status::bad_argument) << type;
  }
  for (const ShapeType type : {ShapeType::hull, ShapeType::triangle}) {
    Shape shape = sphere(1.0);
    shape.type = type;
    EXPECT_EQ(make(shape), Status::bad_argument);
  }
}

DETENT_TEST(convex, refuses_a_triangle_out_of_range_and_takes_a_flat_one) {
  const Vec3<Real> at_origin[3] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  EXPECT_EQ(make(at_origin, 0.0), Status::out_of_range);
  EXPECT_EQ(make(at_origin, 1.0), Status::out_of_range);
  const Vec3<Real> far[3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, real(0x1p16), 0.0}};
  EXPECT_EQ(make(far, 0.0), Status::out_of_range);
  const Vec3<Real> point[3] = {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_OK(make(point, 0.0));
  const Vec3<Real> line[3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  EXPECT_OK(make(line, 0.0));
  const Vec3<Real> sound[3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  EXPECT_OK(make(sound, 0.0));
  for (const double rounding : {-1.0, k_below_least, k_above_most})
    EXPECT_EQ(make(sound, real(rounding)), Status::out_of_range);
}

DETENT_TEST(convex, refuses_hull_bytes_that_are_missing_cut_off_misaligned_or_altered) {
  EXPECT_NE(make(Asset{nullptr, 0}, 0.0), Status::ok);
  alignas(8) uint8_t bytes[sizeof detent_hulls::k_tetrahedron + 8];
  constexpr uint32_t k_count = sizeof detent_hulls::k_tetrahedron;
  memcpy(bytes, detent_hulls::k_tetrahedron, k_count);
  EXPECT_OK(make(Asset{bytes, k_count}, 0.0));
  for (uint32_t count = 0; count < k_count; ++count) {
    const Status status = make(Asset{bytes, count}, 0.0);
    EXPECT_TRUE(status == Status::truncated || status == Status::corrupt || status == Status::not_detent)
        << count << ": " << status_text(status);
  }
  for (uint32_t at = 0; at < k_count; ++at) {
    bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1 << (at % 8)));
    EXPECT_NE(make(Asset{bytes, k_count}, 0.0), Status::ok) << at;
    bytes[at] = detent_hulls::k_tetrahedron[at];
  }
  for (uint32_t shift = 1; shift < 8; ++shift) {
    memmove(bytes + shift, detent_hulls::k_tetrahedron, k_count);
    EXPECT_EQ(make(Asset{bytes + shift, k_count}, 0.0), Status::buffer_misaligned);
  }
  for (const double rounding : {-1.0, k_below_least, k_above_most})
    EXPECT_EQ(make(tetrahedron_bytes(), real(rounding)), Status::out_of_range);
}

/// Every function that takes a pair, by name.
struct Question {
  const char* text;
  bool moves;  ///< it looks at displacement and turn
  std::function<Status(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b)> ask;
};
std::vector<Question> questions() {
  return {
      {"closest_points", false,
       [](const Convex& a, const Motion& ma, const Convex& b, const Motion& mb) {
         return call_with_pattern<Closest>([&](Closest& r) { return closest_points(a, ma.start, b, mb.start, r); });
       }},
      {"overlap", false,
       [](const Convex& a, const Motion& ma, const Convex& b, const Motion& mb) {
         bool overlaps = true;
         const Status status = overlap(a, ma.start, b, mb.start, overlaps);
         EXPECT_TRUE(status == Status::ok || overlaps);
         return status;
       }},
      {"farther_than", false,
       [](const Convex& a, const Motion& ma, const Convex& b, const Motion& mb) {
         bool farther = true;
         const Status status = farther_than(a, ma.start, b, mb.start, Real(1.0), farther);
         EXPECT_TRUE(status == Status::ok || farther);
         return status;
       }},
      {"time_of_impact", true,
       [](const Convex& a, const Motion& ma, const Convex& b, const Motion& mb) {
         return call_with_pattern<TimeOfImpact>([&](TimeOfImpact& r) { return time_of_impact(a, ma, b, mb, r); });
       }},
      {"cast_shape", false,
       [](const Convex& a, const Motion& ma, const Convex& b, const Motion& mb) {
         return call_with_pattern<CastHit>(
             [&](CastHit& r) { return cast_shape(a, ma.start, ma.displacement, b, mb.start, r); });
       }},
  };
}

Motion still_motion() { return motion_of({}); }

DETENT_TEST(convex, questions_refuse_two_half_spaces) {
  const Convex plane = known(half_space()).convex, ball = known(sphere(1.0)).convex;
  for (const Question& question : questions()) {
    SCOPED_TRACE(question.text);
    EXPECT_EQ(question.ask(plane, still_motion(), plane, still_motion()), Status::bad_argument);
    EXPECT_OK(question.ask(plane, still_motion(), ball, still_motion()));
    EXPECT_OK(question.ask(ball, still_motion(), plane, still_motion()));
  }
}

DETENT_TEST(convex, questions_refuse_a_rotation_that_is_not_of_length_1) {
  const Convex block = known(box({1.0, 1.0, 1.0})).convex, ball = known(sphere(1.0)).convex;
  CastHit hit;
  for (const double w : {0.0, 0.5, 0.99, 1.01, 1.9, -0.99}) {
    Motion motion = still_motion();
    EXPECT_OK(unit_from_host(w, motion.start.rotation.w));
    for (const Question& question : questions()) {
      SCOPED_TRACE(question.text);
      EXPECT_EQ(question.ask(block, motion, ball, still_motion()), Status::not_normalised) << w;
      EXPECT_EQ(question.ask(ball, still_motion(), block, motion), Status::not_normalised) << w;
    }
    EXPECT_EQ(cast_ray(block, motion.start, reals({{0, 0, 5}}), reals({{0, 0, -9}}), hit), Status::not_normalised);
  }
  for (const double w : {1 - 0x1p-11, 1 + 0x1p-11, -1.0}) {
    Motion motion = still_motion();
    EXPECT_OK(unit_from_host(w, motion.start.rotation.w));
    for (const Question& question : questions()) EXPECT_OK(question.ask(block, motion, ball, motion)) << question.text;
    EXPECT_OK(cast_ray(block, motion.start, reals({{0, 0, 5}}), reals({{0, 0, -9}}), hit));
  }
}

#if !DETENT_FIXED
DETENT_TEST(convex, questions_refuse_nan_and_infinity_in_poses_and_motions) {
  const Convex block = known(box({1.0, 1.0, 1.0})).convex, ball = known(sphere(1.0)).convex;
  for (const double bad : {__builtin_nan(""), __builtin_inf(), -__builtin_inf()}) {
    for (int i = 0; i < 4; ++i) {
      Motion turned = still_motion(), moved = still_motion(), spun = still_motion();
      (&turned.start.rotation.x)[i] = Unit(bad);
      if (i < 3) {
        (&moved.displacement.x)[i] = Real(bad);
        (&spun.rotation_vector.x)[i] = Real(bad);
      }
      for (const Question& question : questions()) {
        SCOPED_TRACE(question.text);
        EXPECT_EQ(question.ask(block, turned, ball, still_motion()), Status::not_normalised);
        EXPECT_EQ(question.ask(block, still_motion(), block, turned), Status::not_normalised);
        if (i == 3) continue;
#if defined(DETENT_F64)
        Motion lost = still_motion();
        (&lost.start.position.x)[i] = bad;
        EXPECT_EQ(question.ask(block, lost, ball, still_motion()), Status::out_of_range);
        EXPECT_EQ(question.ask(block, still_motion(), ball, lost), Status::out_of_range);
#endif
        if (!question.moves) continue;
        EXPECT_EQ(question.ask(block, moved, ball, still_motion()), Status::out_of_range);
        EXPECT_EQ(question.ask(block, still_motion(), ball, moved), Status::out_of_range);
        EXPECT_EQ(question.ask(block, spun, ball, still_motion()), Status::out_of_range);
        EXPECT_EQ(question.ask(ball, still_motion(), block, spun), Status::out_of_range);
      }
      if (i == 3) continue;
      CastHit hit;
      EXPECT_EQ(cast_ray(block, still_motion().start, moved.displacement, reals({{0, 0, 1}}), hit),
                Status::out_of_range);
      EXPECT_EQ(cast_ray(block, still_motion().start, reals({{0, 0, 5}}), moved.displacement, hit),
                Status::out_of_range);
      EXPECT_EQ(cast_shape(ball, still_motion().start, moved.displacement, block, still_motion().start, hit),
                Status::out_of_range);
    }
    bool farther = false;
    EXPECT_EQ(farther_than(block, still_motion().start, ball, still_motion().start, Real(bad), farther),
              Status::out_of_range);
  }
}
#endif

DETENT_TEST(convex, questions_refuse_displacements_and_turns_beyond_the_range) {
  const Convex block = known(box({1.0, 1.0, 1.0})).convex;
  TimeOfImpact impact;
  CastHit hit;
  for (int i = 0; i < 3; ++i) {
    Vector along = {{0, 0, 0}};
    along[i] = 1;
    for (const double sign : {1.0, -1.0}) {
      Motion far = still_motion(), spun = still_motion(), spun_in_range = still_motion(), near = still_motion();
      far.displacement = reals(along * (sign * 0x1p15));
      near.displacement = reals(along * (sign * 0x1p13));
      spun.rotation_vector = reals(along * (sign * 0x1.0001p16));
      spun_in_range.rotation_vector = reals(along * (sign * 0x1p16));
      for (const Question& question : questions()) {
        if (!question.moves) continue;
        EXPECT_EQ(question.ask(block, far, block, still_motion()), Status::out_of_range);
        EXPECT_EQ(question.ask(block, still_motion(), block, far), Status::out_of_range);
        EXPECT_EQ(question.ask(block, spun, block, still_motion()), Status::out_of_range);
        EXPECT_EQ(question.ask(block, still_motion(), block, spun), Status::out_of_range);
        EXPECT_OK(question.ask(block, spun_in_range, block, near));
      }
      EXPECT_EQ(cast_ray(block, still_motion().start, reals({{0, 0, 5}}), far.displacement, hit), Status::out_of_range);
      EXPECT_OK(cast_ray(block, still_motion().start, reals({{0, 0, 5}}), near.displacement, hit));
      EXPECT_EQ(cast_shape(block, still_motion().start, far.displacement, block, still_motion().start, hit),
                Status::out_of_range);
    }
  }
  // The length of the rotation vector is limited, not only its components.
  Motion spun = still_motion();
  spun.rotation_vector = reals({{0x1.8p15, 0x1.8p15, 0x1.8p15}});
  EXPECT_EQ(time_of_impact(block, spun, block, still_motion(), impact), Status::out_of_range);
}

DETENT_TEST(convex, farther_than_refuses_a_negative_reach) {
  const Convex ball = known(sphere(1.0)).convex;
  const Pose here = still_motion().start, there = pose_of({{{5, 0, 0}}});
  bool farther = false;
  for (const double distance_max : {-1.0, -0x1p-40, -1e5}) {
    EXPECT_EQ(farther_than(ball, here, ball, there, real(distance_max), farther), Status::out_of_range) << distance_max;
    EXPECT_FALSE(farther);
  }
  EXPECT_OK(farther_than(ball, here, ball, there, real(0), farther));
  EXPECT_TRUE(farther);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
