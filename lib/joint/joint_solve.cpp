#include "joint/joint.h"
#include "joint/joint_factor.h"
#include "math/rotation.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"
#include "motion/contact_motion.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The maximum number of times that impulses are scaled down because the velocity changes of the bodies exceed their
/// range. The last time sets the impulses to zero.
constexpr uint32_t k_gathers = 4;
constexpr Scaled k_gathered_share = 0.015625;  ///< factor of the impulses, each time except the last
/// Largest number of solves to find the drive modes of limits, motors and friction.
constexpr uint32_t k_decisions = 12;
/// After each of the first k_takings solves, limits can be activated, and motors and friction at their greatest force
/// can get their rows again. Later, limits and rows are only removed.
constexpr uint32_t k_takings = 3;

/// The fraction of the position errors that a substep corrects. The speed of the correction is limited by
/// k_closing_speed_max and k_closing_angular_velocity_max.
constexpr Unit k_closed = 0.15;
/// Replaces k_closed in an island with contacts. It is smaller, because contacts react to a shift only after the shift
/// has made bodies overlap.
constexpr Unit k_closed_with_contacts = 0.05;
constexpr Real k_closing_speed_max = 4.0;              ///< m/s
constexpr Real k_closing_angular_velocity_max = 16.0;  ///< rad/s
/// Gaps are not corrected if every gap of the assembly is at most 2^-k_gap_power of its joint's unit of length.
constexpr int k_gap_power = 20;
/// A body that has rotated by at most 2^-k_turned_power rad in the tick keeps its inverse inertia in world axes.
constexpr int k_turned_power = 6;
/// Limit of the angular velocity of a body times the unit of length of its joints' rows (JointBody::exponent):
/// 2^k_angular_velocity_power_max m/s. A body that rotates faster is slowed down.
constexpr int k_angular_velocity_power_max = 14;
/// Slowing a body down divides its angular momentum by 2^k_slowing_power, up to k_slowings times.
constexpr int k_slowings = 16, k_slowing_power = 2;
/// A 3 x 3 matrix of Units enlarges a vector by at most 2^k_matrix_power.
constexpr int k_matrix_power = 3;
/// The right-hand sides of a solve are limited to 2^k_side_power_max.
constexpr int k_side_power_max = 16;
/// Paths count as curved from a rotation of 2^-k_straight_power rad on: see any_turns().
constexpr int k_straight_power = 20;

/// Limit of the sum of two lengths, m: twice the sum fits a Real.
constexpr Real k_length_max = 32768.0;
Real clamped_sum(Real a, Real b) { return min(a + min(b, k_length_max), k_length_max); }

/// Solves the joints of one assembly.
struct Solver {
  const StepSettings& settings;
  const SolverBodies& bodies;
  JointStage& stage;
  Span<const uint32_t> order;
  JointFactor factor;
  bool touches;  ///< the island has contacts, which are solved in alternation with the joints
  /// Contacts will be solved again in this substep, so take_up() gives no motor or friction its row again.
  bool loads = touches;
  Real elapsed;  ///< time from the start of the tick to the start of the substep, s
  Real enough;   ///< an assembly is not solved again if contacts changed no velocity by more than this, m/s
  /// x . (K + S) x of the last solution's impulses x, divided by the reference mass. It is a little more than x . K x,
  /// which is twice the energy of the impulses.
  Scaled own_energy = Scaled(0.0);
  uint32_t clamped = 0, undecided = 0;

  Solver(const StepSettings& of_step, const SolverBodies& all, const Island& island, Span<const uint32_t> of_assembly,
         JointStage& joints, Real start, Real settled)
      : settings(of_step),
        bodies(all),
        stage(joints),
        order(of_assembly),
        factor(joints, order, island.joint_couplings_dropped != 0),
        touches(island.contact_count != 0),
        elapsed(start),
        enough(settled) {}

  JointBody& end_of(const JointWork& work, uint32_t end) const { return stage.bodies[work.body[end]]; }
  template <class Visit>
  void each_mobile(const Visit& visit) {
    each_mobile_body(order, stage, visit);
  }
  template <class Visit>
  void each_joint(const Visit& visit) {
    for (const uint32_t index : order) visit(stage.work[index]);
  }

  /// Sets the current poses of mobile bodies.
  void place_moving() {
    each_mobile([&](JointBody& body) {
      const BodyWork& now = bodies.work[body.slot];
      body.rotation = now.rotation;
      body.place = now.displacement;
      body.axes = elapsed == k_zero ? now.axes : matrix_from(now.rotation);
    });
  }
  void place_still(Real time) {
    each_joint([&](JointWork& work) {
      for (const uint32_t at : work.body) {
        JointBody& body = stage.bodies[at];
        if (body.mobile != 0) continue;
        const BodyProperties& properties = bodies.properties[body.slot];
        const BodyMotion& motion = bodies.motions[body.slot];
        const BodyWork& now = bodies.work[body.slot];
        Quat rotation = now.rotation;
        body.linear_velocity = body.angular_velocity = k_zero_vector;
        if (is_kinematic(properties)) {
          Vec3<Real> angular_velocity;
          rotate_freely(properties, now.free_rotation, motion.angular_momentum, time, 0, rotation, angular_velocity);
          body.linear_velocity = motion.linear_velocity;
          body.angular_velocity =
              world_angular_velocity(properties, now.inverse_inertia, motion.angular_momentum, body.above);
        }
        body.rotation = rotation;
        body.axes = matrix_from(rotation);
        body.place = body.linear_velocity * time;
      }
    });
  }

