#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "contact/collide.h"
#include "motion/contact_motion.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// One body of a contact, as input for the rows. Its inverse inertia and its angular velocity are in world axes. The
/// angular velocity is stored as BodyWork::angular_velocity: times the body's unit of length, in units of
/// 2^k_angular_velocity_power m/s. `extent`: smallest diameter of the body's shape, m. `fall`: fall_speed() of
/// `extent`, m/s.
struct RowBody {
  const BodyProperties& properties;
  const BodyPose& pose;
  const BodyMotion& motion;
  const WorldInverseInertia& inverse_inertia;
  const Vec3<Real>& angular_velocity;
  Real extent, fall;
  bool jointed = false;  ///< the body has joints: only contact rows stop it, not impacts (impact.h)
};

/// Fills the rows of `work` from the geometry: arms, responses, effective masses, limits, and the approach speeds at
/// the start of the tick. `work.state` must be set before the call; its impulses are converted to the contact's frame.
/// `ahead`: the time, s, after that of the geometry for which the arms are computed (advance_arms()). The solver passes
/// half a tick, because arms of the middle of the tick make its errors of second order.
///
/// With n the normal from A to B, t and s the tangents, r_A and r_B the arms from the centres, v and w the velocities
/// and angular velocities, u the pair's unit of length, and columns (v_A, w_A, v_B, w_B), the rows are:
///
///     normal, point i:  C = separation along n >= 0
///                       J = (-n, -(r_A x n), n, r_B x n), with the arms to the point
///     friction along t: J = (-t, -(r_A x t), t, r_B x t), with the arms to the middle of the points; same for s
///     twist:            J = (0, -n, 0, n) u
///     rolling about t:  J = (0, -t, 0, t) u; same for s
///
/// For two linear rows of directions d and e, arms r and q:
///
///     K = J M^-1 J^T = (1/m_A + 1/m_B) d . e + (r_A x d) . I_A^-1 (q_A x e) + (r_B x d) . I_B^-1 (q_B x e)
///
/// All K are stored times the reference mass m, the mass of the lighter dynamic body: `coupling` has the K of the
/// normal rows of each pair of points, `response` the K of the parts of a wrench at the middle of the points. The
/// effective masses `normal_mass` and `twist_mass` are 1 / (m K), where K is the diagonal element of the row.
/// `friction_mass` and `rolling_mass` each belong to a pair of rows: 1 / (m k), where k is the greatest eigenvalue of
/// their 2 x 2 matrix K.
/// The solver accumulates the impulse of each row, within these limits:
///
///     normal:   impulse >= 0
///     friction: |impulse| <= friction coefficient x sum of the normal impulses, as a vector along t and s
///     twist:    |impulse| <= twist_arm x sum of the normal impulses
///     rolling:  |impulse| <= rolling_arm x sum of the normal impulses, as a vector about t and s
///
/// A friction, twist or rolling row has no C: its target is J v = 0. contact_solver.h has the targets of the normal
/// rows.
void make_rows(const StepSettings& settings, const RowBody& a, const RowBody& b, const ContactGeometry& geometry,
               Real ahead, ContactWork& work);

/// Leaves the impact of a contact to continuous collision, if the contact's bodies do not overlap and approach so fast
/// that they will rebound. To do so, the function disables the normal rows of the contact: it sets their effective
/// masses to zero. The solver would distribute the impulse of the impact among all bodies in contact, while continuous
/// collision resolves impacts one after the other.
void leave_to_impact(const StepSettings& settings, const RowBody& a, const RowBody& b, ContactWork& work);
inline bool is_left_to_impact(const ContactWork& work) { return work.normal_mass[0] == Unit(0.0); }

/// Recomputes the responses, couplings and effective masses of `work` for the inverse inertias `a` and `b` of its
/// bodies. The other members stay unchanged.
void renew_response(const WorldInverseInertia& a, const WorldInverseInertia& b, ContactWork& work);

/// The matrix K of a contact times the reference mass: the change of the bodies' relative motion by a unit wrench at
/// the middle of the contact's points. response_index() gives the index of an element.
struct PairResponse {
  Real part[k_responses];
};

/// Computes the response with the precision of Real. make_rows() stores a less precise response: each element is
/// rounded to 2^-30 of the largest element, which is a large error for a slender body.
PairResponse respond_exactly(const BodyProperties& a, const Quat& rotation_a, const BodyProperties& b,
                             const Quat& rotation_b, const ContactWork& work);

/// Stores the friction and angular impulses of the solve in `work.state`, in world axes.
void store_impulses(ContactWork& work);

/// Whether the contact's bodies stay apart in a tick with the given motions: displacements, m, and rotation vectors
/// times the bodies' units of length, m, both in world axes. Each point must meet a condition, to first order in the
/// motion: if it is open at the start of the tick, it becomes at most `depth`, m, deep; if it overlaps at the start, it
/// becomes at most `depth` deeper.
bool keeps_apart(const ContactWork& contact, const Vec3<Real>& displacement_a, const Vec3<Real>& rotation_vector_a,
                 const Vec3<Real>& displacement_b, const Vec3<Real>& rotation_vector_b, Real depth);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
