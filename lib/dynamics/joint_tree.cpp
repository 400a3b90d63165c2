#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "dynamics/spin.h"
#include "math/root.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A row whose response is less than this of what it would be without all other joints is held by those already.
#if defined(DETENT_F32)
constexpr int k_redundant_power = -17;
#else
constexpr int k_redundant_power = -28;
#endif

/// And at least so much, so that its reciprocal is one that multiply() takes.
constexpr Real k_response_min = 0x1p-29;

/// The body's place among those that joints hold; it gets one if it has none.
uint32_t place_of(const SolverBodies& bodies, uint32_t slot, JointStage& stage) {
  uint32_t& place = bodies.work[slot].joint_body;
  if (place != k_no_link) return place;
  place = stage.body_count++;
  JointBody& body = stage.bodies[place];
  static_cast<JointBodyStart&>(body) = {};
  body.slot = slot;
  body.mobile = is_dynamic(bodies.traits[slot]) && stage.activities[slot].asleep == 0 ? 1 : 0;
  body.first = body.last = body.owner = k_no_link;
  body.exponent = bodies.traits[slot].size_exponent;
  body.share = body.turn_share = Scaled(0.0);
  if (body.mobile != 0) return place;
  for (Real(&row)[6] : body.response) {
    for (Real& value : row) value = Real(0.0);
  }
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

/// Makes a body's unit hold an arm of this length.
void reach_out(JointBody& body, Real arm) {
  const int exponent = exponent_above(arm);
  if (exponent > body.exponent) body.exponent = exponent;
}

bool takes_way(const JointState& joint) {
  const JointType type = static_cast<JointType>(joint.type);
  return type == JointType::slider || type == JointType::wheel;
}

}  // namespace

Vec3<Unit> unit_held(const Vec3<Real>& v, int exponent) {
  const Real limit = real_from_unit(Unit(1.875), exponent > 15 ? 15 : exponent);
  const auto part = [&](Real value) { return unit_from_real(clamp(value, -limit, limit), exponent); };
  return {part(v.x), part(v.y), part(v.z)};
}

void collect_joints(const SolverBodies& bodies, JointStage& stage) {
  stage.count = stage.body_count = 0;
  const auto moves = [&](uint32_t slot) {
    return is_dynamic(bodies.traits[slot]) && stage.activities[slot].asleep == 0;
  };
  for (uint32_t slot = 0; slot < stage.joints.count; ++slot) {
    const JointState& joint = stage.joints[slot];
    if (joint.type == 0 || (!moves(joint.body_a) && !moves(joint.body_b))) continue;
    const uint32_t index = stage.count++;
    JointWork& work = stage.work[index];
    static_cast<JointWorkStart&>(work) = {};
    work.joint = slot;
    work.body[0] = place_of(bodies, joint.body_a, stage);
    work.body[1] = place_of(bodies, joint.body_b, stage);
    link_to(stage, index, 0);
    link_to(stage, index, 1);
    JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    const Position &from = stage.poses[joint.body_a].position, &to = stage.poses[joint.body_b].position;
    work.between = real_difference(to, from);
    Real way = Real(0.0);
    if (takes_way(joint)) way = scale_by_power(absolute_sum(work.between) + absolute_sum(joint.anchor_b), 1);
    reach_out(a, max(absolute_sum(joint.anchor_a), way));
    reach_out(b, absolute_sum(joint.anchor_b));
  }
  for (JointBody& body : stage.bodies.first(stage.body_count))
    body.above = body.exponent - bodies.traits[body.slot].size_exponent;
  for (JointWork& work : stage.work.first(stage.count)) {
    const JointState& joint = stage.joints[work.joint];
    work.anchor[0] = unit_held(joint.anchor_a, stage.bodies[work.body[0]].exponent);
    work.anchor[1] = unit_held(joint.anchor_b, stage.bodies[work.body[1]].exponent);
  }
}

namespace {

/// Grows a tree from a body over all that joints hold to it. The order: from the root up.
struct Grower {
  const SolverBodies& bodies;
  JointStage& stage;
  uint32_t placed;      ///< of the order
  uint32_t loops_from;  ///< the end of the order, where those that close loops gather
  Scaled lightest = Scaled(0.0);
  int32_t steepest = 0;  ///< power of two above all responses to a torque