  Vec3<Real> angular_velocity_from(const JointBody& body, const Vec3<Real>& angular_momentum) const {
    return world_angular_velocity(bodies.properties[body.slot], bodies.work[body.slot].inverse_inertia,
                                  angular_momentum, body.above);
  }
  /// Whether the angular velocity of a body with this angular momentum is so small that the speeds of rows fit a Real.
  bool angular_velocities_within(const JointBody& body, const Vec3<Real>& angular_momentum) const {
    const int power =
        bodies.work[body.slot].inverse_inertia.exponent + body.above;  // exponent of a matrix of 3 x 3 Units
    if (exponent_above(greatest(angular_momentum)) + power + k_matrix_power <= k_angular_velocity_power_max)
      return true;
    return greatest(angular_velocity_from(body, angular_momentum)) <=
           scale_by_power(Real(1.0), k_angular_velocity_power_max);
  }
  /// Reduces the angular momentum of a body until angular_velocities_within() is true.
  void slow_to_fit(const JointBody& body, Vec3<Real>& angular_momentum) {
    for (int left = k_slowings; left > 0 && !angular_velocities_within(body, angular_momentum); --left) {
      angular_momentum = scale_by_power(angular_momentum, -k_slowing_power);
      ++clamped;
    }
  }
  /// Sets the velocities of the mobile bodies, from which the rows' speeds are computed. These velocities include the
  /// constant impulses that have not been applied yet: those of motors at their greatest force and of soft springs.
  DETENT_SHARED void load_motions() {
    each_mobile([&](JointBody& body) {
      const BodyMotion& motion = bodies.motions[body.slot];
      body.linear_velocity = motion.linear_velocity + body.given_push;
      body.angular_velocity = angular_velocity_from(body, motion.angular_momentum + body.given_twist);
    });
  }

  /// Whether the body's rotation in the tick has changed its inverse inertia.
  bool has_rotated(const JointBody& body) const {
    const BodyProperties& properties = bodies.properties[body.slot];
    return !is_isotropic(properties) && absolute_sum(bodies.work[body.slot].rotation_vector) >
                                            real_from_unit(Unit(1.0), properties.size_exponent - k_turned_power);
  }

  void begin() {
    place_moving();
    place_still(elapsed);
    each_mobile([&](JointBody& body) {
      BodyWork& now = bodies.work[body.slot];
      const BodyMotion& motion = bodies.motions[body.slot];
      body.push = body.twist = body.given_push = body.given_twist = k_zero_vector;
      body.renewed = body.slowed;
      if (elapsed != k_zero && has_rotated(body)) {
        now.inverse_inertia = world_inverse_inertia(bodies.properties[body.slot], body.axes);
        body.renewed = 1;
      }
      body.velocity_before = motion.linear_velocity;
      body.angular_momentum_before = motion.angular_momentum;
    });
    each_joint([&](JointWork& work) {
      make_joint_rows(stage, work, driven_motions(stage.joints[work.joint]), RowParts::all, work);
      if (elapsed == k_zero) work.pull = last_pull(settings, bodies, stage, work);
    });
    each_mobile([&](JointBody& body) { load_inertia(settings, bodies, stage, body); });
    if (elapsed == k_zero) {
      each_joint([&](JointWork& work) {
        choose_unit(stage, work);
        load_impulses(settings, stage, work);
      });
    }
  }

  /// Reads the bodies' velocities, and chooses the drive modes of the free motions.
  void start() {
    load_motions();
    each_joint([&](JointWork& work) {
      for (Real& total : work.total) total = k_zero;
      for (uint32_t k = 0; k < work.locked_rows; ++k) work.spring[k] = work.target[k] = k_zero;
      choose_drives(settings, bodies, stage, work);
    });
  }

  /// Adds the constant impulses of a joint, which have no row, to `given_push` and `given_twist` of its bodies. Motors
  /// at their greatest force and soft springs have such impulses.
  void push(const JointWork& work) {
    for (int i = 0; i < k_free_motions; ++i) {
      if (work.constant[i] == k_zero) continue;
      const JointRow& row = work.free_row[i];
      const int power = impulse_power(work, row_kind(row));
      const auto apply = [&](JointBody& body, uint32_t end, Real impulse) {
        if (body.mobile == 0) return;
        body.given_push += multiply(row.axis * impulse, scaled_by_power(body.inverse_mass, power));
        body.given_twist += multiply(row.arm[end] * impulse, scaled_by_power(body.inverse_mass, power + body.above));
      };
      apply(end_of(work, 1), 1, work.constant[i]);
      apply(end_of(work, 0), 0, -work.constant[i]);
    }
  }

