#include "base/heap.h"
#include "joint/joint.h"
#include "math/scaled.h"
#include "motion/step_settings.h"

/// The assemblies of an island, and the order in which the joints of an assembly are eliminated: minimum degree. With
/// this order, the factor of a tree of joints has only the blocks of the tree's own couplings. The factor of a loop has
/// a few blocks more. The order depends only on the graph of the joints and on their slots.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_response_bits = 14;
/// Number of lists of joints by degree. The last list has the joints with a degree of k_degrees - 1 or more.
constexpr uint32_t k_degrees = 32;

class Eliminator {
 public:
  Eliminator(JointStage& stage, uint32_t couplings_used, uint32_t numbers_used)
      : couplings(couplings_used),
        numbers(numbers_used),
        stage_(stage),
        numbers_max_(k_may_have_joint_lanes ? stage.numbers.count / 9 * 4 : stage.numbers.count) {
    for (uint32_t& head : head_) head = k_no_link;
  }
  /// How many elements of JointStage::couplings and JointStage::numbers are used so far; `numbers` does not count the
  /// padding of rows for lanes.
  uint32_t couplings, numbers;
  uint32_t dropped = 0;

  /// Couples all joints of a body with each other.
  void couple_all(const JointBody& body) {
    const uint32_t place = static_cast<uint32_t>(&body - stage_.bodies.data);
    for (uint32_t link = body.first; link != k_no_link;) {
      const uint32_t one = link / 2;
      link = stage_.work[one].next[link % 2];
      for (uint32_t further = link; further != k_no_link;) {
        const uint32_t other = further / 2;
        further = stage_.work[other].next[further % 2];
        if (!is_coupled_before(one, other, place)) couple(one, other);
      }
    }
  }

  /// Eliminates the joints of an assembly, and overwrites `order` with the order of elimination.
  void run(Span<uint32_t> order) {
    const uint32_t count = stage_.work[order[0]].assembly_joints, first_body = stage_.work[order[0]].mark;
    for (const uint32_t joint : order) {
      for (uint32_t end = 0; end < 2; ++end) {
        const JointBody& body = stage_.bodies[stage_.work[joint].body[end]];
        if (body.mobile != 0 && body.first == 2 * joint + end) couple_all(body);
      }
    }
    for (uint32_t k = order.count; k-- > 0;) enter(order[k]);
    for (uint32_t k = 0; k < order.count; ++k) {
      const uint32_t joint = least();
      leave(joint);
      order[k] = joint;
      eliminate(joint, k);
    }
    stage_.work[order[0]].assembly_joints = count;
    stage_.work[order[0]].mark = first_body;
  }

  /// Makes each joint's list of couplings with joints that are eliminated later, sorted by the order of elimination.
  /// Assigns a block to each coupling, in the order of elimination of the later joint: the blocks are the elements of
  /// JointStage::numbers directly before `end`. Sets `end` to the first of these elements.
  void list_columns(Span<const uint32_t> order, uint32_t from, uint32_t& end) {
    for (const uint32_t joint : order) stage_.work[joint].coupling = stage_.work[joint].around[0] = k_no_link;
    for (uint32_t k = from; k < couplings; ++k) {
      JointCoupling& coupling = stage_.couplings[k];
      if (stage_.work[coupling.joint[1]].place < stage_.work[coupling.joint[0]].place) {
        const uint32_t first = coupling.joint[1];
        coupling.joint[1] = coupling.joint[0];
        coupling.joint[0] = first;
      }
      uint32_t& head = stage_.work[coupling.joint[1]].around[0];
      coupling.next[1] = head;
      head = k;
    }
    for (uint32_t place = order.count; place-- > 0;) {
      const JointWork& other = stage_.work[order[place]];
      for (uint32_t k = other.around[0]; k != k_no_link; k = stage_.couplings[k].next[1]) {
        JointCoupling& coupling = stage_.couplings[k];
        JointWork& first = stage_.work[coupling.joint[0]];
        end -= first.rows_max * block_stride(other.rows_max);
        coupling.block = end;
        coupling.next[0] = first.coupling;
        first.coupling = k;
      }
    }
  }

 private:
  JointStage& stage_;
  uint32_t numbers_max_;
  /// First joint in the list of each degree.
  uint32_t head_[k_degrees];

  /// Whether two joints of the body `place` also share their other body and have been coupled there: that body is
  /// mobile, and its index is below `place`.
  bool is_coupled_before(uint32_t one, uint32_t other, uint32_t place) const {
    const JointWork &p = stage_.work[one], &q = stage_.work[other];
    const auto holds = [](const JointWork& work, uint32_t body) {
      return work.body[0] == body || work.body[1] == body;
    };
    const uint32_t far = p.body[0] == place ? p.body[1] : p.body[0];
    return holds(q, far) && stage_.bodies[far].mobile != 0 && far < place;
  }

