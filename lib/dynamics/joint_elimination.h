#pragma once
#include <detent/detail/scratch.h>

#include "base/unroll.h"
#include "math/arithmetic.h"
#include "math/scaled.h"

/// How the rows of a joint and the bodies that it holds see each other, and what is left of a body's response once they
/// are held.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline Vec3<Real> real_from(const Vec3<Unit>& v) {
  return {real_from_unit(v.x, 0), real_from_unit(v.y, 0), real_from_unit(v.z, 0)};
}

inline bool is_linear(const JointRow& row) { return !(row.axis == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}); }

/// What a body's velocity and spin become for each row's unit of impulse.
using Reply = Real[k_joint_rows_max][6];

inline Vec3<Real> first_three(const Real (&six)[6]) { return {six[0], six[1], six[2]}; }
inline Vec3<Real> last_three(const Real (&six)[6]) { return {six[3], six[4], six[5]}; }

template <bool only_points>
inline void respond(const JointWork& work, const JointBody& body, uint32_t end, Reply& reply) {
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
inline void couple(const JointWork& work, uint32_t end, const Reply& reply,
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
inline void show(const JointWork& work, uint32_t end, const Vec3<Real>& velocity, const Vec3<Real>& spin,
                 Real (&speed)[k_joint_rows_max]) {
  if (work.points != 0) {
    const Vec3<Real> at_point = velocity + cross(spin, work.arm[end]);
    speed[0] = at_point.x;
    speed[1] = at_point.y;
    speed[2] = at_point.z;
  }
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows; ++k)
    speed[k] = dot(velocity, work.row[k].axis) + dot(spin, work.row[k].arm[end]);
}

/// The force and the torque of the rows' impulses on a body.
template <bool only_points>
inline void gather(const JointWork& work, uint32_t end, Vec3<Real>& force, Vec3<Real>& torque) {
  force = torque = k_zero_vector;
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
inline void factor(Real (&response)[k_joint_rows_max][k_joint_rows_max], JointWork& work) {
  const uint32_t rows = only_points ? 3 : work.rows;
  DETENT_UNROLL
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
inline void take_from(const JointWork& work, JointBody& parent) {
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

/// Makes the replies L^-1 of theirs, and over the pivots.
template <int width>
inline void substitute(uint32_t rows, JointWork& work) {
  DETENT_UNROLL
  for (uint32_t k = 0; k < rows; ++k) {
    for (uint32_t m = 0; m < k; ++m) {
      const Real share = work.lower[k][m];
      DETENT_UNROLL
      for (int i = 0; i < width; ++i) work.reply[k][i] -= work.reply[m][i] * share;
    }
    DETENT_UNROLL
    for (int i = 0; i < width; ++i) work.reply_scaled[k][i] = multiply(work.reply[k][i], work.inverse[k]);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
