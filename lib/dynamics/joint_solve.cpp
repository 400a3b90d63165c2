#include "base/unroll.h"
#include "dynamics/contact_motion.h"
#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "dynamics/spin.h"
#include "math/rotation.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_zero = 0.0;
constexpr Vec3<Real> k_none = {k_zero, k_zero, k_zero};

constexpr uint32_t k_decisions = 4;  ///< tries to solve with limits and motors as they must be
constexpr uint32_t k_loop_sweeps = 6;

Vec3<Real> real_from(const Vec3<Unit>& v) {
  return {real_from_unit(v.x, 0), real_from_unit(v.y, 0), real_from_unit(v.z, 0)};
}

bool is_linear(const JointRow& row) { return !(row.axis == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}); }

/// What a body's velocity and spin become for each row's unit of impulse.
using Reply = Real[k_joint_rows_max][6];

Vec3<Real> first_three(const Real (&six)[6]) { return {six[0], six[1], six[2]}; }
Vec3<Real> last_three(const Real (&six)[6]) { return {six[3], six[4], six[5]}; }

template <bool only_points>
void respond(const JointWork& work, const JointBody& body, uint32_t end, Reply& reply) {
  if (only_points || work.points != 0) {
    const Vec3<Unit> arm = work.arm[end];
    DETENT_UNROLL
    for (int i = 0; i < 6; ++i) {
      const Vec3<Real> by = first_three(body.response[i]) + cross(last_three(body.response[i]), arm);
      reply[0][i] = by.x;
      reply[1][i] = by.y;
      reply[2][i] = by.z;
    }
  }
  if (only_points) return;
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows; ++k) {
    const Vec3<Unit> axis = work.row[k].axis, arm = work.row[k].arm[end];
    DETENT_UNROLL
    for (int i = 0; i < 6; ++i)
      reply[k][i] = dot(first_three(body.response[i]), axis) + dot(last_three(body.response[i]), arm);
  }
}

/// Adds what a body's reply shows in the rows to the lower half of their response.
template <bool only_points>
void couple(const JointWork& work, uint32_t end, const Reply& reply,
            Real (&response)[k_joint_rows_max][k_joint_rows_max]) {
  if (only_points || work.points != 0) {
    DETENT_UNROLL
    for (int by = 0; by < 3; ++by) {
      const Vec3<Real> shown = first_three(reply[by]) + cross(last_three(reply[by]), work.arm[end]);
      if (by == 0) response[0][0] += shown.x;
      if (by <= 1) response[1][by] += shown.y;
      response[2][by] += shown.z;
    }
  }
  if (only_points) return;
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows; ++k) {
    const Vec3<Unit>&axis = work.row[k].axis, &arm = work.row[k].arm[end];
    for (uint32_t by = 0; by <= k; ++by)
      response[k][by] += dot(first_three(reply[by]), axis) + dot(last_three(reply[by]), arm);
  }
}

/// The speeds of the rows that a body's motion gives.
template <bool only_points>
void show(const JointWork& work, uint32_t end, const Vec3<Real>& velocity, const Vec3<Real>& spin,
          Real (&speed)[k_joint_rows_max]) {
  if (only_points || work.points != 0) {
    const Vec3<Real> at_point = velocity + cross(spin, work.arm[end]);
    speed[0] = at_point.x;
    speed[1] = at_point.y;
    speed[2] = at_point.z;
  }
  if (only_points) return;
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows; ++k)
    speed[k] = dot(velocity, work.row[k].axis) + dot(spin, work.row[k].arm[end]);
}

/// The force and the torque of the rows' impulses on a body.
template <bool only_points>
void gather(const JointWork& work, uint32_t end, Vec3<Real>& force, Vec3<Real>& torque) {
  force = torque = k_none;
  const Real* impulse = work.impulse;
  if (only_points || work.points != 0) {
    force = {impulse[0], impulse[1], impulse[2]};
    torque = cross(work.arm[end], force);
  }
  if (only_points) return;
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows; ++k) {
    force += real_from(work.row[k].axis) * impulse[k];
    torque += real_from(work.row[k].arm[end]) * impulse[k];
  }
}

/// L D L^T of the rows' response, their springs included.
template <bool only_points>
void factor(Real (&response)[k_joint_rows_max][k_joint_rows_max], JointWork& work) {
  const uint32_t rows = only_points ? 3 : work.rows;
  for (uint32_t k = 0; k < rows; ++k) {
    const bool linear = only_points || (k < 3 && work.points != 0) || is_linear(work.row[k]);
    const Real own = response[k][k], least = work.least[linear ? 0 : 1];
    const Real soft = only_points ? k_zero : work.softness[k];
    if (own > least || soft > k_zero)
      work.inverse[k] = scaled_reciprocal(max(own, least) + soft);
    else
      work.inverse[k] = Scaled(0.0);
    for (uint32_t l = k + 1; l < rows; ++l) {
      const Real of_pivot = multiply(response[l][k], work.inverse[k]);
      work.lower[l][k] = of_pivot;
      for (uint32_t m = k + 1; m <= l; ++m) response[l][m] -= of_pivot * response[m][k];
    }
  }
}

