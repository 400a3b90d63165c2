#include "tests/unit/ccd/impact_shots.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Cell {
  bool rod;      ///< a rod of 2 cm x 1 m that angular velocities, or a ball of 5 cm
  bool plate;    ///< a plate that moves, or a fixed wall
  double speed;  ///< m/s
  double restitution;
};

constexpr double k_thickness = 0.01;
#if defined(DETENT_FX32)
constexpr double k_position_error = 0x1p-15, k_momentum_error = 1e-6;  // positions in steps of 2^-16 m
#elif defined(DETENT_F32)
constexpr double k_position_error = 3e-5, k_momentum_error = 1e-5;
#else
constexpr double k_position_error = 1e-6, k_momentum_error = 1e-6;
#endif

Vector turned(const Quaternion& q, const Vector& v) {
  return detent_oracle::axis_of(q, 0) * v[0] + detent_oracle::axis_of(q, 1) * v[1] +
         detent_oracle::axis_of(q, 2) * v[2];
}
Vector local(const Quaternion& q, const Vector& v) {
  return {{dot(v, detent_oracle::axis_of(q, 0)), dot(v, detent_oracle::axis_of(q, 1)),
           dot(v, detent_oracle::axis_of(q, 2))}};
}

/// The outcomes of the shots of one cell of the test.
struct Outcome {
  uint32_t hits = 0, through = 0, skewered = 0, wrong_side = 0, judged = 0;
  double lost_time = 0, deepest = 0, rebound_error = 0, momentum_error = 0;
  uint32_t undecided = 0, impacts_most = 0, left = 0;
};

struct Range {
  Lab lab;
  BodyId target, shot;
  Vector target_half, shot_half;
  bool rod;

  SegmentPose pose(uint32_t slot) {
    const auto state = view_of(lab.world);
    return {difference(state.poses[slot].position, Position{}), host(state.poses[slot].rotation)};
  }
  Solid solid(uint32_t slot, const SegmentPose& at) {
    const auto state = view_of(lab.world);
    OracleBody body;
    body.properties = state.properties[slot];
    Solid result = solid_of(body, Position{});
    result.centre = at.position;
    for (int i = 0; i < 3; ++i) result.axis[i] = detent_oracle::axis_of(at.rotation, i);
    return result;
  }
};

/// Velocity of the shot's point on its target, against it, and the analytic velocities after an impact that sticks.
struct Analytic {
  bool sticks = false;
  Vector linear_velocity, angular_velocity;
};

Vector solve3(const Vector (&m)[3], const Vector& r) {  // columns
  const double d = dot(m[0], cross(m[1], m[2]));
  return {{dot(r, cross(m[1], m[2])) / d, dot(m[0], cross(r, m[2])) / d, dot(m[0], cross(m[1], r)) / d}};
}

struct OracleMass {
  double inverse_mass = 0;
  Vector inverse_inertia = {{0, 0, 0}};
  Quaternion rotation = {0, 0, 0, 1};
  Vector apply(const Vector& torque) const {
    const Vector l = local(rotation, torque);
    return turned(rotation, {{l[0] * inverse_inertia[0], l[1] * inverse_inertia[1], l[2] * inverse_inertia[2]}});
  }
};

OracleMass mass_of(const BodyProperties& properties, const Quaternion& rotation) {
  OracleMass result;
  result.rotation = rotation;
  const double mass = scaled_to_host(properties.mass);
  if (mass == 0) return result;
  result.inverse_mass = 1 / mass;
  for (int i = 0; i < 3; ++i) {
    result.inverse_inertia[i] =
        scaled_to_host(properties.inverse_inertia[i]) / (mass * unit_of(properties) * unit_of(properties));
  }
  return result;
}