  void couple(uint32_t one, uint32_t other) {
    JointWork &p = stage_.work[one], &q = stage_.work[other];
    const uint32_t size = p.rows_max * q.rows_max;
    if (couplings == stage_.couplings.count || numbers + size > numbers_max_) {
      ++dropped;
      return;
    }
    JointCoupling& coupling = stage_.couplings[couplings];
    coupling.joint[0] = one;
    coupling.joint[1] = other;
    coupling.next[0] = p.coupling;
    coupling.next[1] = q.coupling;
    p.coupling = 2 * couplings;
    q.coupling = 2 * couplings + 1;
    ++p.degree;
    ++q.degree;
    ++couplings;
    numbers += size;
  }

  uint32_t& head_of(uint32_t joint) {
    const uint32_t degree = stage_.work[joint].degree;
    return head_[degree < k_degrees ? degree : k_degrees - 1];
  }
  void enter(uint32_t joint) {
    uint32_t& head = head_of(joint);
    JointWork& work = stage_.work[joint];
    work.place = work.around[0] = k_no_link;
    work.around[1] = head;
    if (head != k_no_link) stage_.work[head].around[0] = joint;
    head = joint;
  }
  void leave(uint32_t joint) {
    const JointWork& work = stage_.work[joint];
    if (work.around[0] == k_no_link)
      head_of(joint) = work.around[1];
    else
      stage_.work[work.around[0]].around[1] = work.around[1];
    if (work.around[1] != k_no_link) stage_.work[work.around[1]].around[0] = work.around[0];
  }
  uint32_t least() const {
    uint32_t degree = 0;
    while (head_[degree] == k_no_link) ++degree;
    return head_[degree];
  }

  /// Returns the next joint of a list of couplings that is not eliminated, or k_no_link after the last. Moves `link`
  /// past this joint, and removes the eliminated joints before it from the list.
  DETENT_SHARED uint32_t next_neighbour(uint32_t*& link) {
    while (*link != k_no_link) {
      JointCoupling& coupling = stage_.couplings[*link / 2];
      const uint32_t end = *link % 2, other = coupling.joint[1 - end];
      if (stage_.work[other].place == k_no_link) {
        link = &coupling.next[end];
        return other;
      }
      *link = coupling.next[end];
    }
    return k_no_link;
  }
  /// Visits the neighbours of a joint that are not eliminated.
  template <class Visit>
  void each_neighbour(uint32_t joint, const Visit& visit) {
    uint32_t* link = &stage_.work[joint].coupling;
    for (uint32_t other; (other = next_neighbour(link)) != k_no_link;) visit(other);
  }

  /// Eliminates a joint, as number `place` of the order: couples its neighbours with each other, if they are not
  /// coupled yet.
  void eliminate(uint32_t joint, uint32_t place) {
    stage_.work[joint].place = place;
    each_neighbour(joint, [&](uint32_t one) {
      JointWork& work = stage_.work[one];
      leave(one);
      --work.degree;
      const uint32_t mark = one + 1;
      each_neighbour(one, [&](uint32_t known) { stage_.work[known].mark = mark; });
      each_neighbour(joint, [&](uint32_t other) {
        if (other == one || stage_.work[other].mark == mark) return;
        leave(other);
        couple(one, other);
        enter(other);
      });
      enter(one);
    });
  }
};

/// Writes the joints of an assembly to `order`, in the order of their slots. `joint` is the assembly's joint with the
/// lowest slot. Links the mobile bodies of the assembly. Returns the number of joints.
uint32_t list_assembly(uint32_t joint, JointStage& stage, uint32_t* order) {
  uint32_t count = 0, last_body = k_no_link;
  const auto add = [&](uint32_t index) {
    uint32_t& place = stage.work[index].place;
    if (place == k_no_link) order[count++] = index;
    place = 0;
  };
  add(joint);
  for (uint32_t k = 0; k < count; ++k) {
    for (const uint32_t at : stage.work[order[k]].body) {
      JointBody& body = stage.bodies[at];
      if (body.mobile == 0 || body.next != k_no_link) continue;
      (last_body == k_no_link ? stage.work[joint].mark : stage.bodies[last_body].next) = at;
      body.next = last_body = at;
      for (uint32_t link = body.first; link != k_no_link; link = stage.work[link / 2].next[link % 2]) add(link / 2);
    }
  }
  heap_sort(Span<uint32_t>{order, count}, [](uint32_t a, uint32_t b) { return a < b; });
  stage.work[joint].assembly_joints = count;
  return count;
}

