#pragma once
#include <detent/recording.h>

/// Shorthand for scene files. A scene's body that cannot be made is a fault of the scene: it stops at once.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline void must(Status status) {
  if (status != Status::ok) __builtin_trap();
}

inline BodyId make_body(Recorder& recorder, const BodyDef& def) {
  BodyId id;
  must(recorder.create_body(def, id));
  return id;
}

/// The half-space y <= 0.
inline void make_ground(Recorder& recorder) {
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = half_space();
  make_body(recorder, def);
}

inline WorldDef world_of(uint32_t bodies, uint32_t contacts) {
  WorldDef def;
  def.capacity.bodies = bodies;
  def.capacity.contacts = contacts;
  return def;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