  /// Computes J v for a joint's rows.
  void speeds(const JointWork& work, Real (&speed)[k_joint_rows_max]) const {
#if DETENT_JOINT_LANES
    with_width(is_wide(work), [&](auto width) { joint_speeds<decltype(width)::wide>(stage, work).put(speed); });
#else
    Real of_a[k_joint_rows_max];
    const JointBody &a = end_of(work, 0), &b = end_of(work, 1);
    show(work, work.rows, 0, a.linear_velocity, a.angular_velocity, of_a);
    show(work, work.rows, 1, b.linear_velocity, b.angular_velocity, speed);
    for (uint32_t k = 0; k < work.rows; ++k) speed[k] -= of_a[k];
#endif
  }
  /// The right-hand side of a row is a change of the row's speed times 2^power_of().
  static int power_of(const JointWork& work, uint32_t row) { return unit_power(work, row) - k_impulse_power; }
  /// The right-hand side for the given change of a row's speed.
  Real side_of(const JointWork& work, uint32_t row, Real speed) {
    const int power = power_of(work, row);
    clamped += clamp_component(speed, scale_by_power(Real(1.0), k_side_power_max - (power > 0 ? power : 0)));
    return scale_by_power(speed, power);
  }

  /// Sets the right-hand sides for the changes of the rows' speeds from `before` to `after`.
  void set_sides(JointWork& work, const Real (&after)[k_joint_rows_max], const Real (&before)[k_joint_rows_max]) {
#if DETENT_JOINT_LANES
    const auto set = [&](auto width) {
      using Lanes = RowLanes<decltype(width)::wide>;
      const Lanes change = Lanes::from_six(after) - Lanes::from_six(before);
      if (!change.is_within(scale_by_power(Real(1.0), k_side_power_max))) return false;
      change.put(work.side);
      return true;
    };
    if (is_wide(work) ? set(Width<true>()) : set(Width<false>())) return;
#endif
    for (uint32_t k = 0; k < work.rows; ++k) work.side[k] = side_of(work, k, after[k] - before[k]);
  }

  /// Whether a body rotates by more than 2^-k_straight_power rad in the substep. If not, the curvature of the anchors'
  /// paths is below the precision. With a distance joint the result is always true, because a rod can rotate while its
  /// bodies do not.
  bool any_turns() {
    bool turns = false;
    each_joint([&](const JointWork& work) {
      for (const uint32_t at : work.body) {
        const JointBody& body = stage.bodies[at];
        const Real least = real_from_unit(Unit(1.0), body.exponent - k_straight_power);
        if (absolute_sum(body.angular_velocity) * settings.time > least) turns = true;
      }
      if (static_cast<JointType>(stage.joints[work.joint].type) == JointType::distance) turns = true;
    });
    return turns;
  }

  /// Makes the factor of the joints' rows, with the current drive modes. In the first solve of a substep (`first`),
  /// also applies the warm start.
  void make_factor(bool first) {
    each_joint([&](JointWork& work) { add_driven_rows(settings, bodies, stage, work); });
    factor.make();
    each_mobile([&](JointBody& body) { body.given_push = body.given_twist = k_zero_vector; });
    if (first) warm_start();
    each_joint([&](JointWork& work) { push(work); });
  }

  /// Sets the right-hand sides to target - J v, from the bodies' current velocities.
  void ask_for_speeds() {
    each_joint([&](JointWork& work) {
      Real speed[k_joint_rows_max];
      speeds(work, speed);
      set_sides(work, work.target, speed);
      for (int i = 0; i < k_free_motions; ++i) {
        const uint32_t row = work.driven[i];
        if (row != k_joint_rows_max) work.side[row] -= work.spring[row] * work.driven_total[i];
      }
    });
  }
  /// Solves the rows, again and again until the drive modes of all limits, motors and friction agree with the impulses,
  /// at most k_decisions times.
  void solve() {
    for (uint32_t decision = 1;; ++decision) {
      load_motions();
      const uint32_t lessened = solve_for([&] { ask_for_speeds(); });
      bool wrong = false;
      const bool last = decision == k_decisions;
      each_joint([&](JointWork& work) {
        if (bound_drives(stage.joints[work.joint], settings.share, !last, work)) wrong = true;
      });
      if (!wrong) {  // the impulse of a limit is valid only if all drives are within their greatest impulses
        each_joint([&](JointWork& work) {
          if (release_limits(stage.joints[work.joint], !last, work)) wrong = true;
        });
      }
      if (!wrong || last) clamped += lessened;
      if (wrong && last) ++undecided;
      if (!wrong && decision <= k_takings) wrong = take_up_drives();
      if (!wrong || last) break;
      make_factor(false);
    }
    keep_sound();
    each_mobile([&](JointBody& body) { apply(body); });
    each_joint([&](JointWork& work) { count_in(work); });
  }

