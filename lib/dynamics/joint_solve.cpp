#include "dynamics/contact_motion.h"
#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "dynamics/joint_anchor.h"
#include "dynamics/joint_elimination.h"
#include "dynamics/spin.h"
#include "math/rotation.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_decisions = 4;  ///< tries to solve with limits and motors as they must be
constexpr uint32_t k_loop_sweeps = 6;

/// Solves one island's joints.
struct Solver {
  const StepSettings& settings;
  const SolverBodies& bodies;
  JointStage& stage;
  Span<const uint32_t> trees, loops;  ///< of the work, from the roots up
  bool touches;                       ///< the island has contacts, which read the bodies' spins
  uint32_t clamped = 0;
  bool loaded = false;  ///< the bodies' motions are

  JointBody& end_of(const JointWork& work, uint32_t end) const { return stage.bodies[work.body[end]]; }
  /// Visits the bodies of the trees, each once.
  template <class Visit>
  void each_body(const Visit& visit) {
    for (const uint32_t index : trees) {
      for (const uint32_t place : stage.work[index].body) {
        JointBody& body = stage.bodies[place];
        if (body.mobile != 0 && body.owner == index) visit(body);
      }
    }
  }

  void load_motion(JointBody& body) {
    const BodyMotion& motion = bodies.motions[body.slot];
    body.velocity = motion.velocity;
    body.spin = world_spin(bodies.traits[body.slot], bodies.work[body.slot].gyration, motion.momentum, body.above);
  }
  /// A body as it is now, without its joints; by anchor, what it shows at its owner's.
  void load(JointBody& body) {
    const BodyWork& now = bodies.work[body.slot];
    body.force = body.torque = body.given_force = body.given_torque = k_zero_vector;
    if (!loaded) load_motion(body);
    const Scaled turn = scaled_by_power(body.turn_share, now.gyration.exponent + body.above);
    bool saturated = false;
    body.pushed = to_real(body.share, saturated);
    DETENT_UNROLL
    for (int i = 0; i < 3; ++i) body.turned[i] = multiply(real_from(now.gyration.row[i]), turn);
    if (body.by_anchor != 0) {
      const Vec3<Unit>& arm = owner_arm(body);
      body.anchor_velocity = body.velocity + cross(body.spin, arm);
      show_at_itself(body, TurnByForce(body, arm), arm, body.response);
      return;
    }
    DETENT_UNROLL
    for (int i = 0; i < 3; ++i) {
      DETENT_UNROLL
      for (int j = 0; j < 6; ++j) body.response[i][j] = body.response[i + 3][j] = k_zero;
      body.response[i][i] = body.pushed;
      body.response[i + 3][3] = body.turned[i].x;
      body.response[i + 3][4] = body.turned[i].y;
      body.response[i + 3][5] = body.turned[i].z;
    }
  }
  const Vec3<Unit>& owner_arm(const JointBody& body) const {
    const JointWork& owner = stage.work[body.owner];
    return owner.arm[&end_of(owner, 1) == &body ? 1 : 0];
  }

  /// A wrench that acts without a row, on one body.
  void give(JointBody& body, const Vec3<Real>& force, const Vec3<Real>& torque) {
    if (body.mobile == 0) return;
    body.given_force += force;
    body.given_torque += torque;
    body.velocity += multiply(force, body.share);
    body.spin += Vec3<Real>{dot(last_three(body.response[3]), torque), dot(last_three(body.response[4]), torque),
                            dot(last_three(body.response[5]), torque)};
  }

  /// Motors at their greatest force, and soft springs, push without a row.
  void push(const JointWork& work) {
    for (int i = 0; i < 2; ++i) {
      if (work.constant[i] == k_zero) continue;
      const JointRow& row = work.free_row[i];
      const Real impulse = work.constant[i];
      give(end_of(work, 1), real_from(row.axis) * impulse, real_from(row.arm[1]) * impulse);
      give(end_of(work, 0), real_from(row.axis) * -impulse, real_from(row.arm[0]) * -impulse);
    }
  }

