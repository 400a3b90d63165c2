#pragma once
#include <detent/distance.h>
#include <detent/toi.h>

#include <detent/toi_methods.h>
#include "base/digest.h"
#include "tests/unit/distance/closed_form.h"
#include "tests/unit/distance/exact_numbers.h"

/// Two moving shapes, and the properties that their time of impact must have.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline const double k_pi = acos(-1.0);
inline const Quaternion k_upright = {0, 0, 0, 1};

/// Two moving shapes, with the values that the configuration stores.
struct Encounter {
  KnownShape a, b;
  BodyAt body_a, body_b;

  Encounter(const KnownShape& shape_a, const BodyAt& start_a, const KnownShape& shape_b, const BodyAt& start_b)
      : a(shape_a), b(shape_b), body_a(held(start_a)), body_b(held(start_b)) {}
  Encounter swapped() const { return {b, body_b, a, body_a}; }

  TimeOfImpact impact() const {
    TimeOfImpact result;
    EXPECT_OK(time_of_impact(a.convex, motion_of(body_a), b.convex, motion_of(body_b), result));
    return result;
  }
  TimeOfImpact impact_by(ToiMethod method) const {
    TimeOfImpact result;
    EXPECT_OK(time_of_impact_by(method, a.convex, motion_of(body_a), b.convex, motion_of(body_b), result));
    return result;
  }
  bool planar() const { return a.type() == ShapeType::half_space || b.type() == ShapeType::half_space; }
  /// The size of the block, m, to which its ulps are proportional.
  double distance_max() const {
    double centres = 0;
    if (planar()) {
      for (const double time : {0.0, 1.0})
        centres = std::max(centres, length(body_b.at(time).position - body_a.at(time).position));
    }
    return a.distance_max() + b.distance_max() + a.ball + b.ball + centres;
  }
  /// The distance, m, by which a hit may be early: the stated fraction of the larger core diameter, or 96 ulps of the
  /// block.
  double tolerance() const {
    return std::max(k_toi_tolerance * 2 * std::max(a.distance_max(), b.distance_max()),
                    100 * 0x1p-29 * 1.02 * distance_max());
  }
  /// The error of gap(), m: poses at a time are rounded again.
  double slack() const { return 2 * k_position_step + (k_distance_error + 2 * k_number_error) * 2 * distance_max(); }
  /// The distance at a time of the step, m; 0 if the shapes overlap.
  double gap(double time) const {
    const Closest closest = closest_at(time);
    return closest.overlap ? 0 : host(closest.distance);
  }
  /// Whether the shapes are separated at a time; false only if they certainly overlap.
  bool apart(double time) const {
    const Closest closest = closest_at(time);
    return closest.capped || !closest.overlap;
  }
  Closest closest_at(double time) const {
    BodyAt at_a = body_a.at(time), at_b = body_b.at(time);
    at_b.position = at_b.position - at_a.position;
    at_a.position = {{0, 0, 0}};
    Closest closest;
    EXPECT_OK(closest_points(a.convex, pose_of(at_a), b.convex, pose_of(at_b), closest));
    return closest;
  }
};

inline bool operator==(const TimeOfImpact& a, const TimeOfImpact& b) {
  return a.outcome == b.outcome && a.time == b.time && a.normal == b.normal && a.point == b.point &&
         a.gjk_calls == b.gjk_calls && a.passes == b.passes;
}

/// Checks that hold for every answer: the shapes are separated up to its time, and at a hit they are within the
/// tolerance.
inline void expect_never_late(const Encounter& encounter, const TimeOfImpact& impact, int samples) {
  const double time = fraction_to_host(impact.time), slack = encounter.slack();
  ASSERT_GE(time, 0);
  ASSERT_LE(time, 1);
  if (impact.outcome == ToiOutcome::clear) {
    EXPECT_EQ(time, 1);
  }
  if (impact.outcome == ToiOutcome::hit) {
    EXPECT_LE(encounter.gap(time), encounter.tolerance() + slack);
    if (time == 0) return;
  }
  if (encounter.tolerance() / 5 <= slack) return;  // the poses are too coarse to tell
  for (int i = 0; i <= samples; ++i) {
    const double before = time * i / samples;
    ASSERT_TRUE(encounter.apart(before)) << "met at " << before << ", but reported " << time;
  }
}

