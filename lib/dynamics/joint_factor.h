#pragma once
#include "base/unroll.h"
#include "dynamics/joint.h"
#include "math/scaled.h"

/// How the rows of a joint and the bodies that it holds see each other, and the factor of all joints of an island:
/// a block L D L^T, with a block of a joint's own rows in JointWork::response, and those of its couplings in
/// JointStage::numbers.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline Vec3<Real> real_from(const Vec3<Unit>& v) {
  return {real_from_unit(v.x, 0), real_from_unit(v.y, 0), real_from_unit(v.z, 0)};
}

/// The rows that are not those of the anchors begin here.
inline uint32_t first_other(const JointRows& rows) { return rows.points != 0 ? 3 : 0; }

/// Twice an energy over the reference mass: a sum of products of impulses and speeds.
class EnergySum {
 public:
#if DETENT_FIXED
  /// Rounding: both factors down, to 2^-37. Overflow: none for fewer than 2^18 products.
  void add(Real a, Real b) { sum_ = sum_ + Int128::product(a.raw >> k_drop, b.raw >> k_drop); }
  Scaled value() const {
    const bool negative = sum_ < Int128::from(0);
    const Int128 size = negative ? -sum_ : sum_;
    if (size.high_word() == 0) return from(negative, size.low_word(), 0);
    const int shift = bit_length_64(static_cast<uint64_t>(size.high_word())) + 1;  // rounded up it still fits
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

/// The speeds of the rows that a body's motion gives.
inline void show(const JointWork& work, uint32_t end, const Vec3<Real>& velocity, const Vec3<Real>& spin,
                 Real (&speed)[k_joint_rows_max]) {
  if (work.points != 0) {
    const Vec3<Real> at_point = velocity + cross(spin, work.arm[end]);
    speed[0] = at_point.x;
    speed[1] = at_point.y;
    speed[2] = at_point.z;
  }
  for (uint32_t k = first_other(work); k < work.rows; ++k)
    speed[k] = dot(velocity, work.row[k].axis) + dot(spin, work.row[k].arm[end]);
}

/// Of a row's impulse in a solution; beyond it all are made less.
#if defined(DETENT_F64)
inline constexpr Real k_solution_max = 0x1p24;
#else
inline constexpr Real k_solution_max = 16384.0;
#endif
/// What a body gets from its joints at most, m/s: two of them fit a Real.
inline constexpr Real k_gathered_max = 65504.0;

/// Adds to a body's push and twist what the rows' impulses do to it at an end. False if that is beyond k_gathered_max.
inline bool gather(const JointWork& work, uint32_t end, JointBody& body) {
  Vec3<Real> force = k_zero_vector, torque = k_zero_vector, turn = k_zero_vector;
  const Real* impulse = work.impulse;
  if (work.points != 0) {
    force = {impulse[0], impulse[1], impulse[2]};
    torque = cross(work.arm[end], force);
  }
  for (uint32_t k = first_other(work); k < work.rows; ++k) {
    if (is_linear(work.row[k])) {
      force += work.row[k].axis * impulse[k];
      torque += work.row[k].arm[end] * impulse[k];
    } else {
      turn += work.row[k].arm[end] * impulse[k];
    }
  }
  bool fits = true;
  const auto add = [&](const Vec3<Real>& v, Scaled share, Vec3<Real>& to) {
    bool saturated = false;
    const Vec3<Real> part = {multiply(v.x, share, saturated), multiply(v.y, share, saturated),
                             multiply(v.z, share, saturated)};
    fits = fits && !saturated && greatest(part) <= k_gathered_max;
    if (!fits) return;
    to = end == 1 ? to + part : to - part;
    fits = greatest(to) <= k_gathered_max;
  };
  add(force, scaled_by_power(body.share, impulse_power(work, 0)), body.push);
  add(torque, scaled_by_power(body.share, impulse_power(work, 0) + body.above), body.twist);
  if (work.rows > 3 || work.points == 0)
    add(turn, scaled_by_power(body.share, impulse_power(work, 1) + body.above), body.twist);
  return fits;
}

/// Chooses the units of a joint's impulses, 2^power reference masses, for which its rows' responses are near 2^5: so
/// impulses between heavy bodies stay within their range beside light ones. Range: the bodies' inertias are loaded, the
/// rows are made.
void choose_unit(const JointStage& stage, JointWork& work);

/// A factor of the joints of an island.
class JointFactor {
 public:
  /// `dropped`: some couplings had no room. What they would have been is made up for on the diagonal: then the rows are
  /// held in part, which takes less energy than holding them.
  JointFactor(JointStage& stage, Span<const uint32_t> order, bool dropped)
      : stage_(stage), order_(order), dropped_(dropped) {}

  /// Makes it of the rows as they are, with the bodies' inertias.
  void make();
  /// Makes it anew with softer rows. False if they are that already.
  bool make_softer();
  /// L^-1 of the sides. Returns the sides' energy: twice what they have as the motion of least energy that shows them.
  Scaled substitute();
  /// The impulses of the sides that were substituted.
  void solve();
  uint32_t saturated = 0;  ///< values that were clamped

 private:
  JointStage& stage_;
  Span<const uint32_t> order_;
  bool dropped_;
  bool softer_ = false;

  void make_up(uint32_t index);
  void start(JointWork& work);
  void eliminate(JointWork& work);
  const JointCoupling* find(uint32_t one, uint32_t other) const;
  Real* block_of(const JointCoupling& coupling) { return stage_.numbers.data + coupling.block; }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