/// Newton's law of restitution along the normal n from the target to the shot, and no slip, at the point with arm_a on
/// the target and arm_b on the shot.
Analytic analytic_impact(const OracleMass& a, const OracleMass& b, const Vector& arm_a, const Vector& arm_b,
                         const Vector& n, const Vector& velocity_a, const Vector& angular_velocity_a,
                         const Vector& velocity_b, const Vector& angular_velocity_b, double restitution,
                         double friction) {
  const Vector u = velocity_b + cross(angular_velocity_b, arm_b) - (velocity_a + cross(angular_velocity_a, arm_a));
  Vector k[3];
  for (int i = 0; i < 3; ++i) {
    Vector e = {{0, 0, 0}};
    e[i] = 1;
    k[i] = e * (a.inverse_mass + b.inverse_mass) + cross(a.apply(cross(arm_a, e)), arm_a) +
           cross(b.apply(cross(arm_b, e)), arm_b);
  }
  const Vector target = n * (-restitution * dot(u, n));
  const Vector impulse = solve3(k, target - u);
  const double along = dot(impulse, n);
  Analytic result;
  result.sticks = length(impulse - n * along) <= friction * along * 0.999;
  result.linear_velocity = velocity_b + impulse * b.inverse_mass;
  result.angular_velocity = angular_velocity_b + b.apply(cross(arm_b, impulse));
  return result;
}

/// Whether the shot met with a corner that is nearer than all others: what it then does is known from that one.
bool is_one_point(Range& range, const SegmentPose& at, const Vector& normal) {
  if (!range.rod) return true;
  const Solid rod = range.solid(1, at);
  double least = HUGE_VAL, next = HUGE_VAL;
  for (int i = 0; i < 8; ++i) {
    const double height = dot(detent_oracle::box_vertex(rod, i), normal);
    next = std::min(next, std::max(least, height));
    least = std::min(least, height);
  }
  return next - least > 3e-5;
}

