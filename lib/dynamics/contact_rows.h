#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "collision/collide.h"
#include "dynamics/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// One body of a contact, as the rows see it.
struct RowBody {
  const BodyTraits& traits;
  const BodyPose& pose;
  const BodyMotion& motion;
};

/// Fills the rows of `work`, whose `state` is set, from the geometry: arms, responses, effective masses, limits and the
/// approach speeds of the start of the tick. Impulses of the state are taken over.
void make_rows(const StepSettings& settings, const RowBody& a, const RowBody& b, const ContactGeometry& geometry,
               ContactWork& work);

/// Puts the impulses of the solve back into `work.state`.
void store_impulses(ContactWork& work);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
