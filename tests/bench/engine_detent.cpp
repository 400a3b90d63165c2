#include <detent/distance.h>
#include <detent/numbers.h>
#include <detent/toi.h>

#include <detent/toi_methods.h>
#include "tests/bench/cooked.h"
#include "tests/bench/engine.h"
#include "tests/bench/pose.h"

#define DETENT_BENCH_TEXT_OF(name) #name
#define DETENT_BENCH_TEXT(name) DETENT_BENCH_TEXT_OF(name)

/// This library, compiled once per configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;
using detent_queries::Kind;
using detent_queries::Solid;

bool to_real(double value, Real& result) { return real_from_host(value, result) == Status::ok; }

bool to_vector(const Triple& v, Vec3<Real>& result) {
  return to_real(v[0], result.x) && to_real(v[1], result.y) && to_real(v[2], result.z);
}

bool to_pose(const Path& path, Pose& pose) {
  const PoseAt start = pose_at(path, 0);  // normalised
  Position& p = pose.position;
  Quat& q = pose.rotation;
  return coord_from_host(start.position[0], p.x) == Status::ok &&
         coord_from_host(start.position[1], p.y) == Status::ok &&
         coord_from_host(start.position[2], p.z) == Status::ok &&
         unit_from_host(start.rotation[0], q.x) == Status::ok && unit_from_host(start.rotation[1], q.y) == Status::ok &&
         unit_from_host(start.rotation[2], q.z) == Status::ok && unit_from_host(start.rotation[3], q.w) == Status::ok;
}

bool to_motion(const Path& path, Motion& motion) {
  return to_pose(path, motion.start) && to_vector(path.displacement, motion.displacement) &&
         to_vector(path.rotation_vector, motion.rotation_vector);
}

bool to_convex(const Solid& solid, Convex& convex) {
  Real rounding, radius, half_length;
  Vec3<Real> half_extents;
  if (!to_real(solid.rounding, rounding) || !to_real(solid.radius, radius) ||
      !to_real(solid.half_length, half_length) || !to_vector(solid.half_extents, half_extents))
    return false;
  switch (solid.kind) {
    case Kind::sphere:
      return make_convex(sphere(radius), convex) == Status::ok;
    case Kind::capsule:
      return make_convex(capsule(radius, half_length), convex) == Status::ok;
    case Kind::box:
      return make_convex(rounded(box(half_extents), rounding), convex) == Status::ok;
    case Kind::cylinder:
      return make_convex(rounded(cylinder(radius, half_length), rounding), convex) == Status::ok;
    case Kind::cone:
      return make_convex(rounded(cone(radius, half_length), rounding), convex) == Status::ok;
    case Kind::half_space:
      return make_convex(half_space(), convex) == Status::ok;
    case Kind::hull: {
      const CookedHull& cooked = cooked_hull(solid.points);
      const Asset asset = {reinterpret_cast<const uint8_t*>(cooked.words.data()), cooked.byte_count};
      return cooked.byte_count != 0 && make_hull(asset, rounding, convex) == Status::ok;
    }
    case Kind::triangle: {
      Vec3<Real> corners[3];
      for (size_t i = 0; i < 3; ++i) {
        if (!to_vector(solid.points[i], corners[i])) return false;
      }
      return make_triangle(corners, rounding, convex) == Status::ok;
    }
  }
  return false;
}

Outcome outcome_of(ToiOutcome outcome) {
  switch (outcome) {
    case ToiOutcome::clear:
      return Outcome::clear;
    case ToiOutcome::hit:
      return Outcome::hit;
    case ToiOutcome::undecided:
      break;
  }
  return Outcome::undecided;
}

using Impact = Status (*)(const Convex&, const Motion&, const Convex&, const Motion&, TimeOfImpact&);

template <ToiMethod method>
Status by_method(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                 TimeOfImpact& result) {
  return time_of_impact_by(method, a, motion_a, b, motion_b, result);
}

