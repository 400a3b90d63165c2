#include "session.h"

#include <stdlib.h>
#include <string.h>

#include <new>

#include "fields.h"

namespace detent_web {

bool Bytes::append(const uint8_t* from, uint32_t byte_count) {
  if (byte_count > UINT32_MAX / 4 - count) return false;
  if (count + byte_count > capacity) {
    const uint32_t wanted = 2 * (count + byte_count) + 4096;
    uint8_t* moved = static_cast<uint8_t*>(realloc(data, wanted));
    if (moved == nullptr) return false;
    data = moved;
    capacity = wanted;
  }
  memcpy(data + count, from, byte_count);
  count += byte_count;
  return true;
}

namespace {

/// Takes the next `capacity` elements of the memory for events.
template <class Event, class Buffer>
uint8_t* place(Buffer& buffer, uint32_t capacity, uint8_t* memory) {
  buffer.data = reinterpret_cast<Event*>(memory);
  buffer.capacity = capacity;
  for (uint32_t i = 0; i < capacity; ++i) new (buffer.data + i) Event{};
  return memory + (sizeof(Event) * capacity + 7) / 8 * 8;
}

/// Makes room for the events of an ordinary step. A step with more events drops some, and its report counts them.
Status place_events(Session& session, const Capacity& capacity) {
  const uint64_t contacts = uint64_t{2} * capacity.contacts + 16, sensed = uint64_t{2} * capacity.sensed;
  const uint64_t bytes = contacts * sizeof(ContactEvent) + capacity.joints * sizeof(JointEvent) +
                         sensed * sizeof(SensorEvent) + capacity.bodies * sizeof(BodyEvent) +
                         contacts * sizeof(CapacityEvent) + 40;
  if (bytes > UINT32_MAX) return Status::buffer_too_small;
  session.events = malloc(static_cast<uint32_t>(bytes));
  if (session.events == nullptr) return Status::buffer_too_small;
  WorldHooks& hooks = session.world.hooks;
  uint8_t* at = static_cast<uint8_t*>(session.events);
  at = place<ContactEvent>(hooks.contact_events, static_cast<uint32_t>(contacts), at);
  at = place<JointEvent>(hooks.joint_events, capacity.joints, at);
  at = place<SensorEvent>(hooks.sensor_events, static_cast<uint32_t>(sensed), at);
  at = place<BodyEvent>(hooks.body_events, capacity.bodies, at);
  place<CapacityEvent>(hooks.capacity_events, static_cast<uint32_t>(contacts), at);
  return Status::ok;
}

}  // namespace

Status open_session(Session& session, const WorldDef& def, const uint32_t* asset_at, uint32_t asset_count) {
  const uint32_t bytes = world_bytes(def.capacity);
  if (bytes == 0) return Status::out_of_range;
  session.block = static_cast<uint8_t*>(malloc(bytes));
  session.assets = static_cast<Asset*>(calloc(asset_count + 1, sizeof(Asset)));
  if (session.block == nullptr || session.assets == nullptr) return Status::buffer_too_small;
  for (uint32_t i = 0; i < asset_count; ++i)
    session.assets[i] = {reinterpret_cast<const uint8_t*>(asset_at[2 * i]), asset_at[2 * i + 1]};
  WorldHooks hooks;
  hooks.assets = {session.assets, asset_count};
  const Status status = create_world(session.block, bytes, def, hooks, session.world);
  return status == Status::ok ? place_events(session, def.capacity) : status;
}

void close_session(Session& session) {
  free(session.recorder);
  free(session.recording.data);
  free(session.events);
  free(session.assets);
  free(session.block);
}

namespace {

Status write_recording(void* to, const uint8_t* bytes, uint32_t count) {
  return static_cast<Bytes*>(to)->append(bytes, count) ? Status::ok : Status::sink_failed;
}

bool make_recorder(Session& session, Sink sink) {
  if (session.recorder == nullptr) session.recorder = static_cast<Recorder*>(malloc(sizeof(Recorder)));
  if (session.recorder == nullptr) return false;
  new (session.recorder) Recorder(session.world, sink, session.recorder_buffer, sizeof session.recorder_buffer);
  return true;
}

}  // namespace

Status start_session(Session& session, Player& player, uint32_t byte_count, const uint32_t* asset_at,
                     uint32_t asset_count) {
  if (player.error().status != Status::ok) return player.error().status;
  if (player.info().snapshot_bytes > byte_count) return Status::truncated;
  WorldDef def;
  def.capacity = player.info().capacity;
  const Status made = open_session(session, def, asset_at, asset_count);
  return made == Status::ok ? player.start(session.world) : made;
}

Status record_session(Session& session, const RecordingDef& def) {
  if (session.recording.data != nullptr || session.rollback != nullptr) return Status::bad_argument;
  if (!make_recorder(session, {write_recording, &session.recording})) return Status::buffer_too_small;
  return session.recorder->begin(def);
}

/// Takes a WorldDef of `count` doubles from the desk, and gives the address of the new session. Errors: as
/// open_session().
DETENT_WEB(world_create) uint32_t world_create(uint32_t count, const uint32_t* asset_at, uint32_t asset_count) {
  WorldDef def;
  Taker in(count);
  visit(in, def);
  if (in.status != Status::ok) return static_cast<uint32_t>(in.status);
  void* memory = malloc(sizeof(Session));
  if (memory == nullptr) return static_cast<uint32_t>(Status::buffer_too_small);
  Session& session = *new (memory) Session;
  Status status = open_session(session, def, asset_at, asset_count);
  if (status == Status::ok && !make_recorder(session, {})) status = Status::buffer_too_small;
  if (status != Status::ok) {
    close_session(session);
    free(memory);
    return static_cast<uint32_t>(status);
  }
  Giver out;
  out.word(reinterpret_cast<uint32_t>(&session));
  return 0;
}

DETENT_WEB(world_destroy) void world_destroy(Session* session) {
  close_session(*session);
  free(session);
}

/// Begins a recording. Errors: as record_session().
DETENT_WEB(world_record) uint32_t world_record(Session* session, uint32_t digest_interval, uint32_t keyframe_interval) {
  return static_cast<uint32_t>(record_session(*session, {digest_interval, keyframe_interval}));
}

/// Ends the recording. Gives the address and the number of its bytes. The bytes are valid until the next call.
DETENT_WEB(world_end_recording) uint32_t world_end_recording(Session* session) {
  const Status status = session->recorder->end();
  Giver out;
  out.word(reinterpret_cast<uint32_t>(session->recording.data));
  out.word(session->recording.count);
  return static_cast<uint32_t>(status);
}
DETENT_WEB(world_drop_recording) void world_drop_recording(Session* session) {
  free(session->recording.data);
  session->recording = {};
  make_recorder(*session, {});
}

DETENT_WEB(world_step) void world_step(Session* session) {
  session->report = session->recorder->step();
  Giver out;
  give(out, session->report);
}
DETENT_WEB(world_digest) uint64_t world_digest(const Session* session) { return digest(session->world); }

DETENT_WEB(world_snapshot_bytes) uint32_t world_snapshot_bytes(const Session* session) {
  return snapshot_bytes(get_info(session->world).capacity);
}
DETENT_WEB(world_save) uint32_t world_save(const Session* session, uint8_t* bytes, uint32_t count) {
  return static_cast<uint32_t>(save(session->world, bytes, count));
}
/// Restores a snapshot of unknown origin: checks every byte.
DETENT_WEB(world_load) uint32_t world_load(Session* session, uint8_t* bytes, uint32_t count) {
  return static_cast<uint32_t>(load(session->world, bytes, count));
}

}  // namespace detent_web