  void missing_speeds(const JointWork& work, Real (&missing)[k_joint_rows_max]) {
    Real of_a[k_joint_rows_max], of_b[k_joint_rows_max];
    const JointBody &a = end_of(work, 0), &b = end_of(work, 1);
    show(work, 0, a.velocity, a.spin, of_a);
    show(work, 1, b.velocity, b.spin, of_b);
    for (uint32_t k = 0; k < work.rows; ++k) missing[k] = work.wanted[k] - (of_b[k] - of_a[k]);
    for (int i = 0; i < 2; ++i) {
      const uint32_t row = work.driven[i];
      if (row != k_joint_rows_max) missing[row] -= work.softness[row] * work.driven_total[i];
    }
  }

  /// L^-1 of the missing speeds, over the pivots.
  template <bool only_points>
  void start_impulses(JointWork& work, Real (&missing)[k_joint_rows_max]) {
    const uint32_t rows = only_points ? 3 : work.rows;
    DETENT_UNROLL
    for (uint32_t k = 0; k < rows; ++k) {
      for (uint32_t m = 0; m < k; ++m) missing[k] -= work.lower[k][m] * missing[m];
      bool saturated = false;
      work.start[k] =
          clamp(multiply(missing[k], work.inverse[k], saturated), -k_joint_impulse_max, k_joint_impulse_max);
      if (saturated) ++clamped;
    }
  }

  void eliminate(JointWork& work) {
    JointBody &parent = end_of(work, work.parent), &child = end_of(work, 1 - work.parent);
    Real response[k_joint_rows_max][k_joint_rows_max];
    for (uint32_t k = 0; k < work.rows; ++k) {
      for (uint32_t m = 0; m <= k; ++m) response[k][m] = k_zero;
    }
    if (child.mobile != 0) {
      respond<false>(work, child, 1 - work.parent, work.reply);
      couple<false>(work, 1 - work.parent, work.reply, response);
    }
    respond<false>(work, parent, work.parent, work.reply);
    couple<false>(work, work.parent, work.reply, response);
    factor<false>(response, work);
    substitute<6>(work.rows, work);
    take_from<false>(work, parent);
  }

  /// Likewise of a joint that holds a point alone.
  void eliminate_point(uint32_t index) {
    JointWork& work = stage.work[index];
    JointBody &parent = end_of(work, work.parent), &child = end_of(work, 1 - work.parent);
    Real response[k_joint_rows_max][k_joint_rows_max];
    DETENT_UNROLL
    for (int k = 0; k < 3; ++k) {
      for (int m = 0; m <= k; ++m) response[k][m] = k_zero;
    }
    const auto add = [&](const auto& shown) {
      DETENT_UNROLL
      for (int k = 0; k < 3; ++k) {
        DETENT_UNROLL
        for (int m = 0; m <= k; ++m) response[k][m] += shown[k][m];
      }
    };
    const auto add_whole = [&](JointBody& body, uint32_t end) {
      respond<true>(work, body, end, work.reply);
      couple<true>(work, end, work.reply, response);
    };
    if (child.mobile != 0) {
      if (child.by_anchor != 0)
        add(child.response);
      else
        add_whole(child, 1 - work.parent);
    }
    work.width = 0;
    if (parent.mobile != 0) {
      if (parent.by_anchor == 0) {
        work.width = 6;
        add_whole(parent, work.parent);
      } else if (parent.owner == index) {
        add(parent.response);
      } else {
        work.width = 3;
        const Vec3<Unit>& arm = work.arm[work.parent];
        const TurnByForce turn(parent, arm);
        Real shown[3][3];
        show_at_itself(parent, turn, arm, shown);
        add(shown);
        show_at(parent, turn, owner_arm(parent), work.reply);
      }
    }
    factor<true>(response, work);
    if (work.width == 6) {
      substitute<6>(3, work);
      take_from<true>(work, parent);
    } else if (work.width == 3) {
      substitute<3>(3, work);
      DETENT_UNROLL
      for (int i = 0; i < 3; ++i) {
        DETENT_UNROLL
        for (int j = 0; j <= i; ++j)
          parent.response[i][j] -= dot(replies(work.reply, i), replies(work.reply_scaled, j));
      }
    }
  }
  static Vec3<Real> replies(const Reply& reply, int i) { return {reply[0][i], reply[1][i], reply[2][i]}; }