/// What is left of the parent's response once the joint is held: less the rows' replies over their pivots.
template <bool only_points>
void take_from(const JointWork& work, JointBody& parent) {
  DETENT_UNROLL
  for (int i = 0; i < 6; ++i) {
    DETENT_UNROLL
    for (int j = 0; j <= i; ++j) {
      Real sum = k_zero;
      if (only_points) {
        const Vec3<Real> reply = {work.reply[0][i], work.reply[1][i], work.reply[2][i]};
        const Vec3<Real> over = {work.reply_scaled[0][j], work.reply_scaled[1][j], work.reply_scaled[2][j]};
        sum = dot(reply, over);
      } else {
        for (uint32_t k = 0; k < work.rows; ++k) sum += work.reply[k][i] * work.reply_scaled[k][j];
      }
      parent.response[j][i] = parent.response[i][j] -= sum;
    }
  }
}

/// Solves one island's joints.
struct Solver {
  const StepSettings& settings;
  const SolverBodies& bodies;
  JointStage& stage;
  Span<const uint32_t> trees, loops;  ///< of the work, from the roots up
  bool touches;                       ///< the island has contacts, which read the bodies' spins
  uint32_t clamped = 0;

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
  /// A body as it is now, without its joints.
  void load(JointBody& body) {
    const BodyWork& now = bodies.work[body.slot];
    body.force = body.torque = body.given_force = body.given_torque = k_none;
    load_motion(body);
    const Scaled turn = scaled_by_power(body.share, now.gyration.exponent + 2 * body.above);
    bool saturated = false;
    const Real share = to_real(body.share, saturated);
    DETENT_UNROLL
    for (int i = 0; i < 3; ++i) {
      const Vec3<Real> row = multiply(real_from(now.gyration.row[i]), turn);
      DETENT_UNROLL
      for (int j = 0; j < 6; ++j) body.response[i][j] = body.response[i + 3][j] = k_zero;
      body.response[i][i] = share;
      body.response[i + 3][3] = row.x;
      body.response[i + 3][4] = row.y;
      body.response[i + 3][5] = row.z;
    }
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

  template <bool only_points>
  void missing_speeds(const JointWork& work, Real (&missing)[k_joint_rows_max]) {
    Real of_a[k_joint_rows_max], of_b[k_joint_rows_max];
    const JointBody &a = end_of(work, 0), &b = end_of(work, 1);
    show<only_points>(work, 0, a.velocity, a.spin, of_a);
    show<only_points>(work, 1, b.velocity, b.spin, of_b);
    const uint32_t rows = only_points ? 3 : work.rows;
    for (uint32_t k = 0; k < rows; ++k) missing[k] = work.wanted[k] - (of_b[k] - of_a[k]);
    if (only_points) return;
    for (int i = 0; i < 2; ++i) {
      const uint32_t row = work.driven[i];
      if (row != k_joint_rows_max) missing[row] -= work.softness[row] * work.driven_total[i];
    }
  }

  /// L^-1 of the missing speeds, over the pivots.
  template <bool only_points>
  void start_impulses(JointWork& work) {
    Real missing[k_joint_rows_max];
    missing_speeds<only_points>(work, missing);
    const uint32_t rows = only_points ? 3 : work.rows;
    for (uint32_t k = 0; k < rows; ++k) {
      for (uint32_t m = 0; m < k; ++m) missing[k] -= work.lower[k][m] * missing[m];
      bool saturated = false;
      work.start[k] =
          clamp(multiply(missing[k], work.inverse[k], saturated), -k_joint_impulse_max, k_joint_impulse_max);
      if (saturated) ++clamped;
    }
  }

  template <bool only_points>
  void eliminate(JointWork& work) {
    const uint32_t rows = only_points ? 3 : work.rows;
    JointBody &parent = end_of(work, work.parent), &child = end_of(work, 1 - work.parent);
    Real response[k_joint_rows_max][k_joint_rows_max];
    for (uint32_t k = 0; k < rows; ++k) {
      for (uint32_t m = 0; m <= k; ++m) response[k][m] = k_zero;
    }
    if (child.mobile != 0) {
      respond<only_points>(work, child, 1 - work.parent, work.reply);
      couple<only_points>(work, 1 - work.parent, work.reply, response);
    }
    respond<only_points>(work, parent, work.parent, work.reply);
    couple<only_points>(work, work.parent, work.reply, response);
    factor<only_points>(response, work);
    DETENT_UNROLL
    for (uint32_t k = 0; k < rows; ++k) {
      for (uint32_t m = 0; m < k; ++m) {
        const Real share = work.lower[k][m];
        DETENT_UNROLL
        for (int i = 0; i < 6; ++i) work.reply[k][i] -= work.reply[m][i] * share;
      }
      DETENT_UNROLL
      for (int i = 0; i < 6; ++i) work.reply_scaled[k][i] = multiply(work.reply[k][i], work.inverse[k]);
    }
    take_from<only_points>(work, parent);
  }

  /// The parent moves as the joint, held, moves it.
  template <bool only_points>
  void take_up(JointWork& work) {
    start_impulses<only_points>(work);
    JointBody& parent = end_of(work, work.parent);
    const bool to_b = work.parent == 1;
    for (uint32_t k = 0; k < (only_points ? 3 : work.rows); ++k) {
      const Real impulse = to_b ? work.start[k] : -work.start[k];
      parent.velocity += first_three(work.reply[k]) * impulse;
      parent.spin += last_three(work.reply[k]) * impulse;
    }
  }

  /// The impulses, once all that the parent gets from above is known.
  template <bool only_points>
  void come_down(JointWork& work) {
    const uint32_t rows = only_points ? 3 : work.rows;
    JointBody &parent = end_of(work, work.parent), &child = end_of(work, 1 - work.parent);
    const bool parent_is_b = work.parent == 1;
    for (uint32_t k = 0; k < rows; ++k) {
      const Real from_above =
          dot(parent.force, first_three(work.reply_scaled[k])) + dot(parent.torque, last_three(work.reply_scaled[k]));
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

  void solve_trees() {
    for (uint32_t k = trees.count; k-- > 0;) {
      JointWork& work = stage.work[trees[k]];
      if (is_only_points(work)) {
        eliminate<true>(work);
        take_up<true>(work);
      } else if (work.rows != 0) {
        eliminate<false>(work);
        take_up<false>(work);
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
    const auto set = [&](JointBody& body, const Quat& rotation, const Vec3<Real>& way) {
      body.rotation = rotation;
      body.axes = matrix_from(rotation);
      body.place = way;
    };
    each_body([&](JointBody& body) {
      BodyWork& now = bodies.work[body.slot];
      set(body, now.rotation, now.displacement);
      now.gyration = world_gyration(bodies.traits[body.slot], body.axes);
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
          body.velocity = body.spin = k_none;
          if (moves) {
            Vec3<Real> spin;
            turn_freely(traits, now.free_turn, motion.momentum, elapsed, 0, rotation, spin);
            body.velocity = motion.velocity;
            body.spin = world_spin(traits, now.gyration, motion.momentum, body.above);
          }
          set(body, rotation, body.velocity * elapsed);
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
      each_body([&](JointBody& body) { load(body); });
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

  /// Puts on what the joints that close loops gave in the last substep.
  void start_loops() {
    for (const uint32_t index : loops) {
      JointWork& work = stage.work[index];
      add_driven_rows(settings, bodies, stage, work);
      const JointState& joint = stage.joints[work.joint];
      for (uint32_t k = 0; k < work.rows; ++k) work.impulse[k] = k < work.rows_held ? joint.impulse[k] : k_zero;
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
    eliminate<false>(work);
    load_ends(work);
    start_impulses<false>(work);
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
    const Vec3<Real> momentum = multiply(torque, scaled_by_power(body.share, body.above));
    motion.velocity += velocity;
    motion.momentum += momentum;
    if (DETENT_FIXED) {  // it is not the contacts' (contact_motion.h)
      now.contact_velocity -= velocity;
      now.contact_momentum -= momentum;
    }
    if (touches) now.spin = world_spin(bodies.traits[body.slot], now.gyration, motion.momentum, -k_spin_power);
    body.force = body.torque = body.given_force = body.given_torque = k_none;
  }
};

}  // namespace

uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                      JointStage& stage, uint32_t& undecided) {
  const Span<const uint32_t> trees = {stage.order.data + island.first_joint, island.joint_count};
  const Span<const uint32_t> loops = {stage.order.data + island.first_joint + island.joint_count, island.loop_count};
  Solver solver = {settings, bodies, stage, trees, loops, island.contact_count != 0};
  solver.place(elapsed);
  solver.make_rows(trees);
  solver.make_rows(loops);
  solver.start_loops();
  solver.solve_held(undecided);
  for (uint32_t sweep = 0; sweep < k_loop_sweeps && loops.count != 0; ++sweep) {
    for (const uint32_t index : loops) solver.hold_loop(stage.work[index]);
    solver.solve_held(undecided);
  }
  for (const uint32_t index : trees) solver.add_up(stage.work[index]);
  for (const uint32_t index : loops) {
    JointWork& work = stage.work[index];
    solver.add_up(work);
    JointState& joint = stage.joints[work.joint];
    for (uint32_t k = 0; k < work.rows_held; ++k) {
      joint.impulse[k] = clamp(work.total[k], -k_joint_impulse_max, k_joint_impulse_max);
      if (!(joint.impulse[k] == work.total[k])) ++solver.clamped;
    }
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
