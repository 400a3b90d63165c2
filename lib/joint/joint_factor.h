#pragma once
#include "base/unroll.h"
#include "joint/joint.h"
#include "joint/joint_lanes.h"
#include "math/scaled.h"

/// The factor L D L^T, in blocks, of the matrix K + S (joint.h) of all joints of an assembly. The block of a joint's
/// own rows is in JointWork::response, the blocks of its couplings with other joints are in JointStage::numbers.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Exponent of the unit of a row's impulses, without k_impulse_power; see choose_unit().
inline int unit_power([[maybe_unused]] const JointWork& work, [[maybe_unused]] uint32_t row) {
  return DETENT_FIXED ? work.row_power[row] : 0;
}

/// Twice an energy, divided by the reference mass: a sum of products of impulses and speeds.
class EnergySum {
 public:
#if DETENT_FIXED
  /// Adds a b. Rounding: both factors down, to 2^-37. Overflow: none for fewer than 2^18 products.
  void add(Real a, Real b) { sum_ = sum_ + Int128::product(a.raw >> k_drop, b.raw >> k_drop); }
  Scaled value() const {
    const bool negative = sum_ < Int128::from(0);
    const Int128 size = negative ? -sum_ : sum_;
    if (size.high_word() == 0) return from(negative, size.low_word(), 0);
    // One bit more than the length, so that the mantissa still fits after rounding up.
    const int shift = bit_length_64(static_cast<uint64_t>(size.high_word())) + 1;
    return from(negative, static_cast<uint64_t>(size.round_shift(shift)), shift);
  }

 private:
  static constexpr int k_drop = 9;
  static Scaled from(bool negative, uint64_t mantissa, int shift) {
    return scaled_from_parts(negative, mantissa, shift + 2 * (k_drop - k_real_frac));
  }
  Int128 sum_ = Int128::from(0);
#else
  void add(Real a, Real b) { sum_ += a * b; }
  Scaled value() const { return sum_; }

 private:
  Real sum_ = k_zero;
#endif
};

/// A sum of products.
class ProductSum {
 public:
#if DETENT_FIXED
  /// Adds a b, exactly. Overflow: none if the sum of the products' magnitudes is below 2^35.
  void add(Real a, Real b) { sum_ = sum_ + Int128::product(a.raw, b.raw); }
  /// Rounding: to nearest, ties up. Overflow: wraps.
  Real value() const { return Real::from_raw(sum_.round_shift<k_real_frac>()); }

 private:
  Int128 sum_ = Int128::from(0);
#else
  void add(Real a, Real b) { sum_ += a * b; }
  Real value() const { return sum_; }

 private:
  Real sum_ = k_zero;
#endif
};

/// Whether products with the axis of a row are computed. In fixed point the products of an angular row are left out,
/// because they are 0. In float they are computed, because they may change the sign of a zero.
inline bool has_axis([[maybe_unused]] const JointRow& row) { return !DETENT_FIXED || is_linear(row); }

/// Computes one body's part of J v, for the first `rows` rows of a joint: axis . v + arm . w. The caller must negate
/// the part of A. The three rows of the anchor points are always computed.
inline void show(const JointWork& work, uint32_t rows, uint32_t end, const Vec3<Real>& linear_velocity,
                 const Vec3<Real>& angular_velocity, Real (&speed)[k_joint_rows_max]) {
  if (work.points != 0) {
    const Vec3<Real> at_point = linear_velocity + cross(angular_velocity, work.arm[end]);
    speed[0] = at_point.x;
    speed[1] = at_point.y;
    speed[2] = at_point.z;
  }
  for (uint32_t k = first_other(work); k < rows; ++k) {
    const JointRow& row = work.row[k];
    const Real rotational = dot(angular_velocity, row.arm[end]);
    speed[k] = has_axis(row) ? dot(linear_velocity, row.axis) + rotational : rotational;
  }
}