  /// The velocity of a point's end as the joints eliminated so far leave it.
  Vec3<Real> velocity_of(const JointWork& work, uint32_t index, uint32_t end) const {
    const JointBody& body = end_of(work, end);
    if (body.by_anchor != 0 && body.owner == index) return body.anchor_velocity;
    return body.velocity + cross(body.spin, work.arm[end]);
  }

  /// The parent moves as the joint, held, moves it.
  void take_up(JointWork& work) {
    Real missing[k_joint_rows_max];
    missing_speeds(work, missing);
    start_impulses<false>(work, missing);
    move_parent(work.rows, work);
  }
  void take_up_point(uint32_t index) {
    JointWork& work = stage.work[index];
    const Vec3<Real> apart = velocity_of(work, index, 1) - velocity_of(work, index, 0);
    Real missing[k_joint_rows_max];
    missing[0] = work.wanted[0] - apart.x;
    missing[1] = work.wanted[1] - apart.y;
    missing[2] = work.wanted[2] - apart.z;
    start_impulses<true>(work, missing);
    if (work.width == 6) {
      move_parent(3, work);
    } else if (work.width == 3) {
      JointBody& parent = end_of(work, work.parent);
      const Vec3<Real> start = {work.start[0], work.start[1], work.start[2]};
      const Vec3<Real> moved = {dot(replies(work.reply, 0), start), dot(replies(work.reply, 1), start),
                                dot(replies(work.reply, 2), start)};
      if (work.parent == 1)
        parent.anchor_velocity += moved;
      else
        parent.anchor_velocity -= moved;
    }
  }
  void move_parent(uint32_t rows, const JointWork& work) {
    JointBody& parent = end_of(work, work.parent);
    for (uint32_t k = 0; k < rows; ++k) {
      const Real impulse = work.parent == 1 ? work.start[k] : -work.start[k];
      parent.velocity += first_three(work.reply[k]) * impulse;
      parent.spin += last_three(work.reply[k]) * impulse;
    }
  }

  /// The impulses, once all that the parent gets from above is known.
  template <bool only_points>
  void come_down(JointWork& work) {
    // The bound is for GCC, which at -O3 sees rows beyond the last.
    const uint32_t rows = only_points ? 3 : work.rows < k_joint_rows_max ? work.rows : k_joint_rows_max;
    JointBody &parent = end_of(work, work.parent), &child = end_of(work, 1 - work.parent);
    const bool parent_is_b = work.parent == 1;
    const uint32_t width = only_points ? work.width : 6;
    DETENT_UNROLL
    for (uint32_t k = 0; k < rows; ++k) {
      Real from_above = k_zero;
      if (width != 0) from_above = dot(parent.force, first_three(work.reply_scaled[k]));
      if (width == 6) from_above += dot(parent.torque, last_three(work.reply_scaled[k]));
      work.impulse[k] = parent_is_b ? work.start[k] - from_above : work.start[k] + from_above;
    }
    for (uint32_t k = rows; k-- > 0;) {
      Real& impulse = work.impulse[k];
      for (uint32_t m = k + 1; m < rows; ++m) impulse -= work.lower[m][k] * work.impulse[m];
      const Real within = clamp(impulse, -k_joint_impulse_max, k_joint_impulse_max);
      if (!(within == impulse)) ++clamped;
      impulse = within;
    }
    const auto put = [&](JointBody& body, uint32_t end) {
      if (body.mobile == 0) return;
      Vec3<Real> force, torque;
      gather<only_points>(work, end, force, torque);
      if (end == 1) {
        body.force += force;
        body.torque += torque;
      } else {
        body.force -= force;
        body.torque -= torque;
      }
    };
    put(parent, work.parent);
    put(child, 1 - work.parent);
  }

