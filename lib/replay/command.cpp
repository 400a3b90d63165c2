#include "replay/command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

template <class... Commands>
struct List {
  static constexpr const CommandCode* codes[] = {&k_command_code<Commands>...};
  static_assert(((sizeof(Commands) <= k_command_bytes_max && alignof(Commands) <= 8) && ...));
};
using All = List<CreateBody, DestroyBody, SetPose, SetVelocity, ApplyForce, ApplyTorque, ApplyImpulse, ApplyImpulseAt,
                 ApplyAngularImpulse, SetGravity, SetUserData, BindAsset, WakeBody, SleepBody, SetType, SetShape,
                 SetMass, SetInertia, SetDensity, SetMaterial, SetDamping, SetGravityScale, SetRotationLocks, SetSensor,
                 SetSettings, ApplyForceAt, ApplyForceAtPoint, ApplyImpulseAtPoint, Explode, MoveKinematic, SetFilter,
                 CreateJoint, DestroyJoint, SetJoint>;

}  // namespace

const CommandCode* find_command(RecordTag tag) {
  for (const CommandCode* code : All::codes) {
    if (code->tag == tag) return code;
  }
  return nullptr;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
