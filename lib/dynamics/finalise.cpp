#include "dynamics/finalise.h"

#include "dynamics/spin.h"
#include "geometry/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

uint32_t hold(Real& value) {
  const Real held = clamp(value, -k_speed_max, k_speed_max);
  const bool clamped = !(held == value);
  value = held;
  return clamped ? 1 : 0;
}

}  // namespace

uint32_t hold_speeds(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion) {
  uint32_t clamped = hold(motion.velocity.x) + hold(motion.velocity.y) + hold(motion.velocity.z);
  const Vec3<Real> spin = spin_of(traits, rotation, motion.momentum);
  const Real fastest = max(abs(spin.x), max(abs(spin.y), abs(spin.z)));
  if (fastest > k_spin_max) {
    const Real factor = divide(k_spin_max, fastest);
    motion.momentum = {motion.momentum.x * factor, motion.momentum.y * factor, motion.momentum.z * factor};
    ++clamped;
  }
  return clamped;
}

uint32_t finalise(Span<const BodyTraits> traits, Span<const BodyWork> work, Span<BodyPose> poses,
                  Span<BodyMotion> motions) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    const BodyTraits& body = traits[slot];
    if (body.type == 0 || type_of(body) == BodyType::fixed) continue;
    const BodyWork& now = work[slot];
    BodyPose& pose = poses[slot];
    bool turns_clamped = false;
    const int exponent = body.size_exponent;
    const Vec3<Real> turn = {angle_of(now.turn.x, exponent, turns_clamped),
                             angle_of(now.turn.y, exponent, turns_clamped),
                             angle_of(now.turn.z, exponent, turns_clamped)};
    const Sweep sweep = sweep_between(pose.rotation, now.rotation, now.displacement, turn);
    pose.rotation = sweep_end_rotation(pose.rotation, sweep);
    clamped += sweep_end_position(pose, sweep) + (turns_clamped ? 1 : 0);
    if (is_dynamic(body)) clamped += hold_speeds(body, pose.rotation, motions[slot]);
  }
  return clamped;
}

void store_contacts(Span<const ContactWork> work, Span<ContactState> contacts, uint32_t before) {
  for (uint32_t i = 0; i < work.count; ++i) contacts[i] = work[i].state;
  for (uint32_t i = work.count; i < before; ++i) contacts[i] = ContactState{};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