  static bool is_only_points(const JointWork& work) { return work.points != 0 && work.rows == 3; }

  /// Which bodies points alone hold, and nothing else pushes.
  void find_by_anchor() {
    each_body([](JointBody& body) { body.by_anchor = body.links <= 2 ? 1 : 0; });
    for (const uint32_t index : trees) {
      const JointWork& work = stage.work[index];
      if (is_only_points(work) && work.constant[0] == k_zero && work.constant[1] == k_zero) continue;
      end_of(work, 0).by_anchor = end_of(work, 1).by_anchor = 0;
    }
    for (const uint32_t index : loops) {
      const JointWork& work = stage.work[index];
      end_of(work, 0).by_anchor = end_of(work, 1).by_anchor = 0;
    }
  }

  void solve_trees() {
    for (uint32_t k = trees.count; k-- > 0;) {
      JointWork& work = stage.work[trees[k]];
      if (is_only_points(work)) {
        eliminate_point(trees[k]);
        take_up_point(trees[k]);
      } else if (work.rows != 0) {
        eliminate(work);
        take_up(work);
      }
    }
    for (const uint32_t index : trees) {
      JointWork& work = stage.work[index];
      if (is_only_points(work))
        come_down<true>(work);
      else if (work.rows != 0)
        come_down<false>(work);
    }
  }

  bool revise(bool changes) {
    bool wrong = false;
    for (const uint32_t index : trees) {
      JointWork& work = stage.work[index];
      if (revise_drives(stage.joints[work.joint], settings.share, changes, work)) wrong = true;
    }
    return wrong;
  }

  /// Where the bodies are now.
  void place(Real elapsed) {
    each_body([&](JointBody& body) {
      BodyWork& now = bodies.work[body.slot];
      body.rotation = now.rotation;
      body.place = now.displacement;
      if (elapsed == k_zero) {
        body.axes = now.axes;
      } else {
        body.axes = matrix_from(now.rotation);
        now.gyration = world_gyration(bodies.traits[body.slot], body.axes);
      }
      load_motion(body);
    });
    const auto place_still = [&](Span<const uint32_t> joints) {
      for (const uint32_t index : joints) {
        for (const uint32_t at : stage.work[index].body) {
          JointBody& body = stage.bodies[at];
          if (body.mobile != 0) continue;
          const BodyTraits& traits = bodies.traits[body.slot];
          const BodyMotion& motion = bodies.motions[body.slot];
          const BodyWork& now = bodies.work[body.slot];
          const bool moves = type_of(traits) == BodyType::kinematic;
          Quat rotation = now.rotation;
          body.velocity = body.spin = k_zero_vector;
          if (moves) {
            Vec3<Real> spin;
            turn_freely(traits, now.free_turn, motion.momentum, elapsed, 0, rotation, spin);
            body.velocity = motion.velocity;
            body.spin = world_spin(traits, now.gyration, motion.momentum, body.above);
          }
          body.rotation = rotation;
          body.axes = matrix_from(rotation);
          body.place = body.velocity * elapsed;
        }
      }
    };
    place_still(trees);
    place_still(loops);
  }

  void make_rows(Span<const uint32_t> joints) {
    for (const uint32_t index : joints) {
      JointWork& work = stage.work[index];
      make_joint_rows(settings, stage, work);
      for (Real& total : work.total) total = k_zero;
      choose_drives(settings, bodies, stage, work);
    }
  }

  /// Holds the trees, until all limits and motors are as they were taken to be.
  void solve_held(uint32_t& undecided) {
    for (uint32_t decision = 1;; ++decision) {
      for (const uint32_t index : trees) add_driven_rows(settings, bodies, stage, stage.work[index]);
      find_by_anchor();
      each_body([&](JointBody& body) { load(body); });
      loaded = false;
      for (const uint32_t index : trees) push(stage.work[index]);
      solve_trees();
      const bool last = decision == k_decisions;
      if (!revise(!last)) break;
      if (!last) continue;
      ++undecided;
      break;
    }
    each_body([&](JointBody& body) { apply(body); });
    for (const uint32_t index : trees) count_in(stage.work[index]);
  }

