#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"

/// The number of substeps that joints need. The rows of a joint act along straight lines. If a body rotates by the
/// angle w, rad, in a substep, its anchors leave these lines by arm x w^2 / 2. The solver corrects this error, except
/// for a fraction w of it. Therefore the squared number of substeps is proportional to the curvature of the anchors'
/// paths in a whole tick, divided by the smaller body's unit of length. A chain that hangs or swings slowly takes the
/// least number of substeps. A wheel, which rotates about its anchor, takes the least number, too.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Limit of each component of the rotation vector of a body in a tick, rad. At this rotation the number of substeps has
/// reached its upper limit.
constexpr Real k_rotation_max = 4.0;

/// Least number of substeps with joints. With a single substep, taut joints would open by metres.
constexpr uint32_t k_least = 2;
/// Least number of substeps for islands with loops of joints, because a body that hangs from two points may be taut
/// between them.
constexpr uint32_t k_least_of_loops = 3;
/// Least number of substeps for islands with joints and contacts, because the impulses of joints and contacts converge
/// to each other over the substeps.
constexpr uint32_t k_least_with_contacts = 4;
/// Squared number of substeps per squared radian of rotation in a tick: a substep for each 0.2 rad.
constexpr Scaled k_needed_by_bend = 25.0;
/// The relative rotation of the two bodies' axes counts 2^k_axes_power times as much as the curvature of the anchors'
/// paths.
constexpr int k_axes_power = 3;
constexpr Scaled k_needed_by_bend_max = 1024.0;
/// Squared number of substeps per squared radian of a spring's phase in a tick.
constexpr Scaled k_needed_by_spring = 25.0;
/// Limit of the squared number of substeps that a spring requests. push_softly() in joint_drives.cpp decides whether a
/// spring is solved explicitly or implicitly.
constexpr Scaled k_needed_by_spring_max = 16.0;

Scaled greater(Scaled a, Scaled b) { return less(a, b) ? b : a; }
Scaled lesser(Scaled a, Scaled b) { return less(a, b) ? a : b; }
/// The rotation vector of a body in a tick. Each component is clamped to +-k_rotation_max.
Vec3<Real> rotation_in_tick(const StepSettings& settings, const SolverBodies& bodies, const JointBody& body) {
  const BodyProperties& properties = bodies.properties[body.slot];
  if (type_of(properties) == BodyType::fixed) return k_zero_vector;
  const Vec3<Real> angular_velocity = world_angular_velocity(properties, bodies.work[body.slot].inverse_inertia,
                                                             bodies.motions[body.slot].angular_momentum, 0);
  bool held = false;
  const auto angle = [&](Real speed) {
    return clamp(angle_of(speed * settings.tick_time, properties.size_exponent, held), -k_rotation_max, k_rotation_max);
  };
  return {angle(angular_velocity.x), angle(angular_velocity.y), angle(angular_velocity.z)};
}

/// The deviation of a joint's anchors and axes from straight paths in a tick, divided by half of the smaller body's
/// unit of length. It is in squared radians.
Scaled bend_in_tick(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                    const JointWork& work) {
  Vec3<Real> rotation_vector[2];
  Scaled bend = Scaled(0.0);
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    rotation_vector[end] = rotation_in_tick(settings, bodies, body);
    const Vec3<Unit> arm = multiply(bodies.work[body.slot].axes, work.anchor[end]);
    const Vec3<Real> inwards = cross(rotation_vector[end], cross(rotation_vector[end], arm));
    bend = add(bend, scaled_by_power(scaled_from(absolute_sum(inwards)), body.exponent - work.exponent));
  }
  return add(bend,
             scaled_by_power(scaled_from(absolute_sum(cross(rotation_vector[0], rotation_vector[1]))), k_axes_power));
}

/// The length, m, by which the relative displacement of a joint's anchors is divided to get an angle of rotation. It is
/// the length of a rod or rope, or the smaller body's unit of length if the joint holds the anchors together. It is 0
/// if the anchors may part.
Scaled swinging_length(const JointState& joint, const JointWork& work) {
  switch (static_cast<JointType>(joint.type)) {
    case JointType::distance:
      return joint.limited[0] != 0 && joint.upper[0] > k_zero ? scaled_from(joint.upper[0]) : Scaled(0.0);
    case JointType::ball:
    case JointType::hinge:
    case JointType::fixed:
    case JointType::cone_twist:
      return scaled_by_power(Scaled(1.0), work.exponent);
    default:
      return Scaled(0.0);
  }
}

/// An upper bound of the squared angle by which a rod or rope between two anchors rotates in a tick. For a joint that
/// holds its anchors together, it bounds the squared angle by which the bodies rotate because an impulse has made the
/// velocities of the anchors differ.
Scaled squared_swing(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     const JointWork& work) {
  const Scaled length = swinging_length(stage.joints[work.joint], work);
  if (!is_positive(length)) return Scaled(0.0);
  Vec3<Real> apart = k_zero_vector;
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    const BodyProperties& properties = bodies.properties[body.slot];
    if (type_of(properties) == BodyType::fixed) continue;
    const BodyMotion& motion = bodies.motions[body.slot];
    const BodyWork& now = bodies.work[body.slot];
    const Vec3<Unit> arm = multiply(now.axes, work.anchor[end]);
    const Vec3<Real> angular_velocity =
        world_angular_velocity(properties, now.inverse_inertia, motion.angular_momentum, body.above);
    const Vec3<Real> linear_velocity = motion.linear_velocity + cross(angular_velocity, arm);
    apart = end == 0 ? apart - linear_velocity : apart + linear_velocity;
  }
  const Scaled displacement = multiply(scaled_from(absolute_sum(apart)), scaled_from(settings.tick_time));
  const Scaled angle = divide(displacement, length);
  return multiply(angle, angle);
}

}  // namespace

void require_substeps(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const JointStage& stage, Island& island) {
  island.joint_need = Scaled(0.0);
  if (island.joint_count == 0) return;
  uint32_t bodies_locked = 0;
  for (uint32_t i = 0; i < island.body_count; ++i) {
    if (bodies.work[slots[island.first_body + i]].joint_body != k_no_link) ++bodies_locked;
  }
  const uint32_t alone = island.joint_count > bodies_locked ? k_least_of_loops : k_least;
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
