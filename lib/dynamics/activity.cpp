#include "dynamics/activity.h"

#include "dynamics/predict.h"
#include "geometry/shape_traits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_rest_power = -6;

}  // namespace

bool is_moving(const BodyTraits& traits, const BodyMotion& motion, const BodyActivity& activity) {
  if (is_dynamic(traits)) return activity.asleep == 0;
  return type_of(traits) == BodyType::kinematic &&
         !(motion.velocity == k_zero_vector && motion.momentum == k_zero_vector);
}

uint32_t wake_all_with(uint32_t slot, Span<BodyActivity> activities, BitSet visits) {
  const uint32_t group = activities[slot].asleep;
  if (group == 0) return 0;
  uint32_t count = 0;
  for (uint32_t other = 0; other < activities.count; ++other) {
    BodyActivity& activity = activities[other];
    if (activity.asleep != group) continue;
    activity.asleep = 0;
    activity.still_ticks = 0;
    activity.news = static_cast<uint16_t>(BodyEventType::woke);
    visits.set(other);
    ++count;
  }
  return count;
}

uint32_t fall_asleep(const StepSettings& settings, Span<const BodyTraits> traits, Span<const BodyPose> poses,
                     Span<const BodySweep> sweeps, Span<const Island> islands, Span<const uint32_t> bodies,
                     Span<BodyMotion> motions, Span<BodyActivity> activities) {
  uint32_t asleep = 0;
  for (const Island& island : islands) {
    bool still = true;
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      const Real slow = scale_by_power(fall_speed(settings, shape_extent(traits[slot])), k_rest_power);
      const Real way = absolute_sum(sweeps[slot].displacement) +
                       scale_by_power(absolute_sum(sweeps[slot].turn), traits[slot].size_exponent);
      const bool rests = speed_bound(traits[slot], poses[slot].rotation, motions[slot]) < slow &&
                         way < slow * settings.tick_time;
      uint16_t& ticks = activities[slot].still_ticks;
      ticks = static_cast<uint16_t>(!rests ? 0 : ticks < k_still_ticks ? ticks + 1 : ticks);
      still = still && ticks == k_still_ticks;
    }
    if (!still) continue;
    const uint32_t group = bodies[island.first_body] + 1;
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      motions[slot].velocity = motions[slot].momentum = k_zero_vector;
      activities[slot].asleep = group;
      activities[slot].news = static_cast<uint16_t>(BodyEventType::fell_asleep);
    }
    asleep += island.body_count;
  }
  return asleep;
}

const SleepingCode k_sleeping_code = {fall_asleep};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
