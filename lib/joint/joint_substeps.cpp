#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/gyration.h"
#include "motion/spin.h"

/// How many substeps joints need. What turns by w in a substep leaves the straight way that its joints are held along
/// by w^2/2 of its arm. The solver makes up for that but for a part of w of it. So the square of the number of substeps
/// goes with what the ways bend in a whole tick, over the smaller body's unit: a chain that hangs or swings slowly
/// takes the fewest, and so does a wheel, which turns about its anchor.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_turn_max = 4.0;  ///< rad, each component of a turn: beyond those the number is at its bound

constexpr uint32_t k_least = 2;                ///< one substep would open what is taut by metres
constexpr uint32_t k_least_of_loops = 3;       ///< also by what hangs on two places, which may be taut between them
constexpr uint32_t k_least_with_contacts = 4;  ///< their impulses and those of the joints settle over the substeps
constexpr Scaled k_needed_by_bend = 25.0;      ///< for each squared radian in a tick: 0.2 rad a substep
constexpr int k_axes_power = 2;                ///< of axes that turn about each other: so much more
constexpr Scaled k_needed_by_bend_max = 1024.0;
constexpr Scaled k_needed_by_spring = 25.0;      ///< for each squared radian of its phase in a tick
constexpr Scaled k_needed_by_spring_max = 16.0;  ///< stiffer ones are solved implicitly

Scaled greater(Scaled a, Scaled b) { return less(a, b) ? b : a; }
Scaled lesser(Scaled a, Scaled b) { return less(a, b) ? a : b; }
/// The angle by which a body turns in a tick, each component held to +-k_turn_max.
Vec3<Real> turn_in_tick(const StepSettings& settings, const SolverBodies& bodies, const JointBody& body) {
  const BodyTraits& traits = bodies.traits[body.slot];
  if (type_of(traits) == BodyType::fixed) return k_zero_vector;
  const Vec3<Real> spin = world_spin(traits, bodies.work[body.slot].gyration, bodies.motions[body.slot].momentum, 0);
  bool held = false;
  const auto angle = [&](Real speed) {
    return clamp(angle_of(speed * settings.tick_time, traits.size_exponent, held), -k_turn_max, k_turn_max);
  };
  return {angle(spin.x), angle(spin.y), angle(spin.z)};
}

/// How far the ways of a joint's anchors and axes bend in a tick, over half of the smaller body's unit: squared
/// radians.
Scaled bend_in_tick(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                    const JointWork& work) {
  Vec3<Real> turn[2];
  Scaled bend = Scaled(0.0);
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    turn[end] = turn_in_tick(settings, bodies, body);
    const Vec3<Unit> arm = multiply(bodies.work[body.slot].axes, work.anchor[end]);
    const Vec3<Real> inwards = cross(turn[end], cross(turn[end], arm));
    bend = add(bend, scaled_by_power(scaled_from(absolute_sum(inwards)), body.exponent - work.exponent));
  }
  return add(bend, scaled_by_power(scaled_from(absolute_sum(cross(turn[0], turn[1]))), k_axes_power));
}

/// The squared angle by which a rod or a rope between two anchors turns in a tick, at most.
Scaled squared_swing(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const bool holds = static_cast<JointType>(joint.type) == JointType::distance && joint.limited[0] != 0;
  if (!holds || !(joint.upper[0] > Real(0.0))) return Scaled(0.0);
  Vec3<Real> apart = k_zero_vector;
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    const BodyTraits& traits = bodies.traits[body.slot];
    if (type_of(traits) == BodyType::fixed) continue;
    const BodyMotion& motion = bodies.motions[body.slot];
    const BodyWork& now = bodies.work[body.slot];
    const Vec3<Unit> arm = multiply(now.axes, work.anchor[end]);
    const Vec3<Real> spin = world_spin(traits, now.gyration, motion.momentum, body.above);
    const Vec3<Real> velocity = motion.velocity + cross(spin, arm);
    apart = end == 0 ? apart - velocity : apart + velocity;
  }
  const Scaled way = multiply(scaled_from(absolute_sum(apart)), scaled_from(settings.tick_time));
  const Scaled turn = divide(way, scaled_from(joint.upper[0]));
  return multiply(turn, turn);
}

}  // namespace

void ask_for_substeps(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const JointStage& stage, Island& island) {
  island.joint_need = Scaled(0.0);
  if (island.joint_count == 0) return;
  uint32_t bodies_held = 0;
  for (uint32_t i = 0; i < island.body_count; ++i) {
    if (bodies.work[slots[island.first_body + i]].joint_body != k_no_link) ++bodies_held;
  }
  const uint32_t alone = island.joint_count > bodies_held ? k_least_of_loops : k_least;
  island.substeps = island.contact_count != 0 ? k_least_with_contacts : alone;
  const auto take = [&](Scaled value) { island.joint_need = greater(island.joint_need, value); };
  for (const uint32_t index : Span<const uint32_t>{stage.order.data + island.first_joint, island.joint_count}) {
    const JointWork& work = stage.work[index];
    const Scaled bend =
        greater(bend_in_tick(settings, bodies, stage, work), squared_swing(settings, bodies, stage, work));
    take(lesser(multiply(bend, k_needed_by_bend), k_needed_by_bend_max));
    for (const Real frequency : stage.joints[work.joint].frequency) {
      if (!(frequency > Real(0.0))) continue;
      const Scaled phase = scaled_from(k_two_pi * frequency * settings.tick_time);
      take(lesser(multiply(multiply(phase, phase), k_needed_by_spring), k_needed_by_spring_max));
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
