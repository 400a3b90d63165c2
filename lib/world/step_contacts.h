#pragma once
#include "broad_phase/broadphase.h"
#include "broad_phase/overflow.h"
#include "joint/joint.h"
#include "motion/activity.h"
#include "motion/predict.h"
#include "shape/shape_properties.h"
#include "solver/contact_rows.h"
#include "state/step_cache.h"
#include "state/step_scratch.h"

/// The narrow phase of a step: wakes sleeping bodies that are touched, and finds the contacts of all pairs.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The data of all bodies, as the stages of a step before the solver use it.
struct StepBodies {
  Span<const BodyPose> poses;
  Span<const BodyProperties> properties;
  Span<const BodyMotion> motions;
  Span<BodyActivity> activities;
  Span<BodyWork> work;
  BitSet active;  ///< bodies that moved in the last step or were changed since (step_cache.h)
  AssetTable assets;
  const FeatureTable& features;

  RowBody at(uint32_t slot) const {
    const BodyWork& now = work[slot];
    return {properties[slot],     poses[slot], motions[slot], now.inverse_inertia,
            now.angular_velocity, now.extent,  now.fall,      now.joint_body != k_no_link};
  }
  CollisionBody collider(uint32_t slot) const { return {poses[slot], properties[slot], work[slot].axes}; }
  void start(const StepSettings& settings, uint32_t slot) const {
    start_body(settings, properties[slot], poses[slot], motions[slot], work[slot]);
  }
  bool awake(uint32_t slot) const { return is_awake(properties[slot], activities[slot]); }
  bool moving(uint32_t slot) const { return is_moving(properties[slot], motions[slot], activities[slot]); }
  bool asleep(uint32_t slot) const { return activities[slot].asleep != 0; }
  bool has_parts(uint32_t slot_a, uint32_t slot_b) const {
    return detent::has_parts(properties[slot_a], properties[slot_b]);
  }
};

/// Wakes each sleeping body that a moving body touches, then each sleeping body that a woken body touches, and so on.
/// Removes the woken bodies from the tree of resting bodies, and adds their pairs to `pool`. Returns the number of
/// bodies that woke.
uint32_t wake_touched(const StepSettings& settings, const StepBodies& bodies, const StepCacheView& cache,
                      PairPool& pool);

struct ContactCount {
  uint32_t contacts = 0;
  uint32_t points = 0;
  uint32_t dropped = 0;
  /// Touches (contacts of a triangle or of two parts) dropped because their pair has more than 16 contacts. The deepest
  /// are kept.
  uint32_t parts_dropped = 0;
  uint32_t capped = 0;
  uint32_t recycled = 0;
};

/// The contacts of the last tick.
struct LastContacts {
  Span<const ContactState> contacts;    ///< sorted by pair and part
  Span<const ManifoldState> manifolds;  ///< of these contacts, or empty
  Span<const uint32_t> awake;           ///< indices in `contacts` of those with an awake body; only these may continue
};

/// The arrays for the contacts of a tick, or a range of these arrays.
struct ContactRoom {
  const Scratch& scratch;
  uint32_t count;  ///< number of elements that may be used
  bool keeps_manifolds;
#if DETENT_TASKS
  uint32_t first = 0;  ///< index of the first element that may be used
#else
  static constexpr uint32_t first = 0;
#endif

  Span<ContactWork> contacts() const { return {scratch.contacts.data + first, count}; }
  Span<ManifoldState> manifolds() const {
    return {scratch.manifolds.data + (keeps_manifolds ? first : 0), keeps_manifolds ? count : 0};
  }
  Span<ContactOrder> by_depth() const { return scratch.contact_sort.first(count); }
  BitSet leaning() const { return scratch.candidates; }
};

/// Collides the pairs in ascending order, and computes the constraint rows of their contacts. The contacts are sorted
/// by pair and part. If `room` is too small, the shallowest contacts are dropped.
ContactCount find_contacts(const StepSettings& settings, const StepBodies& bodies, const LastContacts& last,
                           const ContactRoom& room, Overflow& overflow, Span<const uint64_t> pairs);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
