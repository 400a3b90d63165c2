#include "replay/command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

const char* record_name(RecordTag tag) {
  switch (tag) {
    case RecordTag::create_body:
      return "create_body";
    case RecordTag::destroy_body:
      return "destroy_body";
    case RecordTag::set_pose:
      return "set_pose";
    case RecordTag::set_velocity:
      return "set_velocity";
    case RecordTag::apply_force:
      return "apply_force";
    case RecordTag::apply_torque:
      return "apply_torque";
    case RecordTag::apply_impulse:
      return "apply_impulse";
    case RecordTag::apply_impulse_at:
      return "apply_impulse_at";
    case RecordTag::apply_angular_impulse:
      return "apply_angular_impulse";
    case RecordTag::set_gravity:
      return "set_gravity";
    case RecordTag::set_user_data:
      return "set_user_data";
    case RecordTag::bind_asset:
      return "bind_asset";
    case RecordTag::tick:
      return "tick";
    case RecordTag::tick_digested:
      return "tick_digested";
    case RecordTag::wake_body:
      return "wake_body";
    case RecordTag::sleep_body:
      return "sleep_body";
    case RecordTag::set_type:
      return "set_type";
    case RecordTag::set_shape:
      return "set_shape";
    case RecordTag::set_mass:
      return "set_mass";
    case RecordTag::set_inertia:
      return "set_inertia";
    case RecordTag::set_density:
      return "set_density";
    case RecordTag::set_material:
      return "set_material";
    case RecordTag::set_damping:
      return "set_damping";
    case RecordTag::set_gravity_scale:
      return "set_gravity_scale";
    case RecordTag::set_rotation_locks:
      return "set_rotation_locks";
    case RecordTag::set_settings:
      return "set_settings";
    case RecordTag::apply_force_at:
      return "apply_force_at";
    case RecordTag::apply_force_at_point:
      return "apply_force_at_point";
    case RecordTag::apply_impulse_at_point:
      return "apply_impulse_at_point";
    case RecordTag::explode:
      return "explode";
    case RecordTag::move_kinematic:
      return "move_kinematic";
    case RecordTag::set_sensor:
      return "set_sensor";
    case RecordTag::set_filter:
      return "set_filter";
    case RecordTag::query:
      return "query";
    case RecordTag::create_joint:
      return "create_joint";
    case RecordTag::destroy_joint:
      return "destroy_joint";
    case RecordTag::set_joint:
      return "set_joint";
    default:
      return "";
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