template <Impact impact>
class DetentToi : public Prepared {
 public:
  bool make(const Query& query) {
    TimeOfImpact result;
    return to_convex(query.a, a_) && to_convex(query.b, b_) && to_motion(query.path_a, motion_a_) &&
           to_motion(query.path_b, motion_b_) && impact(a_, motion_a_, b_, motion_b_, result) == Status::ok;
  }
  void run(Answer& answer) override {
    TimeOfImpact result;
    if (impact(a_, motion_a_, b_, motion_b_, result) != Status::ok) result.outcome = ToiOutcome::undecided;
    answer.outcome = outcome_of(result.outcome);
    answer.time = fraction_to_host(result.time);
    answer.gjk_calls = result.gjk_calls;
  }

 private:
  Convex a_, b_;
  Motion motion_a_, motion_b_;
};

class DetentDistance : public Prepared {
 public:
  bool make(const Query& query) {
    Closest result;
    return to_convex(query.a, a_) && to_convex(query.b, b_) && to_pose(query.path_a, pose_a_) &&
           to_pose(query.path_b, pose_b_) && closest_points(a_, pose_a_, b_, pose_b_, result) == Status::ok;
  }
  void run(Answer& answer) override {
    Closest result;
    if (closest_points(a_, pose_a_, b_, pose_b_, result) != Status::ok) result.capped = true;
    answer.outcome = result.capped ? Outcome::undecided : result.overlap ? Outcome::hit : Outcome::clear;
    answer.distance = real_to_host(result.distance);
    answer.gjk_calls = result.iterations;
  }

 private:
  Convex a_, b_;
  Pose pose_a_, pose_b_;
};

template <class Made>
std::unique_ptr<Prepared> prepare(const Query& query) {
  std::unique_ptr<Made> made(new Made);
  if (!made->make(query)) return nullptr;
  return made;
}

}  // namespace

/// Adds this configuration's engines.
void add_bench_engines(EngineList& engines) {
  // fx32 rounds a position to 2^-16 m as it enters: it is asked, and judged, about the rounded query. The others' grid
  // is finer than what is asked: its ulps widen the tolerance.
  constexpr double k_position_step = k_config == Config::fx32 ? 0x1p-16 : k_config == Config::f64 ? 0 : 0x1p-32;
  constexpr double k_slack = k_config == Config::f64 ? 0 : 4 * 0x1p-32;
  const char* const config = DETENT_BENCH_TEXT(DETENT_NAMESPACE);
  const auto toi = [&](const char* method, auto prepare_it) {
    engines.push_back({Task::toi, method, config, k_position_step, k_slack, prepare_it});
  };
  toi("default", prepare<DetentToi<time_of_impact>>);
  toi("paper", prepare<DetentToi<by_method<ToiMethod::paper>>>);
  toi("first_order", prepare<DetentToi<by_method<ToiMethod::first_order>>>);
  toi("second_order", prepare<DetentToi<by_method<ToiMethod::second_order>>>);
  toi("corotating", prepare<DetentToi<by_method<ToiMethod::corotating>>>);
  toi("world_space", prepare<DetentToi<by_method<ToiMethod::world_space>>>);
  toi("constant_angular_velocity", prepare<DetentToi<by_method<ToiMethod::constant_angular_velocity>>>);
  toi("mirtich", prepare<DetentToi<by_method<ToiMethod::mirtich>>>);
  toi("baraff", prepare<DetentToi<by_method<ToiMethod::baraff>>>);
  toi("feature_pairs", prepare<DetentToi<by_method<ToiMethod::feature_pairs>>>);
  toi("redon", prepare<DetentToi<by_method<ToiMethod::redon>>>);
  toi("canny", prepare<DetentToi<by_method<ToiMethod::canny>>>);
  engines.push_back({Task::distance, "closest_points", config, k_position_step, k_slack, prepare<DetentDistance>});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