/// The lateness, as a fraction of the step, that the numbers permit where rotation is involved.
inline constexpr double k_late = k_config == Config::f32 ? 0x1p-20 : 1e-9;

/// Two shapes of any kinds, but not two half-spaces, that start apart and are aimed at each other.
inline Encounter random_encounter(Samples& samples, double scale, double turn_max) {
  for (;;) {
    const KnownShape a = random_shape(samples, samples.below(10), scale),
                     b = random_shape(samples, samples.below(11), scale);
    const double near = a.distance_max() + b.distance_max() + a.ball + b.ball;
    const Vector start = random_direction(samples) * (near * uniform(samples, 0.6, 2));
    const Vector aim = random_direction(samples) * (near * uniform(samples, 0, 0.8));
    const auto rotation_vector = [&] { return random_direction(samples) * uniform(samples, 0, turn_max); };
    const BodyAt body_a = {random_direction(samples) * scale, random_quaternion(samples),
                           random_direction(samples) * scale,
                           samples.below(3) == 0 ? Vector{{0, 0, 0}} : rotation_vector()};
    const BodyAt body_b = {body_a.position + start, random_quaternion(samples),
                           body_a.displacement + (aim - start) * uniform(samples, 0.3, 2),
                           samples.below(3) == 0 ? Vector{{0, 0, 0}} : rotation_vector()};
    const Encounter encounter = {a, body_a, b, body_b};
    if (encounter.gap(0) > 0.01 * scale) return encounter;
  }
}

/// The digest of a method's answers to `count` encounters whose numbers every configuration represents exactly: equal
/// in all configurations.
inline uint64_t digest_of_answers(ToiMethod method, uint32_t seed, int count) {
  Samples samples{seed};
  const auto size = [&samples] { return real(1.125 + exact_number(samples, 256)); };
  const auto shape = [&](uint32_t kind) {
    const Real ball = real(kind % 2 == 0 ? 0 : 0.125), x = size(), y = size(), z = size();
    switch (kind % 7) {
      case 0:
        return known(sphere(x));
      case 1:
        return known(capsule(x, y));
      case 2:
        return known(rounded(cylinder(x, y), ball));
      case 3:
        return known(rounded(cone(x, y), ball));
      case 4:
        return known_hull(prism_bytes(), 0.125);
      default:
        return known(rounded(box({x, y, z}), ball));
    }
  };
  uint64_t digest = 0;
  for (int i = 0; i < count; ++i) {
    const uint32_t kind_a = samples.below(14), kind_b = samples.below(14);
    const KnownShape a = shape(kind_a), b = i % 8 == 0 ? known(half_space()) : shape(kind_b);
    Motion motion[2];
    for (Motion& m : motion) {
      const double away = &m == motion ? -2.5 : 2.5;
      const Vector at = exact_vector(samples, 256) + Vector{{away, 0, 0}};
      const Vector displacement = exact_vector(samples, 256) - Vector{{away, 0, 0}};
      m.start = exact_pose(samples, at);
      m.displacement = reals(displacement);
      m.rotation_vector = reals(exact_vector(samples, i % 3 == 0 ? 2560 : 512));
    }
    TimeOfImpact result;
    EXPECT_OK(time_of_impact_by(method, a.convex, motion[0], b.convex, motion[1], result));
    digest = digest_step(digest, static_cast<uint64_t>(result.time.raw));
    digest = digest_step(digest, static_cast<uint64_t>(result.outcome) << 32 | result.gjk_calls);
    digest = digest_step(digest, result.passes);
  }
  return digest_finish(digest);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