void shoot(const Cell& cell, Samples& samples, Outcome& outcome) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Range range = {Lab({2, 64, 0}, world), {}, {}, {}, {}, cell.rod};
  const double half = cell.plate ? 1 : 5;
  range.target_half = {{half, half, k_thickness / 2}};
  range.shot_half = cell.rod ? Vector{{0.01, 0.5, 0.01}} : Vector{{0.05, 0.05, 0.05}};

  const Quaternion target_rotation = any_rotation(samples);
  BodyDef target;
  target.type = cell.plate ? BodyType::dynamic : BodyType::fixed;
  target.shape = box(reals_near(range.target_half));
  target.rotation = rotation_near(target_rotation);
  target.material.restitution = real_near(cell.restitution);
  range.target = range.lab.add(target);

  const double angle = uniform(samples, 0, cell.plate ? 0.01745 : 1.0472), around = uniform(samples, 0, 6.283);
  const Vector displacement =
      turned(target_rotation, {{sin(angle) * cos(around), sin(angle) * sin(around), -cos(angle)}});
  const double spread = cell.plate ? 0.0707 : 1;
  const Vector aim =
      turned(target_rotation, {{uniform(samples, -spread, spread), uniform(samples, -spread, spread), 0}});
  BodyDef shot;
  shot.shape = cell.rod ? box(reals_near(range.shot_half)) : sphere(real_near(0.05));
  shot.density = scaled(7800);
  shot.rotation = rotation_near(any_rotation(samples));
  shot.position = position_near(aim - displacement * (0.8 + uniform(samples, 0.3, 1.3) * cell.speed / 60));
  shot.linear_velocity = reals_near(displacement * cell.speed);
  if (cell.rod) shot.angular_velocity = reals_near(any_direction(samples) * 40);
  shot.material.restitution = real_near(cell.restitution);
  range.shot = range.lab.add(shot);

  Trace trace;
  bool met = false, was_over = false;
  double side = 1;
  for (int tick = 0; tick < 12; ++tick) {
    const SegmentPose before_target = range.pose(0), before_shot = range.pose(1);
    const Vector momentum_before = host(view_of(range.lab.world).motions[1].angular_momentum);
    const Motion from_target = range.lab.motion(range.target), from_shot = range.lab.motion(range.shot);
    const StepReport report = trace.step(range.lab.world);
    outcome.lost_time += real_to_host(report.ccd.lost_time);
    outcome.undecided += report.ccd.undecided;
    outcome.left += report.ccd.overlaps_left;
    outcome.impacts_most = std::max(outcome.impacts_most, report.ccd.impacts);
    // The committed sweeps, at many times between their changes.
    const std::vector<double> changes = trace.changes();
    const int parts = 48;
    for (size_t i = 1; i < changes.size(); ++i) {
      if (changes[i] == changes[i - 1]) continue;
      for (int part = 1; part <= parts; ++part) {
        const double time = changes[i - 1] + (changes[i] - changes[i - 1]) * part / parts;
        const double gap = separation_of(range.solid(0, trace.at(0, time, before_target)),
                                         range.solid(1, trace.at(1, time, before_shot)))
                               .value;
        outcome.deepest = std::max(outcome.deepest, -gap);
        const SegmentPose now_target = trace.at(0, time, before_target), now_shot = trace.at(1, time, before_shot);
        const Vector place = local(now_target.rotation, now_shot.position - now_target.position);
        const bool over = fabs(place[0]) < half - 0.06 && fabs(place[1]) < half - 0.06 && fabs(place[2]) < 0.3;
        if (was_over && over && side > 0 && place[2] < 0) ++outcome.wrong_side;
        was_over = over;
        side = place[2];
      }
    }
    // The rebound of the first impact, checked if it is the only event of its tick.
    const bool first = !met && report.ccd.impacts != 0;
    if (!met && report.ccd.impacts + report.contacts.count != 0) {
      met = true;
      ++outcome.hits;
    }
    if (first) {
      const auto state = view_of(range.lab.world);
      const ImpactHit& hit = *at_offset<ImpactHit>(range.lab.block(), state.layout.impact_hits);
      const double time = Trace::time_of(hit.time);
      const SegmentPose at_target = trace.at(0, time, before_target), at_shot = trace.at(1, time, before_shot);
      const Vector point = difference(hit.point, Position{});
      const Vector arm_a = point - at_target.position, arm_b = point - at_shot.position;
      const auto vector_of = [](const double(&v)[3]) { return Vector{{v[0], v[1], v[2]}}; };
      Quaternion before_end = before_shot.rotation;  // of the sweep that was not to be
      for (uint32_t i = 0; i < trace.probe.segment_count; ++i) {
        if (trace.segments[i].body == 1 && trace.segments[i].from.raw == 0) {
          before_end = detent_oracle::rotation_by(host(trace.segments[i].rotation_vector)) * before_shot.rotation;
          break;
        }
      }
      const Vector angular_velocity_at_impact =
          mass_of(state.properties[1], at_shot.rotation)
              .apply(momentum_before * (scaled_to_host(state.properties[1].mass) * unit_of(state.properties[1])));
      const Analytic after = analytic_impact(
          mass_of(state.properties[0], at_target.rotation), mass_of(state.properties[1], at_shot.rotation), arm_a,
          arm_b, host(hit.normal), vector_of(from_target.linear_velocity), vector_of(from_target.angular_velocity),
          vector_of(from_shot.linear_velocity), angular_velocity_at_impact, cell.restitution, 0.6);
      const Vector local_momentum = local(before_end, momentum_before);
      const OracleMass shot_mass = mass_of(state.properties[1], at_shot.rotation);
      const Analytic after_carried =
          analytic_impact(mass_of(state.properties[0], at_target.rotation), shot_mass, arm_a, arm_b, host(hit.normal),
                          vector_of(from_target.linear_velocity), vector_of(from_target.angular_velocity),
                          vector_of(from_shot.linear_velocity),
                          shot_mass.apply(turned(at_shot.rotation, local_momentum) *
                                          (scaled_to_host(state.properties[1].mass) * unit_of(state.properties[1]))),
                          cell.restitution, 0.6);
      const Motion now = range.lab.motion(range.shot);
      if (report.ccd.impacts == 1 && report.contacts.count == 0 && after.sticks &&
          is_one_point(range, at_shot, host(hit.normal))) {
        ++outcome.judged;
        const double error = std::min(length(vector_of(now.linear_velocity) - after.linear_velocity),
                                      length(vector_of(now.linear_velocity) - after_carried.linear_velocity));
        outcome.rebound_error = std::max(outcome.rebound_error, error / cell.speed);
      }
      const Motion plate = range.lab.motion(range.target);
      if (cell.plate) {
        const double mass_a = scaled_to_host(state.properties[0].mass),
                     mass_b = scaled_to_host(state.properties[1].mass);
        const Vector change = (vector_of(now.linear_velocity) - vector_of(from_shot.linear_velocity)) * mass_b +
                              (vector_of(plate.linear_velocity) - vector_of(from_target.linear_velocity)) * mass_a;
        outcome.momentum_error = std::max(outcome.momentum_error, length(change) / (mass_b * cell.speed));
      }
    }
    // Sides, where the shot is over the target.
    const SegmentPose now_target = range.pose(0), now_shot = range.pose(1);
    if (cell.rod) {
      const Vector along = detent_oracle::axis_of(now_shot.rotation, 1) * 0.5;
      const Vector one = local(now_target.rotation, now_shot.position + along - now_target.position);
      const Vector other = local(now_target.rotation, now_shot.position - along - now_target.position);
      if ((one[2] < 0) != (other[2] < 0)) {
        const double share = one[2] / (one[2] - other[2]);
        const double x = one[0] + (other[0] - one[0]) * share, y = one[1] + (other[1] - one[1]) * share;
        if (fabs(x) < half && fabs(y) < half) ++outcome.skewered;
      }
    }
  }
  if (!met) ++outcome.through;  // or past it: no shot is aimed there
}