  /// Calls take_up() for each joint, with velocities that include the impulses of the last solve: activates limits, and
  /// gives motors and friction their rows again. Returns whether a drive mode changed.
  bool take_up_drives() {
    bool open = false;
    each_joint([&](const JointWork& work) {
      for (int i = 0; i < k_free_motions; ++i) {
        const bool limited = is_limited(stage.joints[work.joint], i);
        if ((limited && !is_at_limit(work.mode[i])) || (!loads && work.mode[i] == DriveMode::constant)) open = true;
      }
    });
    if (!open) return false;
    each_mobile([&](JointBody& body) {
      const BodyMotion& motion = bodies.motions[body.slot];
      body.linear_velocity = motion.linear_velocity + body.push + body.given_push;
      body.angular_velocity = angular_velocity_from(body, motion.angular_momentum + body.twist + body.given_twist);
    });
    bool taken = false;
    each_joint([&](JointWork& work) {
      if (take_up(settings, bodies, stage, loads, work)) taken = true;
    });
    return taken;
  }

  Real greatest_impulse() {
    Real most = k_zero;
    each_joint([&](JointWork& work) {
      for (uint32_t k = 0; k < work.rows; ++k) most = max(most, abs(work.impulse[k]));
    });
    return most;
  }

  /// Solves for the right-hand sides that `ask` sets, and computes the velocity changes of the bodies. Rows with
  /// contradictory targets need impulses of target / softness, which can exceed the range. Then all rows become softer.
  /// If this is not enough, all impulses are scaled down; this is valid, because a fraction of a projection also
  /// removes energy. Returns the number of times that the impulses were scaled.
  template <class Ask>
  uint32_t solve_for(const Ask& ask) {
    const uint32_t before = factor.saturated;
    for (;;) {
      ask();
      own_energy = factor.substitute();
      factor.solve();
      if (factor.saturated == before && greatest_impulse() <= k_solution_max && gather_joints()) return 0;
      if (!factor.make_softer()) return gather_less();
      factor.saturated = before;
    }
  }
  /// Scales the impulses down until they and the velocity changes of the bodies are in range. Returns the number of
  /// times that they were scaled.
  uint32_t gather_less() {
    uint32_t lessened = 0;
    const Real most = greatest_impulse();
    if (most > k_solution_max) {
      ++lessened;
      scale_impulses(divide(scaled_from(k_solution_max), scaled_from(most)));
    }
    for (uint32_t left = k_gathers; !gather_joints(); --left) {
      ++lessened;
      scale_impulses(left == 1 ? Scaled(0.0) : k_gathered_share);
    }
    return lessened;
  }
  /// Computes the velocity changes of the bodies. Returns false if one exceeds its range.
  bool gather_joints() {
    bool fits = true;
    each_mobile([&](JointBody& body) { body.push = body.twist = k_zero_vector; });
    each_joint([&](const JointWork& work) { fits = fits && gather(stage, work); });
    each_mobile(
        [&](JointBody& body) { fits = fits && convert_impulses(body) && angular_velocities_within(body, body.twist); });
    return fits;
  }
  void scale_impulses(Scaled share) {
    each_joint([&](JointWork& work) {
      for (uint32_t k = 0; k < work.rows; ++k) work.impulse[k] = multiply(work.impulse[k], share);
    });
  }
  /// Whether no value has been clamped so far.
  bool is_sound() const { return clamped + factor.saturated == 0; }
  /// If a value was clamped, the impulses do not solve the rows. This function then scales them so that they add no
  /// energy.
  void keep_sound() {
    if (!is_sound()) limit_energy();
  }
  /// Scales the impulses, and the bodies' velocity changes by them, down to the largest share in [0, 1] that adds no
  /// energy.
  void limit_energy() {
    load_motions();
    const Scaled shared = impulses_times_speeds(false);
    each_mobile([&](JointBody& body) {
      body.linear_velocity = body.push;
      body.angular_velocity = angular_velocity_from(body, body.twist);
    });
    place_motionless();
    const Scaled own = impulses_times_speeds(false), most = negate(scaled_by_power(shared, 1));
    if (less(most, own)) scale_all(is_positive(most) ? divide(most, own) : Scaled(0.0));
    place_still(elapsed);
  }

  /// Adds the joints' velocity changes to the body's motion.
  void apply(JointBody& body) {
    BodyMotion& motion = bodies.motions[body.slot];
    BodyWork& now = bodies.work[body.slot];
    const Vec3<Real> velocity_before = motion.linear_velocity, angular_momentum_before = motion.angular_momentum;
    motion.linear_velocity += body.push + body.given_push;
    motion.angular_momentum += body.twist + body.given_twist;
    clamped += clamp_vector(motion.linear_velocity, k_speed_work_max) +
               clamp_vector(motion.angular_momentum, k_angular_velocity_work_max);
    slow_to_fit(body, motion.angular_momentum);
    if (DETENT_FIXED) {  // so that this change does not count as a change by contacts (contact_motion.h)
      now.contact_velocity -= motion.linear_velocity - velocity_before;
      now.contact_angular_momentum -= motion.angular_momentum - angular_momentum_before;
    }
    body.push = body.twist = body.given_push = body.given_twist = k_zero_vector;
  }