/// Limit of the impulse of a row in a solution, in the unit of the row. If an impulse exceeds the limit, all rows of
/// the assembly become softer, and if that is not enough, all its impulses are scaled down.
#if defined(DETENT_F64)
inline constexpr Real k_solution_max = 0x1p24;
#else
inline constexpr Real k_solution_max = 16384.0;
#endif
/// Limit of an impulse in the back substitution, before the terms of the other rows of the same joint are subtracted.
inline constexpr Real k_solved_max = k_solution_max * Real(4.0);
/// Limit of the velocity change of a body by its joints, m/s. The sum of two such values fits a Real.
inline constexpr Real k_gathered_max = 65504.0;

/// Adds the impulses J^T x of a joint's rows to `push` and `twist` of its mobile bodies, in the unit of each body,
/// 2^JointBody::power reference masses times m/s. Returns false if a sum exceeds k_gathered_max in fixed point. Range:
/// |x| <= k_solution_max.
#if DETENT_JOINT_LANES
inline bool gather(const JointStage& stage, const JointWork& work) {
  const JointLanes& lanes = lanes_of(stage, work);
  for (uint32_t end = 0; end < 2; ++end) {
    JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    RowFour force = {}, torque = {};
    with_rows(work.rows, [&](auto rows) {
      const uint32_t count = rows;
      DETENT_UNROLL
      for (uint32_t k = 0; k < count; ++k) {
        const RowFour impulse = spread(work.impulse[k]);
        force += load_four(lanes.row[end][k]) * impulse;
        torque += load_four(lanes.row[end][k] + k_rows_of_four) * impulse;
      }
    });
    // The fourth lane is the next member of JointBody: `pushed`, or an element of kept_rotation. 0 is added to it.
    const RowFour push = load_four(&body.push.x), twist = load_four(&body.twist.x);
    store_four(end == 0 ? push - force : push + force, &body.push.x);
    store_four(end == 0 ? twist - torque : twist + torque, &body.twist.x);
  }
  return true;
}
#else
inline bool gather(const JointStage& stage, const JointWork& work) {
  constexpr int k_kinds = DETENT_FIXED ? 2 : 1;  // kinds of rows with their own unit: linear, angular
  int kinds = 1;                                 // 2 if the joint has angular rows
  Vec3<Real> force = k_zero_vector, torque[k_kinds][2] = {};
  if (work.points != 0) {
    force = {work.impulse[0], work.impulse[1], work.impulse[2]};
    for (int end = 0; end < 2; ++end) torque[0][end] = cross(work.arm[end], force);
  }
  for (uint32_t k = first_other(work); k < work.rows; ++k) {
    const JointRow& row = work.row[k];
    const int kind = DETENT_FIXED ? row_kind(row) : 0;
    if (kind == 1)
      kinds = 2;
    else
      force += row.axis * work.impulse[k];
    for (int end = 0; end < 2; ++end) torque[kind][end] += row.arm[end] * work.impulse[k];
  }
  bool fits = true;
  for (int end = 0; end < 2; ++end) {
    JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const auto add = [&]([[maybe_unused]] int kind, const Vec3<Real>& sum, Vec3<Real>& to) {
#if DETENT_FIXED
      const Vec3<Real> part = scale_by_power(sum, impulse_power(work, kind) - body.power);
#else
      const Vec3<Real>& part = sum;
#endif
      if (end == 0)
        to -= part;
      else
        to += part;
      fits = fits && (!DETENT_FIXED || greatest(to) <= k_gathered_max);
    };
    add(0, force, body.push);
    for (int kind = 0; kind < kinds; ++kind) add(kind, torque[kind][end], body.twist);
    if (!fits) return false;  // a further sum could overflow
  }
  return true;
}
#endif

/// Converts the impulses that gather() has added to a body's `push` and `twist` to changes of its velocity and angular
/// momentum. Returns false if one exceeds k_gathered_max.
inline bool convert_impulses(JointBody& body) {
#if DETENT_JOINT_LANES
  // The fourth lane, the next member of JointBody, is multiplied by 1.
  const Real mass = body.inverse_mass, angular = scale_by_power(mass, body.above);
  const RowFour push = load_four(&body.push.x) * RowFour{mass, mass, mass, 1};
  const RowFour twist = load_four(&body.twist.x) * RowFour{angular, angular, angular, 1};
  store_four(push, &body.push.x);
  store_four(twist, &body.twist.x);
  return are_within(push, k_gathered_max, k_sizes_of_three) && are_within(twist, k_gathered_max, k_sizes_of_three);
#else
  bool saturated = false, fits = true;
  Scaled factor = scaled_by_power(body.inverse_mass, body.power);
  Vec3<Real>* const sums[] = {&body.push, &body.twist};
  for (Vec3<Real>* const sum : sums) {
    *sum = multiply(*sum, factor, saturated);
    fits = fits && greatest(*sum) <= k_gathered_max;
    factor = scaled_by_power(factor, body.above);
  }
  return fits && !saturated;
#endif
}

