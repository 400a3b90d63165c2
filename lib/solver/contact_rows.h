#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "contact/collide.h"
#include "motion/contact_motion.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// One body of a contact, as the rows see it: its gyration and its spin, 2^-k_spin_power m/s, are in world axes; its
/// extent, m, and the speed of a fall by it, m/s.
struct RowBody {
  const BodyTraits& traits;
  const BodyPose& pose;
  const BodyMotion& motion;
  const WorldGyration& gyration;
  const Vec3<Real>& spin;
  Real extent, fall;
  bool jointed = false;  ///< no impact stops it (impact.h): its contacts do
};

/// Fills the rows of `work`, whose `state` is set, from the geometry: arms, responses, effective masses, limits and the
/// approach speeds of the start of the tick. Impulses of the state are taken over.
void make_rows(const StepSettings& settings, const RowBody& a, const RowBody& b, const ContactGeometry& geometry,
               ContactWork& work);

/// Leaves a contact to the impacts, whose bodies are not in each other and come together so fast that they rebound: the
/// solver pushes nothing there. It would share a blow among all that touch; impacts come one after the other.
void leave_to_impact(const StepSettings& settings, const RowBody& a, const RowBody& b, ContactWork& work);
inline bool is_left_to_impact(const ContactWork& work) { return work.inverse_mass[0] == Unit(0.0); }

/// Makes the responses and effective masses anew for the gyrations of A and B, where they have turned since; all else
/// stays.
void renew_response(const WorldGyration& a, const WorldGyration& b, ContactWork& work);

/// What a wrench does to the motion of a pair, by response_index().
struct PairResponse {
  Real part[k_responses];
};

/// As precise as Real allows: what make_rows() has in the work is rounded to 2^-30 of the largest part, which of a
/// slender body is much.
PairResponse respond_exactly(const BodyTraits& a, const Quat& rotation_a, const BodyTraits& b, const Quat& rotation_b,
                             const ContactWork& work);

/// Puts the impulses of the solve back into `work.state`.
void store_impulses(ContactWork& work);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