  /// Applies the impulses of the last substep to the rows that always act, scaled down until they add no energy. The
  /// solve then computes only the change of these impulses. Therefore the rows of a mechanism at rest do not yield by
  /// their softness, however large the forces are. If an impulse is beyond its range, none are applied. Range: no
  /// constant impulses of motors or soft springs are pending (push()).
  void warm_start() {
    each_joint([&](JointWork& work) {
      for (uint32_t k = 0; k < work.rows; ++k) work.impulse[k] = k < work.locked_rows ? work.kept[k] : k_zero;
    });
    const Real most = greatest_impulse();
    if (most == k_zero || most > k_solution_max || !gather_joints()) return;
    limit_energy();
    each_mobile([&](JointBody& body) { apply(body); });
    // A sum, so that no impulse is a negative zero, to which solves may add a zero of either sign.
    each_joint([&](JointWork& work) {
      for (uint32_t k = 0; k < work.locked_rows; ++k) work.total[k] += work.impulse[k];
    });
  }

  /// Adds the applied impulses to the joint's sums for this substep.
  static void count_in(JointWork& work) {
    for (uint32_t k = 0; k < work.locked_rows; ++k) work.total[k] += work.impulse[k];
    for (int i = 0; i < k_free_motions; ++i) {
      if (work.driven[i] != k_joint_rows_max) work.driven_total[i] += work.impulse[work.driven[i]];
      work.given[i] += work.constant[i];
      work.constant[i] = k_zero;
    }
  }

  /// Whether contacts have changed no component of a body's velocity by more than `enough`, m/s, since
  /// BodyWork::velocity_before was stored.
  bool has_settled() {
    bool settled = true;
    each_mobile([&](const JointBody& body) {
      const Vec3<Real> change = bodies.motions[body.slot].linear_velocity - bodies.work[body.slot].velocity_before;
      if (greatest(change) > enough) settled = false;
    });
    return settled;
  }

  /// Whether any drive may drive a motion beyond its target speed, and a further solve may correct this.
  bool may_be_overdriven() {
    if (loads) return false;
    bool may = false;
    each_joint([&](const JointWork& work) { may = may || may_overdrive(stage.joints[work.joint], work); });
    return may;
  }
  /// Solves the rows once more, to remove the speed that contacts have added. Does nothing if contacts have added none
  /// that counts (has_settled()) and no drive needs a correction.
  void solve_again() {
    if (has_settled() && !may_be_overdriven()) return;
    each_mobile([&](JointBody& body) {
      // apply() only clamps the motion after the contacts here, because no joint impulses are pending.
      apply(body);
    });
    place_still(elapsed);
    solve();
    renew_angular_velocities();
  }
  /// Updates the bodies' angular velocities that contacts read.
  void renew_angular_velocities() {
    each_mobile([&](JointBody& body) {
      renew_angular_velocity(bodies.properties[body.slot], bodies.motions[body.slot], bodies.work[body.slot]);
    });
  }

  /// Sets the right-hand sides such that the position errors at the predicted poses equal the current errors. This is
  /// necessary because rows act along straight lines, while the anchors move on curved paths.
  void ask_for_curves() {
    each_mobile([&](JointBody& body) {
      const BodyMotion& motion = bodies.motions[body.slot];
      const BodyWork& now = bodies.work[body.slot];
      Vec3<Real> angular_velocity;
      rotate_freely(bodies.properties[body.slot], now.free_rotation,
                    own_angular_momentum(body, motion.angular_momentum), settings.time, 0, body.rotation,
                    angular_velocity);
      body.axes = matrix_from(body.rotation);
      body.place += motion.linear_velocity * settings.time;
    });
    place_still(elapsed + settings.time);
    each_joint([&](JointWork& work) {
      uint32_t motions = 0;
      for (uint32_t i = 0; i < k_free_motions; ++i) motions |= is_at_limit(work.mode[i]) ? 1u << i : 0u;
      JointRows then;
      make_joint_rows(stage, work, motions, RowParts::errors, then);
      const auto ask = [&](uint32_t row, Real error) {
        work.side[row] = side_of(work, row, speed_over(settings, work.error[row] - error));
      };
      for (uint32_t k = 0; k < then.locked_rows; ++k) ask(k, then.error[k]);
      for (uint32_t k = then.locked_rows; k < work.rows; ++k) work.side[k] = k_zero;
      for (int i = 0; i < k_free_motions; ++i) {
        const uint32_t row = work.driven[i];
        if (row == k_joint_rows_max || !is_at_limit(work.mode[i])) continue;
        const Real displacement = work.target[row] * settings.time;
        ask(row, work.error[row] + (then.value[i] - work.value[i] - displacement));
      }
    });
    place_moving();
  }