  /// What has acted counts among what the joint gives in this substep.
  static void count_in(JointWork& work) {
    for (uint32_t k = 0; k < work.rows_held; ++k) work.total[k] += work.impulse[k];
    for (int i = 0; i < 2; ++i) {
      if (work.driven[i] != k_joint_rows_max) work.driven_total[i] += work.impulse[work.driven[i]];
      work.given[i] += work.constant[i];
      work.constant[i] = k_zero;
    }
  }

  /// The reactions of a joint.
  static void add_up(JointWork& work) {
    if (work.points != 0) work.force_sum += Vec3<Real>{work.total[0], work.total[1], work.total[2]};
    for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows_held; ++k) add_row(work, work.row[k], work.total[k]);
    for (int i = 0; i < 2; ++i) {
      if (!(work.driven_total[i] == k_zero)) add_row(work, work.free_row[i], work.driven_total[i]);
    }
    for (int i = 0; i < 2; ++i) {
      if (!(work.given[i] == k_zero)) add_row(work, work.free_row[i], work.given[i]);
    }
  }
  static void add_row(JointWork& work, const JointRow& row, Real impulse) {
    if (is_linear(row))
      work.force_sum += real_from(row.axis) * impulse;
    else
      work.torque_sum += real_from(row.arm[1]) * impulse;
  }

  /// What the next substep starts from.
  void keep(const JointWork& work, Scaled over_share) {
    Real(&kept)[k_joint_rows_max] = stage.joints[work.joint].impulse;
    bool saturated = false;
    const auto store = [&](uint32_t k, Real total) {
      const Real impulse = multiply(total, over_share, saturated);
      kept[k] = clamp(impulse, -k_joint_impulse_max, k_joint_impulse_max);
      if (!(kept[k] == impulse)) ++clamped;
    };
    for (uint32_t k = 0; k < work.rows_held; ++k) store(k, work.total[k]);
    for (uint32_t i = 0; i < 2 && work.rows_held + i < k_joint_rows_max; ++i)
      store(work.rows_held + i, work.driven_total[i]);
  }

  /// Puts on what the joints that close loops gave in the last substep.
  void start_loops() {
    for (const uint32_t index : loops) {
      JointWork& work = stage.work[index];
      add_driven_rows(settings, bodies, stage, work);
      const JointState& joint = stage.joints[work.joint];
      const Scaled share = scaled_by_power(settings.share, k_kept_power);
      for (uint32_t k = 0; k < work.rows; ++k)
        work.impulse[k] = k < work.rows_held ? multiply(joint.impulse[k], share) : k_zero;
      load_ends(work);
      push(work);
      put_on(work);
    }
  }
  void load_ends(const JointWork& work) {
    for (uint32_t end = 0; end < 2; ++end) {
      if (end_of(work, end).mobile != 0) load(end_of(work, end));
    }
  }
  /// The impulses of a joint by itself become its bodies' motion.
  void put_on(JointWork& work) {
    for (uint32_t end = 0; end < 2; ++end) {
      JointBody& body = end_of(work, end);
      if (body.mobile == 0) continue;
      gather<false>(work, end, body.force, body.torque);
      if (end == 0) {
        body.force = -body.force;
        body.torque = -body.torque;
      }
      apply(body);
    }
    count_in(work);
  }
  /// Holds a joint by itself, as its bodies move now.
  void hold_loop(JointWork& work) {
    load_ends(work);
    eliminate(work);
    load_ends(work);
    Real missing[k_joint_rows_max];
    missing_speeds(work, missing);
    start_impulses<false>(work, missing);
    for (uint32_t k = work.rows; k-- > 0;) {
      work.impulse[k] = work.start[k];
      for (uint32_t m = k + 1; m < work.rows; ++m) work.impulse[k] -= work.lower[m][k] * work.impulse[m];
    }
    for (int i = 0; i < 2; ++i) {
      const uint32_t row = work.driven[i];
      if (row == k_joint_rows_max) continue;
      // Limits push one way, motors no more than they can.
      const DriveMode mode = work.mode[i];
      const bool limits = mode == DriveMode::lower || mode == DriveMode::upper;
      const Real before = limits ? work.driven_total[i] : work.driven_total[i] + work.given[i];
      const Real most = mode == DriveMode::upper ? k_zero : bound_of(work, i);
      const Real least = mode == DriveMode::lower ? k_zero : -bound_of(work, i);
      work.impulse[row] = clamp(before + work.impulse[row], least, most) - before;
    }
    put_on(work);
  }
  Real bound_of(const JointWork& work, int i) const {
    const bool bounded = (work.mode[i] == DriveMode::rigid || work.mode[i] == DriveMode::spring) &&
                         is_positive(stage.joints[work.joint].force_max[i]);
    return bounded ? multiply(work.bound[i], settings.share) : k_joint_impulse_max;
  }

  /// What the joints have given the bodies becomes their motion. Both bodies of a joint got the same impulse.
  void apply(JointBody& body) {
    const Vec3<Real> force = body.force + body.given_force, torque = body.torque + body.given_torque;
    BodyMotion& motion = bodies.motions[body.slot];
    BodyWork& now = bodies.work[body.slot];
    const Vec3<Real> velocity = multiply(force, body.share);
    const Vec3<Real> momentum = multiply(torque, body.turn_share);
    motion.velocity += velocity;
    motion.momentum += momentum;
    if (DETENT_FIXED) {  // it is not the contacts' (contact_motion.h)
      now.contact_velocity -= velocity;
      now.contact_momentum -= momentum;
    }
    if (touches) now.spin = world_spin(bodies.traits[body.slot], now.gyration, motion.momentum, -k_spin_power);
    body.force = body.torque = body.given_force = body.given_torque = k_zero_vector;
  }
};

}  // namespace

uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                      JointStage& stage, uint32_t& undecided) {
  const Span<const uint32_t> trees = {stage.order.data + island.first_joint, island.joint_count};
  const Span<const uint32_t> loops = {stage.order.data + island.first_joint + island.joint_count, island.loop_count};
  Solver solver = {settings, bodies, stage, trees, loops, island.contact_count != 0};
  solver.place(elapsed);
  solver.loaded = loops.count == 0;
  solver.make_rows(trees);
  solver.make_rows(loops);
  const Span<const uint32_t> all = {trees.data, trees.count + loops.count};
  hold_sway(settings, bodies, all, elapsed == k_zero, stage);
  solver.start_loops();
  solver.solve_held(undecided);
  for (uint32_t sweep = 0; sweep < k_loop_sweeps && loops.count != 0; ++sweep) {
    for (const uint32_t index : loops) solver.hold_loop(stage.work[index]);
    solver.solve_held(undecided);
  }
  const Scaled over_share = scaled_by_power(scaled_from_count(settings.substeps), -k_kept_power);
  for (const uint32_t index : all) {
    JointWork& work = stage.work[index];
    solver.add_up(work);
    solver.keep(work, over_share);
  }
  return solver.clamped;
}

void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage) {
  const Scaled rate = divide(Scaled(1.0), scaled_from(settings.tick_time));
  for (const JointWork& work : stage.work.first(stage.count)) {
    const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    const JointBody& mobile = b.mobile != 0 ? b : a;
    const Scaled unit = multiply(multiply(bodies.traits[mobile.slot].mass, mobile.share), rate);
    const auto store = [&](const Vec3<Real>& sum, int power, Vec3<Scaled>& to) {
      const Scaled factor = scaled_by_power(unit, power);
      to = {multiply(scaled_from(sum.x), factor), multiply(scaled_from(sum.y), factor),
            multiply(scaled_from(sum.z), factor)};
    };
    JointState& joint = stage.joints[work.joint];
    store(work.force_sum, 0, joint.force);
    store(work.torque_sum, b.exponent, joint.torque);
  }
}

const JointCode k_joint_code = {collect_joints, grow_trees, solve_joints, store_reactions};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