/// Chooses the reference mass of the assembly. In fixed point, the largest response of its bodies is then near
/// 2^k_response_bits, for any shape of the bodies, so that impulses are as small as possible. In float, it is the mass
/// of the lightest body.
void weigh(const SolverBodies& bodies, Span<const uint32_t> order, JointStage& stage) {
  Scaled most = Scaled(0.0);  // largest response to a torque
  each_mobile_body(order, stage, [&](const JointBody& body) {
    const int exponent = DETENT_FIXED ? bodies.work[body.slot].inverse_inertia.exponent + 2 * body.above : 0;
    const Scaled own =
        scaled_by_power(divide(Scaled(1.0), bodies.properties[body.slot].mass), exponent < 0 ? 0 : exponent);
    if (less(most, own)) most = own;
  });
  if (!is_positive(most)) return;
  const Scaled reference = scaled_by_power(divide(Scaled(1.0), most), DETENT_FIXED ? k_response_bits : 0);
  each_mobile_body(order, stage,
                   [&](JointBody& body) { body.inverse_mass = divide(reference, bodies.properties[body.slot].mass); });
}

/// Sets the joint's mass ratios to the mass of its lighter body, because stored impulses are relative to that mass.
/// Sets the largest impulses of motors, springs and friction.
void weigh_joint(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage, JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  Scaled lighter = Scaled(0.0);
  for (const uint32_t place : work.body) {
    const JointBody& body = stage.bodies[place];
    const Scaled mass = bodies.properties[body.slot].mass;
    if (body.mobile == 0 || (is_positive(lighter) && !less(mass, lighter))) continue;
    lighter = mass;
    work.over_lighter = body.inverse_mass;
  }
  for (uint32_t end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    work.lighter_over[end] = body.mobile != 0 ? divide(lighter, bodies.properties[body.slot].mass) : Scaled(0.0);
  }
  const Scaled reference = multiply(lighter, work.over_lighter);
  bool saturated = false;
  const auto bound = [&](Scaled force, bool angular) {
    const int power = angular ? -work.exponent : 0;  // torques are also divided by 2^exponent m
    const Scaled impulse = scaled_by_power(multiply(force, scaled_from(settings.tick_time)), power);
    return to_real(divide(impulse, reference), saturated);
  };
  for (int i = 0; i < 2; ++i) {
    if (is_positive(joint.force_max[i]))
      work.bound[i] = bound(joint.force_max[i], is_angular(static_cast<JointType>(joint.type), i));
  }
  for (int kind = 0; kind < 2; ++kind) {
    if (is_positive(joint.friction[kind])) work.brake[kind] = bound(joint.friction[kind], kind == 1);
  }
}

}  // namespace

uint32_t order_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      Span<Island> islands, JointStage& stage) {
  // Count the joints of each island, then list them: by island, and assembly by assembly.
  const auto island_of = [&](const JointWork& work) -> Island& {
    const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    return islands[bodies.work[a.mobile != 0 ? a.slot : b.slot].island];
  };
  for (const JointWork& work : stage.work.first(stage.count)) ++island_of(work).joint_count;
  uint32_t first = 0;
  for (Island& island : islands) {
    island.first_joint = first;
    first += island.joint_count;
    island.joint_count = 0;
  }
  for (uint32_t index = 0; index < stage.count; ++index) {
    if (stage.work[index].place != k_no_link) continue;
    Island& island = island_of(stage.work[index]);
    island.joint_count += list_assembly(index, stage, &stage.order[island.first_joint + island.joint_count]);
  }
  uint32_t couplings = 0, numbers = 0, dropped = 0, blocks = stage.numbers.count;
  for (Island& island : islands) {
    island.joint_couplings_dropped = 0;
    each_assembly(island, stage, [&](Span<uint32_t> order) {
      Eliminator eliminator(stage, couplings, numbers);
      eliminator.run(order);
      eliminator.list_columns(order, couplings, blocks);
      weigh(bodies, order, stage);
      couplings = eliminator.couplings;
      numbers = eliminator.numbers;
      island.joint_couplings_dropped += eliminator.dropped;
    });
    dropped += island.joint_couplings_dropped;
  }
#if DETENT_SPARSE
  stage.couplings_used = couplings;
  stage.numbers_used = numbers;
#endif
  for (JointWork& work : stage.work.first(stage.count)) weigh_joint(settings, bodies, stage, work);
  for (Island& island : islands) require_substeps(settings, bodies, slots, stage, island);
  return dropped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