  void meet(JointBody& body) {
    body.met = 1;
    const BodyTraits& traits = bodies.traits[body.slot];
    if (lightest == Scaled(0.0) || less(traits.mass, lightest)) lightest = traits.mass;
#if DETENT_FIXED
    const int32_t turn = bodies.work[body.slot].gyration.exponent + 2 * body.above;
    steepest = turn > steepest ? turn : steepest;
#endif
  }
  /// The joints of a body that has been met: what they hold is met next.
  void branch(uint32_t place) {
    for (uint32_t link = stage.bodies[place].first; link != k_no_link;) {
      const uint32_t index = link / 2, end = link % 2;
      JointWork& work = stage.work[index];
      link = work.next[end];
      if (work.placed != 0) continue;
      JointBody& other = stage.bodies[work.body[1 - end]];
      work.placed = 1;
      work.parent = end;
      if (other.mobile != 0 && other.met != 0) {
        stage.order[--loops_from] = index;
        continue;
      }
      stage.order[placed++] = index;
      ++stage.bodies[place].links;
      ++other.links;
      JointBody& own = stage.bodies[place];
      if (own.owner == k_no_link) own.owner = index;
      if (other.mobile == 0) continue;
      meet(other);
      other.owner = index;
    }
  }
};

}  // namespace

void grow_trees(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                Span<Island> islands, JointStage& stage) {
  uint32_t first = 0;
  for (Island& island : islands) {
    Grower grower = {bodies, stage, first, stage.count};
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t place = bodies.work[slots[island.first_body + i]].joint_body;
      if (place == k_no_link) continue;
      JointBody& root = stage.bodies[place];
      if (root.met != 0) continue;
      const uint32_t from = grower.placed, loops_before = grower.loops_from;
      grower.lightest = Scaled(0.0);
      grower.steepest = 0;
      grower.meet(root);
      grower.branch(place);
      for (uint32_t next = from; next < grower.placed; ++next) {
        const JointWork& work = stage.work[stage.order[next]];
        const uint32_t child = work.body[1 - work.parent];
        if (stage.bodies[child].mobile != 0) grower.branch(child);
      }
      // Responses lie below 2^12, whatever the bodies' proportions.
      const int32_t over = grower.steepest > 12 ? grower.steepest - 12 : 0;
      const Scaled reference = scaled_by_power(grower.lightest, -over);
      const auto weigh = [&](uint32_t index) {
        for (const uint32_t at : stage.work[index].body) {
          JointBody& body = stage.bodies[at];
          if (body.mobile != 0 && body.share == Scaled(0.0))
            body.share = divide(reference, bodies.traits[body.slot].mass);
        }
      };
      for (uint32_t k = from; k < grower.placed; ++k) weigh(stage.order[k]);
      for (uint32_t k = grower.loops_from; k < loops_before; ++k) weigh(stage.order[k]);
    }
    // The loops, in the order in which they were found, follow the trees.
    const uint32_t loops = stage.count - grower.loops_from;
    for (uint32_t k = 0; k < loops / 2; ++k) {
      uint32_t &low = stage.order[grower.loops_from + k], &high = stage.order[stage.count - 1 - k];
      const uint32_t held = low;
      low = high;
      high = held;
    }
    for (uint32_t k = 0; k < loops; ++k) stage.order[grower.placed + k] = stage.order[grower.loops_from + k];
    island.first_joint = first;
    island.joint_count = grower.placed - first;
    island.loop_count = loops;
    first = grower.placed + loops;
  }
  for (JointWork& work : stage.work.first(stage.count)) {
    const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    work.exponent = a.exponent < b.exponent ? a.exponent : b.exponent;
    const auto angular = [&](const JointBody& body) {
      return scaled_by_power(body.share, 2 * (work.exponent - body.exponent + body.above));
    };
    bool saturated = false;
    const auto least = [&](Scaled response) {
      return max(to_real(scaled_by_power(response, k_redundant_power), saturated), k_response_min);
    };
    work.least[0] = least(add(a.share, b.share));
    work.least[1] = least(add(angular(a), angular(b)));
    const JointState& joint = stage.joints[work.joint];
    const JointBody& mobile = a.mobile != 0 ? a : b;
    for (int i = 0; i < 2; ++i) {
      if (!is_positive(joint.force_max[i])) continue;
      const Scaled reference = multiply(bodies.traits[mobile.slot].mass, mobile.share);
      // Torques are over 2^exponent m besides.
      const int power = is_angular(static_cast<JointType>(joint.type), i) ? -work.exponent : 0;
      const Scaled impulse = scaled_by_power(multiply(joint.force_max[i], scaled_from(settings.tick_time)), power);
      work.bound[i] = to_real(divide(impulse, reference), saturated);
    }
  }
  for (Island& island : islands) island.joint_need = squared_substeps(settings, bodies, island, stage);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
