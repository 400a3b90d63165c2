#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "dynamics/spin.h"
#include "math/root.h"
#include "math/scaled.h"

/// How many substeps joints need. A joint is held at the speeds of its bodies, along a straight way. What turns by w in
/// a substep leaves its circle by w^2/2 of the radius, and by so much the joint gives way: so the square of the number
/// of substeps goes with what the ways bend in a whole tick, and a chain that hangs or swings slowly takes one.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_bend_turn_max = 2.0;  ///< rad, each component of a turn: beyond those the number is at its bound

/// Squared substeps for each part of the smaller body's unit of length, or radian, by which the ways bend in a tick.
constexpr Scaled k_needed_by_bend = 64.0;
constexpr Scaled k_needed_by_bend_max = 64.0;
/// For each squared radian of a swing under the pulls of joints in a tick: what is slowed for want of substeps
/// (joint_sway.cpp) is slowed little. No more than 4: what is taut between two walls comes apart sooner with 8 than
/// with 4.
constexpr Scaled k_needed_by_swing = 1.0 / 72;
constexpr Scaled k_needed_by_swing_max = 16.0;
constexpr Scaled k_needed_with_contacts = 64.0;  ///< their impulses and those of the joints settle over the substeps
constexpr Scaled k_needed_by_loops = 16.0;       ///< also of what hangs on two places, which may be taut between them
constexpr Scaled k_needed_by_spring = 25.0;      ///< for each squared radian of its phase in a tick
constexpr Scaled k_needed_by_spring_max = 16.0;  ///< stiffer ones are solved implicitly

Scaled greater(Scaled a, Scaled b) { return less(a, b) ? b : a; }
Scaled lesser(Scaled a, Scaled b) { return less(a, b) ? a : b; }
Vec3<Real> cross_of(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Makes `velocity` and `spin` of a body its way, m, and its turn, rad, in a tick.
void take_motion(const StepSettings& settings, const SolverBodies& bodies, JointBody& body) {
  const BodyTraits& traits = bodies.traits[body.slot];
  const BodyMotion& motion = bodies.motions[body.slot];
  const Real zero = 0.0;
  body.velocity = body.spin = {zero, zero, zero};
  if (type_of(traits) == BodyType::fixed) return;
  const Vec3<Real> spin = world_spin(traits, bodies.work[body.slot].gyration, motion.momentum, 0);
  bool clamped = false;
  const auto angle = [&](Real speed) {
    return clamp(angle_of(speed * settings.tick_time, traits.size_exponent, clamped), -k_bend_turn_max,
                 k_bend_turn_max);
  };
  body.velocity = motion.velocity * settings.tick_time;
  body.spin = {angle(spin.x), angle(spin.y), angle(spin.z)};
}

/// By how much the ways of the bodies' turns bend in a tick, at the joint, over its unit; angles as they are. Sets the
/// joint's arms.
Scaled bend(const SolverBodies& bodies, const JointStage& stage, JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const JointType type = static_cast<JointType>(joint.type);
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const auto in_metres = [](const Vec3<Unit>& v, int exponent) {
    return Vec3<Real>{real_from_unit(v.x, exponent), real_from_unit(v.y, exponent), real_from_unit(v.z, exponent)};
  };
  const auto over_unit = [&](Real length) { return scaled_by_power(scaled_from(length), -work.exponent); };
  work.arm[0] = multiply(bodies.work[a.slot].axes, work.anchor[0]);
  work.arm[1] = multiply(bodies.work[b.slot].axes, work.anchor[1]);
  const Vec3<Real> arm_b = in_metres(work.arm[1], b.exponent);
  Vec3<Real> arm_a = in_metres(work.arm[0], a.exponent);
  const bool slides = type == JointType::slider || type == JointType::wheel;
  if (slides) arm_a = work.between + arm_b;  // B's anchor, wherever it is on A's axis
  const Vec3<Real> by_a = cross_of(a.spin, arm_a), by_b = cross_of(b.spin, arm_b);
  if (type == JointType::distance) {
    // The way from anchor to anchor turns.
    if (joint.limited[0] == 0 || !(joint.upper[0] > Real(0.0))) return Scaled(0.0);
    const Real apart = absolute_sum((b.velocity + by_b) - (a.velocity + by_a));
    return divide(multiply(scaled_from(apart), over_unit(apart)), scaled_from(joint.upper[0]));
  }
  Vec3<Real> bends = cross_of(b.spin, by_b) - cross_of(a.spin, by_a);
  if (slides) bends -= cross_of(a.spin, (b.velocity + by_b) - (a.velocity + by_a)) * Real(2.0);
  const Scaled length = over_unit(absolute_sum(bends));
  if (type == JointType::ball || type == JointType::cone_twist) return length;
  return greater(length, scaled_from(absolute_sum(cross_of(a.spin, b.spin))));
}

}  // namespace

Scaled squared_substeps(const StepSettings& settings, const SolverBodies& bodies, const Island& island,
                        JointStage& stage) {
  const uint32_t count = island.joint_count + island.loop_count;
  Scaled need = Scaled(0.0);
  if (count == 0) return need;
  const auto take = [&](Scaled value) { need = greater(need, value); };
  if (island.contact_count != 0) take(k_needed_with_contacts);
  const Span<const uint32_t> joints = {stage.order.data + island.first_joint, count};
  uint32_t closed = island.loop_count, hung = 0;
  for (const uint32_t index : joints) {
    for (const uint32_t place : stage.work[index].body) {
      JointBody& body = stage.bodies[place];
      if (body.mobile == 0 && ++hung > 1) ++closed;
      if (body.mobile == 0 || body.owner == index) take_motion(settings, bodies, body);
    }
  }
  if (closed != 0) take(k_needed_by_loops);
  for (const uint32_t index : joints) {
    JointWork& work = stage.work[index];
    take(lesser(multiply(bend(bodies, stage, work), k_needed_by_bend), k_needed_by_bend_max));
    for (const Real frequency : stage.joints[work.joint].frequency) {
      if (!(frequency > Real(0.0))) continue;
      const Scaled phase = scaled_from(k_two_pi * frequency * settings.tick_time);
      take(lesser(multiply(multiply(phase, phase), k_needed_by_spring), k_needed_by_spring_max));
    }
  }
  const Scaled swing = swing_of_tick(settings, bodies, joints, stage);
  take(lesser(multiply(swing, k_needed_by_swing), k_needed_by_swing_max));
  return need;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