  /// Adds the velocities by which the joints follow their curved paths. Let x be the impulses that give these
  /// velocities, and u the motion at the start of the substep. The multiple of x that removes the most energy from u
  /// removes (x . J u)^2 / (2 x . K x). The projection has removed at least this energy. The velocities are scaled so
  /// that they add no more than this energy. Range: load_motions() has been called.
  void follow_curves() {
    clamped += solve_for([&] { ask_for_curves(); });
    const Scaled shared = impulses_times_speeds(false);
    each_mobile([&](JointBody& body) {
      body.linear_velocity = body.velocity_before;
      body.angular_velocity = angular_velocity_from(body, body.angular_momentum_before);
    });
    const Scaled opposed = impulses_times_speeds(true);
    scale_all(is_sound() ? share_within(own_energy, shared, opposed) : Scaled(0.0));
    each_mobile([&](JointBody& body) { apply(body); });
    each_joint([&](JointWork& work) {
      for (uint32_t k = 0; k < work.locked_rows; ++k) work.kept[k] = -work.impulse[k];
      count_in(work);
    });
  }

  /// The product x . J v of the impulses x and the speeds J v of the rows, at the bodies' current velocities. If
  /// `locked` is true, the sum is only over the rows that lock motions.
  DETENT_SHARED Scaled impulses_times_speeds(bool locked) {
    EnergySum sum;
    each_joint([&](const JointWork& work) {
      Real speed[k_joint_rows_max];
      speeds(work, speed);
      for (uint32_t k = 0; k < work.rows; ++k) {
        if (!locked || is_locked(work, k)) sum.add(work.impulse[k], scale_by_power(speed[k], power_of(work, k)));
      }
    });
    return sum.value();
  }

  /// The largest y in [0, 1] for which the impulses y x add at most an energy of opposed^2 / (2 own), that is, for
  /// which y^2 own + 2 y shared <= opposed^2 / own. `own`: twice the energy of the impulses x, x . K x. `shared`: the
  /// product x . J v with the current motion. `opposed`: the product x . J v with the motion before the projection.
  DETENT_SHARED static Scaled share_within(Scaled own, Scaled shared, Scaled opposed) {
    const Scaled one = 1.0;
    const Scaled root = square_root(add(multiply(shared, shared), multiply(opposed, opposed)));
    const Scaled most = add(root, negate(shared));
    if (!less(most, own)) return one;
    return is_positive(most) ? divide(most, own) : Scaled(0.0);
  }
  void scale_all(Scaled share) {
    if (share == Scaled(1.0)) return;
    each_mobile([&](JointBody& body) {
      body.push = multiply(body.push, share);
      body.twist = multiply(body.twist, share);
    });
    scale_impulses(share);
  }

  /// Sets the velocities of the bodies that are not mobile to zero: they do not contribute to the energy of the
  /// impulses.
  void place_motionless() {
    each_joint([&](JointWork& work) {
      for (const uint32_t at : work.body) {
        JointBody& body = stage.bodies[at];
        if (body.mobile == 0) body.linear_velocity = body.angular_velocity = k_zero_vector;
      }
    });
  }

  /// Whether any position error of a row is large enough to be corrected.
  bool any_gaps() {
    bool opens = false;
    each_joint([&](const JointWork& work) {
      const Real least = real_from_unit(Unit(1.0), work.exponent - k_gap_power);
      for (uint32_t k = 0; k < work.rows; ++k) opens = opens || abs(work.error[k]) > least;
    });
    return opens;
  }

  /// Sets the right-hand sides such that the solution corrects a fraction of the position errors. Returns the sum of
  /// the magnitudes of the corrections, m.
  Real ask_for_gaps() {
    Real closed = k_zero;
    each_joint([&](JointWork& work) {
      const Real angular_max = scale_by_power(k_closing_angular_velocity_max, work.exponent < 12 ? work.exponent : 12);
      for (uint32_t k = 0; k < work.rows; ++k) {
        const bool linear = row_kind(work, k) == 0;
        const Real most = linear ? k_closing_speed_max : angular_max;
        const Unit share = touches ? k_closed_with_contacts : k_closed;
        const Real speed = clamp(-(speed_over(settings, work.error[k]) * share), -most, most);
        closed = clamped_sum(closed, abs(speed) * settings.time);
        work.side[k] = side_of(work, k, speed);
      }
    });
    return closed;
  }

