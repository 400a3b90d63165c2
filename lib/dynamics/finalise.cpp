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

uint32_t make_sweeps(Span<const BodyTraits> traits, Span<const BodyWork> work, Span<const BodyPose> poses,
                     Span<BodySweep> sweeps) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    const BodyTraits& body = traits[slot];
    sweeps[slot] = {};
    if (body.type == 0 || type_of(body) == BodyType::fixed) continue;
    const BodyWork& now = work[slot];
    bool turns_clamped = false;
    const int exponent = body.size_exponent;
    const Vec3<Real> turn = {angle_of(now.turn.x, exponent, turns_clamped),
                             angle_of(now.turn.y, exponent, turns_clamped),
                             angle_of(now.turn.z, exponent, turns_clamped)};
    const Sweep sweep = sweep_between(poses[slot].rotation, now.rotation, now.displacement, turn);
    sweeps[slot].displacement = sweep.displacement;
    sweeps[slot].turn = sweep.turn;
    clamped += turns_clamped ? 1 : 0;
  }
  return clamped;
}

uint32_t finalise(Span<const BodyTraits> traits, Span<const BodySweep> sweeps, Span<BodyPose> poses,
                  Span<BodyMotion> motions) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    const BodyTraits& body = traits[slot];
    if (body.type == 0 || type_of(body) == BodyType::fixed) continue;
    BodyPose& pose = poses[slot];
    const Sweep rest = rest_of_tick(sweeps[slot]);
    pose.rotation = sweep_end_rotation(pose.rotation, rest);
    clamped += sweep_end_position(pose, rest);
    if (is_dynamic(body)) clamped += hold_speeds(body, pose.rotation, motions[slot]);
  }
  return clamped;
}

void store_contacts(Span<const ContactWork> work, Span<const ManifoldState> manifold_work, uint32_t sleeping,
                    uint32_t before, Span<ContactState> contacts, Span<ManifoldState> manifolds) {
  const bool has_manifolds = manifolds.count != 0;
  const auto precedes = [](const ContactState& a, const ContactState& b) {
    return a.body_a < b.body_a || (a.body_a == b.body_a && a.body_b < b.body_b);
  };
  const uint32_t count = sleeping + work.count;
  uint32_t left = work.count;
  for (uint32_t place = count; left > 0; --place) {
    const ContactState& state = work[left - 1].state;
    const bool sleeps = sleeping > 0 && precedes(state, contacts[sleeping - 1]);
    contacts[place - 1] = sleeps ? contacts[sleeping - 1] : state;
    if (has_manifolds) manifolds[place - 1] = sleeps ? manifolds[sleeping - 1] : manifold_work[left - 1];
    sleeping -= sleeps ? 1 : 0;
    left -= sleeps ? 0 : 1;
  }
  for (uint32_t i = count; i < before; ++i) {
    contacts[i] = ContactState{};
    if (has_manifolds) manifolds[i] = ManifoldState{};
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
