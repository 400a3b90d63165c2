#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Returns the index of the body in JointStage::bodies. Adds the body if it is not there yet.
uint32_t place_of(const SolverBodies& bodies, uint32_t slot, JointStage& stage) {
  uint32_t& place = bodies.work[slot].joint_body;
  if (place != k_no_link) return place;
  place = stage.body_count++;
  JointBody& body = stage.bodies[place];
  static_cast<JointBodyStart&>(body) = {};
  body.slot = slot;
  body.mobile = is_dynamic(bodies.properties[slot]) && stage.activities[slot].asleep == 0 ? 1 : 0;
  body.first = body.last = body.next = k_no_link;
  body.exponent = bodies.properties[slot].size_exponent;
  body.inverse_mass = Scaled(0.0);
  return place;
}

void link_to(JointStage& stage, uint32_t joint, uint32_t end) {
  JointBody& body = stage.bodies[stage.work[joint].body[end]];
  const uint32_t link = 2 * joint + end;
  if (body.last == k_no_link)
    body.first = link;
  else
    stage.work[body.last / 2].next[body.last % 2] = link;
  body.last = link;
  stage.work[joint].next[end] = k_no_link;
}

/// Enlarges a body's unit of length so that an arm of this length, m, fits.
void extend_arm(JointBody& body, Real arm) {
  const int exponent = exponent_above(arm);
  if (exponent > body.exponent) body.exponent = exponent;
}

/// The largest number of rows of a joint: the locked motions of its type, and the driven free motions.
uint32_t rows_of(const JointState& joint) {
  const JointType type = static_cast<JointType>(joint.type);
  uint32_t rows = type == JointType::ball || type == JointType::cone_twist ? 3
                  : type == JointType::distance                            ? 0
                  : type == JointType::wheel                               ? 4
                  : type == JointType::parallel                            ? 2
                  : type == JointType::fixed                               ? 6
                                                                           : 5;
  for (uint32_t left = driven_motions(joint); left != 0; left &= left - 1) ++rows;
  return rows;
}

bool has_slide(const JointState& joint) {
  const JointType type = static_cast<JointType>(joint.type);
  return type == JointType::slider || type == JointType::wheel;
}

/// An upper bound of the length of A's arm, m. In a joint that slides (slider, wheel), A's arm reaches to B's anchor.
/// `between`: from A's centre to B's, m.
Real arm_of_a(const JointState& joint, const Vec3<Real>& between) {
  Real displacement = Real(0.0);
  if (has_slide(joint)) displacement = scale_by_power(absolute_sum(between) + absolute_sum(joint.anchor_b), 1);
  return max(absolute_sum(joint.anchor_a), displacement);
}

#if DETENT_SPARSE
/// Adds the fixed and kinematic bodies of the joints in JointStage::anchoring. They are needed because the unit of such
/// a body must fit the arms of all its joints, and because contacts ask whether a body has joints.
void collect_anchors(const SolverBodies& bodies, JointStage& stage) {
  stage.anchoring.for_each([&](uint32_t slot) {
    const JointState& joint = stage.others[slot];
    const auto extend = [&](uint32_t body, Real arm) {
      if (!is_dynamic(bodies.properties[body])) extend_arm(stage.bodies[place_of(bodies, body, stage)], arm);
    };
    extend(joint.body_a,
           arm_of_a(joint, real_difference(stage.poses[joint.body_b].position, stage.poses[joint.body_a].position)));
    extend(joint.body_b, absolute_sum(joint.anchor_b));
  });
}
#endif

}  // namespace

Vec3<Unit> clamped_unit(const Vec3<Real>& v, int exponent) {
  const Real limit = real_from_unit(Unit(1.875), exponent > 15 ? 15 : exponent);
  const auto part = [&](Real value) { return unit_from_real(clamp(value, -limit, limit), exponent); };
  return {part(v.x), part(v.y), part(v.z)};
}

void collect_joints(const SolverBodies& bodies, JointStage& stage) {
  stage.count = stage.body_count = 0;
  const auto moves = [&](uint32_t slot) {
    return is_dynamic(bodies.properties[slot]) && stage.activities[slot].asleep == 0;
  };
  for (uint32_t slot = 0; slot < stage.joints.count; ++slot) {
    const JointState& joint = stage.joints[slot];
    if (!holds(joint) || (!moves(joint.body_a) && !moves(joint.body_b))) continue;
    const uint32_t index = stage.count++;
    JointWork& work = stage.work[index];
    static_cast<JointWorkStart&>(work) = {};
    work.joint = slot;
    work.rows_max = rows_of(joint);
    work.place = work.coupling = k_no_link;
    work.body[0] = place_of(bodies, joint.body_a, stage);
    work.body[1] = place_of(bodies, joint.body_b, stage);
    link_to(stage, index, 0);
    link_to(stage, index, 1);
    JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    const Position &from = stage.poses[joint.body_a].position, &to = stage.poses[joint.body_b].position;
    work.between = real_difference(to, from);
    extend_arm(a, arm_of_a(joint, work.between));
    extend_arm(b, absolute_sum(joint.anchor_b));
  }
#if DETENT_SPARSE
  collect_anchors(bodies, stage);
#endif
  for (JointBody& body : stage.bodies.first(stage.body_count))
    body.above = body.exponent - bodies.properties[body.slot].size_exponent;
  for (JointWork& work : stage.work.first(stage.count)) {
    const JointState& joint = stage.joints[work.joint];
    work.anchor[0] = clamped_unit(joint.anchor_a, stage.bodies[work.body[0]].exponent);
    work.anchor[1] = clamped_unit(joint.anchor_b, stage.bodies[work.body[1]].exponent);
    for (int end = 0; end < 2; ++end) work.arm_length[end] = length(work.anchor[end]);
    const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    work.exponent = a.exponent < b.exponent ? a.exponent : b.exponent;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