  /// Computes the shifts of positions that close gaps, without changing velocities.
  void close_gaps() {
    if (!any_gaps()) {
      each_mobile([&](JointBody& body) { body.shift = body.shift_rotation = k_zero_vector; });
      return;
    }
    const uint32_t before = factor.saturated;
    Real closed = k_zero;
    solve_for([&] { closed = ask_for_gaps(); });  // scaled shifts are no error, so the result is not counted
    if (factor.saturated != before) scale_all(Scaled(0.0));
    // A rotation moves an anchor off its straight line by arm x angle^2 / 2. The shifts are scaled so that the sum of
    // these deviations is at most half of the sum of the corrections.
    Real bent = k_zero;
    each_mobile([&](JointBody& body) {
      body.shift = body.push * settings.time;
      const Vec3<Real> angular_velocity = angular_velocity_from(body, body.twist);
      bool held = false;
      const auto angle = [&](Real part) {
        return clamp(angle_of(part * settings.time, body.exponent, held), Real(-1.0), Real(1.0));
      };
      body.shift_rotation = {angle(angular_velocity.x), angle(angular_velocity.y), angle(angular_velocity.z)};
      body.push = body.twist = k_zero_vector;
    });
    each_joint([&](JointWork& work) {
      for (uint32_t end = 0; end < 2; ++end) {
        const JointBody& body = end_of(work, end);
        if (body.mobile == 0) continue;
        const Real rotation_vector = absolute_sum(body.shift_rotation);
        bent = clamped_sum(
            bent, (rotation_vector * rotation_vector) * real_from_unit(work.arm_length[end], body.exponent - 1));
      }
    });
    if (scale_by_power(bent, 1) > closed) {
      const Scaled share = divide(scaled_from(closed), scaled_from(scale_by_power(bent, 1)));
      each_mobile([&](JointBody& body) {
        body.shift = multiply(body.shift, share);
        body.shift_rotation = multiply(body.shift_rotation, share);
      });
    }
  }

  /// Converts angular momenta from the inertia of the substep to the bodies' own inertia, at equal angular velocity.
  /// With these angular momenta the bodies rotate when positions are integrated.
  void lend_momenta() {
    each_mobile([&](JointBody& body) {
      BodyMotion& motion = bodies.motions[body.slot];
      body.angular_momentum_before = motion.angular_momentum;
      motion.angular_momentum = own_angular_momentum(body, motion.angular_momentum);
    });
  }
  /// Restores the bodies' own inverse inertias and angular momenta.
  void restore_inertias() {
    each_mobile([&](JointBody& body) {
      body.renewed = body.slowed;
      if (body.slowed == 0) return;
      BodyMotion& motion = bodies.motions[body.slot];
      BodyWork& now = bodies.work[body.slot];
      const Vec3<Real> before = motion.angular_momentum;
      motion.angular_momentum = own_angular_momentum(body, before);
      if (DETENT_FIXED) now.contact_angular_momentum += before - motion.angular_momentum;  // not an impulse of contacts
      now.inverse_inertia = world_inverse_inertia(bodies.properties[body.slot], body.axes);
    });
  }

  /// Adds the joint's angular impulses to JointWork::torque_sum.
  static void add_torques(JointWork& work) {
    for (uint32_t k = first_other(work); k < work.locked_rows; ++k) add_torque(work, work.row[k], work.total[k]);
    for (int i = 0; i < k_free_motions; ++i) {
      const Real impulse = work.driven_total[i] + work.given[i];
      if (!(impulse == k_zero)) add_torque(work, work.free_row[i], impulse);
    }
  }
  static void add_torque(JointWork& work, const JointRow& row, Real impulse) {
    if (!is_linear(row)) work.torque_sum += real_from_unit(row.arm[1], 0) * impulse;
  }

  /// The first solve of a substep.
  void solve_first() {
    start();
    make_factor(true);
    solve();
    if (touches) renew_angular_velocities();
  }
  /// Adds the motion along curved paths, and computes the shifts that close gaps.
  void follow() {
    each_joint([&](JointWork& work) {
      work.pull = pull_of(work, linear_impulse(work));
      for (uint32_t k = 0; k < work.locked_rows; ++k) work.kept[k] = k_zero;
    });
    load_motions();
    if (any_turns()) follow_curves();
    close_gaps();
    if (touches) renew_angular_velocities();
    lend_momenta();
  }
  /// Ends a substep.
  void end() {
    loads = false;
    if (touches) solve_again();
    each_joint([&](JointWork& work) {
      const Vec3<Real> impulse = linear_impulse(work);
      work.force_sum += impulse;
      add_torques(work);
      for (uint32_t k = 0; k < work.locked_rows; ++k) work.kept[k] = zero_if_tiny(work.kept[k] + work.total[k]);
      // The pull is at most twice its value at the start of follow(): curved paths give redundant rows contradictory
      // targets, and these rows then pull against each other as hard as their softness permits.
      work.pull = min(pull_of(work, impulse), scale_by_power(work.pull, 1));
    });
    restore_inertias();
  }
};