void expect_stops(bool rod, bool plate) {
  double deepest = 0;
  uint32_t impacts = 0;
  for (const double speed : {100.0, 500.0, 2000.0}) {
    for (const double restitution : {0.0, 0.5}) {
      Samples samples = {static_cast<uint64_t>(speed) + (rod ? 7 : 0) + (plate ? 3 : 0)};
      Outcome outcome;
      const uint32_t shots = getenv("DETENT_FULL") != nullptr ? 1000 : getenv("DETENT_EMULATED") != nullptr ? 6 : 200;
      for (uint32_t i = 0; i < shots; ++i) shoot({rod, plate, speed, restitution}, samples, outcome);
      SCOPED_TRACE(std::string(rod ? "rod" : "ball") + (plate ? " at a plate, " : " at a wall, ") +
                   std::to_string(speed) + " m/s, restitution " + std::to_string(restitution));
      deepest = std::max(deepest, outcome.deepest);
      impacts = std::max(impacts, outcome.impacts_most);
      EXPECT_EQ(outcome.hits, shots);
      EXPECT_EQ(outcome.through, 0u);
      EXPECT_EQ(outcome.skewered, 0u);
      EXPECT_EQ(outcome.wrong_side, 0u);
      EXPECT_EQ(outcome.lost_time, 0);
      EXPECT_LT(outcome.rebound_error, 0.01);
      if (shots >= 200) {
        EXPECT_GT(outcome.judged, 0u);
      }
      EXPECT_LT(outcome.momentum_error, k_momentum_error);
      EXPECT_LT(outcome.deepest, rod || plate ? k_thickness : k_position_error) << "m";
    }
  }
  ::testing::Test::RecordProperty("deepest", std::to_string(deepest));
  ::testing::Test::RecordProperty("impacts_most", std::to_string(impacts));
}

DETENT_TEST(impact_shots, a_ball_stops_at_a_wall_of_a_centimetre) { expect_stops(false, false); }
DETENT_TEST(impact_shots, a_ball_stops_at_a_plate_that_moves) { expect_stops(false, true); }
DETENT_TEST(impact_shots, a_spinning_rod_stops_at_a_wall_of_a_centimetre) { expect_stops(true, false); }
DETENT_TEST(impact_shots, a_spinning_rod_stops_at_a_plate_that_moves) { expect_stops(true, true); }

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