/// Chooses the units of a joint's impulses, 2^power reference masses x m/s, such that the responses of the joint's rows
/// are near 2^5. Then the impulses between heavy bodies stay in range, even in an assembly with light bodies. Range:
/// load_inertia() and make_joint_rows() have been called.
void choose_unit(const JointStage& stage, JointWork& work);

/// The factor of the joints of an assembly.
class JointFactor {
 public:
  /// `dropped`: there was no room for some couplings. Then the magnitudes of the missing elements are added to the
  /// diagonal. As a result the solve enforces the rows only partly: it removes less energy than a full solve, and never
  /// adds energy.
  JointFactor(JointStage& stage, Span<const uint32_t> order, bool dropped)
      : stage_(stage), order_(order), dropped_(dropped) {}

  /// Makes the factor from the current rows and the bodies' inertias.
  void make();
  /// Makes the factor again with softer rows. Returns false if the rows are as soft as they can be.
  bool make_softer();
  /// Multiplies the right-hand sides b by L^-1. Returns b . (K + S)^-1 b. Without the softness S, this is twice the
  /// least energy of any motion with the row speeds b.
  Scaled substitute();
  /// Computes the impulses from the substituted right-hand sides: x = L^-T D^-1 (L^-1 b).
  void solve();
  uint32_t saturated = 0;  ///< values that were clamped

 private:
  JointStage& stage_;
  Span<const uint32_t> order_;
  bool dropped_;
  int softer_calls_ = 0;

  void make_up(uint32_t index);
  void start(JointWork& work);
  void add_responses(JointWork& work);
  void eliminate(JointWork& work);
  /// A diagonal element of the joint's own block.
  Real& diagonal(JointWork& work, uint32_t row) {
#if DETENT_JOINT_LANES
    return lanes_of(stage_, work).upper[row][row];
#else
    return work.response[row][row];
#endif
  }
  const JointCoupling* find(uint32_t one, uint32_t other) const;
  Real* block_of(const JointCoupling& coupling) { return stage_.numbers.data + coupling.block; }
  /// Visits a joint's couplings with joints that are eliminated later, in the order of elimination.
  template <class Visit>
  void each_coupling(const JointWork& work, const Visit& visit) const {
    for (uint32_t at = work.coupling; at != k_no_link; at = stage_.couplings[at].next[0]) visit(stage_.couplings[at]);
  }
  /// Visits the couplings of joint[0] of `coupling` that follow `coupling`. With each of them, passes the block between
  /// its joint[1] and the joint[1] of `coupling`, or null if there was no room for that block. Blocks are sorted by the
  /// elimination order of joint[1].
  template <class Visit>
  void each_pair(const JointCoupling& coupling, const Visit& visit) {
    uint32_t between = stage_.work[coupling.joint[1]].coupling;
    for (uint32_t at = coupling.next[0]; at != k_no_link; at = stage_.couplings[at].next[0]) {
      const JointCoupling& further = stage_.couplings[at];
      Real* block = nullptr;
      for (; between != k_no_link; between = stage_.couplings[between].next[0]) {
        const JointCoupling& known = stage_.couplings[between];
        if (known.joint[1] == further.joint[1]) block = block_of(known);
        if (block != nullptr || known.block > further.block) break;
      }
      visit(further, block);
    }
  }
#if DETENT_JOINT_LANES
  template <bool wide>
  void add_responses_of_end(JointWork& work, uint32_t end);
  template <bool wide>
  void eliminate_own(JointWork& work);
  template <class Height>
  void eliminate_couplings(JointWork& work, Height height);
  template <class Height>
  void substitute_joint(JointWork& work, Height height, EnergySum& energy);
  template <class Height>
  void solve_joint(JointWork& work, Height height);
#endif
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