/// Calls a pass of the solver for each assembly of the island. Returns the number of values that were clamped, and
/// increases `undecided` as solve_joints() does.
uint32_t solve_each(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                    Real enough, JointStage& stage, uint32_t& undecided, void (Solver::*pass)()) {
  uint32_t clamped = 0;
  each_assembly(island, stage, [&](Span<const uint32_t> order) {
    Solver solver(settings, bodies, island, order, stage, elapsed, enough);
    (solver.*pass)();
    clamped += solver.clamped + solver.factor.saturated;
    undecided += solver.undecided;
  });
  return clamped;
}

/// The angular momentum of a body that a shift has rotated from `before` to `after`. A shift has no torque, so the
/// angular momentum stays the same in world axes. If the body would then have more energy in its new rotation, the
/// angular momentum is scaled down until the energy is the same as before.
Vec3<Real> angular_momentum_after_shift(const BodyProperties& properties, const Quat& before, const Quat& after,
                                        const Vec3<Real>& angular_momentum) {
  if (is_isotropic(properties)) return angular_momentum;
  const Scaled had = rotational_energy(properties, rotate_inverse(before, angular_momentum));
  const Scaled has = rotational_energy(properties, rotate_inverse(after, angular_momentum));
  return less(had, has) ? multiply(angular_momentum, square_root(divide(had, has))) : angular_momentum;
}

}  // namespace

void begin_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                  JointStage& stage) {
  uint32_t undecided = 0;  // stays 0
  solve_each(settings, bodies, island, elapsed, k_zero, stage, undecided, &Solver::begin);
}

uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                      JointStage& stage, uint32_t& undecided) {
  return solve_each(settings, bodies, island, elapsed, k_zero, stage, undecided, &Solver::solve_first);
}

uint32_t solve_joints_again(const StepSettings& settings, const SolverBodies& bodies, const Island& island,
                            Real elapsed, Real enough, JointStage& stage, uint32_t& undecided) {
  return solve_each(settings, bodies, island, elapsed, enough, stage, undecided, &Solver::solve_again);
}

uint32_t follow_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                       JointStage& stage) {
  uint32_t undecided = 0;  // stays 0: no modes are chosen
  return solve_each(settings, bodies, island, elapsed, k_zero, stage, undecided, &Solver::follow);
}

uint32_t end_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                    Real enough, JointStage& stage, uint32_t& undecided) {
  return solve_each(settings, bodies, island, elapsed, enough, stage, undecided, &Solver::end);
}

uint32_t shift_joints(const SolverBodies& bodies, const Island& island, JointStage& stage) {
  bool saturated = false;
  const auto shift = [&](const JointBody& body) {
    BodyWork& now = bodies.work[body.slot];
    BodyMotion& motion = bodies.motions[body.slot];
    const Vec3<Real> before = body.angular_momentum_before;  // of lend_momenta(), with the inertia of the substep
    now.displacement += body.shift;
    if (!(body.shift_rotation == k_zero_vector)) {
      const Quat rotation_vector = rotation_from_vector(body.shift_rotation);
      const Quat rotation_before = now.rotation;
      now.rotation = normalise(multiply(rotation_vector, rotation_before));
      motion.angular_momentum = angular_momentum_after_shift(bodies.properties[body.slot], rotation_before,
                                                             now.rotation, motion.angular_momentum);
      now.rotation_vector += scale_by_power(body.shift_rotation, bodies.properties[body.slot].size_exponent);
    }
    motion.angular_momentum = lent_angular_momentum(body, motion.angular_momentum, saturated);
    if (DETENT_FIXED) now.contact_angular_momentum += before - motion.angular_momentum;
  };
  each_assembly(island, stage, [&](Span<const uint32_t> order) { each_mobile_body(order, stage, shift); });
  return saturated ? 1 : 0;
}

void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage) {
  const Scaled rate = divide(Scaled(1.0), scaled_from(settings.tick_time));
  for (const JointWork& work : stage.work.first(stage.count)) {
    const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
    const JointBody& mobile = b.mobile != 0 ? b : a;
    const Scaled unit = multiply(reference_mass(bodies, stage, work), rate);
    const auto store = [&](const Vec3<Real>& sum, int power, Vec3<Scaled>& to) {
      const Scaled factor = scaled_by_power(unit, power);
      to = {multiply(scaled_from(sum.x), factor), multiply(scaled_from(sum.y), factor),
            multiply(scaled_from(sum.z), factor)};
    };
    JointState& joint = stage.joints[work.joint];
    BodyActivity& activity = stage.activities[mobile.slot];
    store_impulses(activity.substeps, work, joint);
    for (int i = 0; i < 2; ++i) {
      if (work.mode[i] == DriveMode::rigid && !(joint.speed[i] == k_zero)) activity.still_ticks = 0;
    }
    store(work.force_sum, impulse_power(work, 0), joint.force);
    store(work.torque_sum, b.exponent + impulse_power(work, 1), joint.torque);
  }
}

const JointOps k_joint_ops = {collect_joints, order_joints, begin_joints, solve_joints,   solve_joints_again,
                              follow_joints,  shift_joints, end_joints,   store_reactions};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
