#include <detent/recording.h>
#include <string.h>

#include "base/crc.h"
#include "replay/command.h"
#include "replay/format.h"
#include "replay/query_command.h"
#include "replay/tracer.h"
#include "state/snapshot.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The functions for a record of a tick or a query. `apply` is null: the recorder makes the step or the query itself.
template <class Record>
constexpr CommandCode k_record_code = {
    Record::k_tag, [](Archive& archive, void* record) { visit(archive, *static_cast<Record*>(record)); }, nullptr};

/// A query as a record.
struct LoggedQuery {
  static constexpr RecordTag k_tag = RecordTag::query;
  const QueryCode& code;
  void* command;
};
void visit(Archive& archive, LoggedQuery& query) { visit_query(archive, query.code, query.command); }

}  // namespace

// A record consists of a tag and at most as many further bytes as its command has in memory. The record of a query also
// has a length and a kind. Therefore every record fits the payload of one chunk.
static_assert(sizeof(CreateBody) + 1 <= k_chunk_payload_bytes_max);
static_assert(sizeof(SetJoint) + 1 <= k_chunk_payload_bytes_max);
static_assert(sizeof(CastCommand) + 4 <= k_chunk_payload_bytes_max);

Recorder::Recorder(World& world, Sink sink, uint8_t* buffer, uint32_t buffer_bytes)
    : world_(world), sink_(sink), buffer_(buffer), buffer_bytes_(buffer_bytes) {}

Status Recorder::begin(const RecordingDef& def) {
  if (state_ != State::idle) return Status::bad_argument;
  if (sink_.write == nullptr) return Status::ok;
  if (buffer_ == nullptr || buffer_bytes_ < k_recording_buffer_bytes) return status_ = Status::buffer_too_small;
  state_ = State::recording;
  status_ = Status::ok;
  def_ = def;
  tick_ = get_info(world_).tick;
  write_header();
  chunk_tick_ = tick_;
  write_state(static_cast<uint32_t>(ChunkType::seed), 0);
  return status_;
}

Status Recorder::flush() {
  if (recording()) flush_records();
  return status_;
}

Status Recorder::end() {
  if (recording()) {
    flush_records();
    write(buffer_, make_end(buffer_, {ticks_, digest(world_)}, sequence_, tick_));
  }
  if (state_ == State::recording) state_ = State::ended;
  return status_;
}

void Recorder::write(const uint8_t* bytes, uint32_t count) {
  if (status_ != Status::ok) return;
  if (sink_.write(sink_.context, bytes, count) != Status::ok) status_ = Status::sink_failed;
}

void Recorder::write_header() {
  const WorldInfo world_info = get_info(world_);
  RecordingInfo info;
  info.format_version = k_recording_format_version;
  info.simulation_version = k_simulation_version;
  info.capacity = world_info.capacity;
  info.trace_level = trace_.level;
  info.digest_interval = def_.digest_interval;
  info.keyframe_interval = def_.keyframe_interval;
  info.tick = tick_;
  info.snapshot_bytes = snapshot_bytes(world_info.capacity);
  memcpy(buffer_, k_recording_magic, k_magic_bytes);
  Writer writer{buffer_ + k_magic_bytes, k_info_bytes};
  visit(writer, info);
  const uint32_t count = k_magic_bytes + k_info_bytes;
  write_checksum(buffer_ + count, crc32(buffer_, count));
  write(buffer_, k_header_bytes);
}

/// Writes the world's snapshot in chunks of this type. `payload_count`: number of bytes that are already in the payload
/// of the first chunk.
void Recorder::write_state(uint32_t type, uint32_t payload_count) {
  const uint32_t state_bytes = snapshot_bytes(get_info(world_).capacity);
  for (uint32_t offset = 0; offset < state_bytes && status_ == Status::ok; payload_count = 0) {
    const uint32_t left = state_bytes - offset;
    const uint32_t room = k_chunk_payload_bytes_max - payload_count;
    const uint32_t count = left < room ? left : room;
    if (!snapshot_read(world_, offset, buffer_ + k_chunk_header_bytes + payload_count, count))
      status_ = Status::corrupt;
    write_chunk(type, payload_count + count);
    offset += count;
  }
}

void Recorder::write_keyframe(uint64_t digest) {
  flush_records();
  chunk_tick_ = tick_;
  Writer writer{buffer_ + k_chunk_header_bytes, k_keyframe_digest_bytes};
  writer.bits("keyframe digest", digest, k_keyframe_digest_bytes);
  write_state(static_cast<uint32_t>(ChunkType::keyframe), writer.count);
}

void Recorder::write_chunk(uint32_t type, uint32_t payload_count) {
  write(buffer_, make_chunk(buffer_, {type, payload_count, sequence_++, chunk_tick_}));
}

void Recorder::flush_records() {
  if (payload_count_ == 0) return;
  write_chunk(static_cast<uint32_t>(ChunkType::calls), payload_count_);
  payload_count_ = 0;
}

void Recorder::log(const CommandCode& code, void* command) {
  for (;;) {
    if (payload_count_ == 0) chunk_tick_ = tick_;
    Writer writer{buffer_ + k_chunk_header_bytes + payload_count_, k_chunk_payload_bytes_max - payload_count_};
    uint64_t tag = static_cast<uint64_t>(code.tag);
    writer.bits("record tag", tag, 1);
    code.visit(writer, command);
    if (!writer.full) {
      payload_count_ += writer.count;
      return;
    }
    flush_records();
  }
}

Status Recorder::apply_and_log(const CommandCode& code, void* command) {
  Normaliser normaliser;
  code.visit(normaliser, command);
  if (normaliser.status != Status::ok) return normaliser.status;
  const Status status = code.apply(world_, command);
  if (status == Status::ok && recording()) log(code, command);
  return status;
}
template <class Command>
Status Recorder::apply_and_log(Command& command) {
  return apply_and_log(k_command_code<Command>, &command);
}

Status Recorder::ask_and_log(const QueryCode& code, void* command, QueryHits hits, QueryReport& report) {
  Normaliser normaliser;
  code.visit(normaliser, command);
  if (normaliser.status != Status::ok) return normaliser.status;
  const Status status = code.ask(world_, command, hits, report);
  if (status == Status::ok && recording()) {
    LoggedQuery logged = {code, command};
    log(k_record_code<LoggedQuery>, &logged);
  }
  return status;
}
template <class Command>
Status Recorder::ask_and_log(Command& command, QueryHits hits, QueryReport& report) {
  return ask_and_log(k_query_code<Command>, &command, hits, report);
}

Status Recorder::create_body(const BodyDef& def, BodyId& id) {
  CreateBody command{{}, def};
  const Status status = apply_and_log(command);
  if (status == Status::ok) id = command.id;
  return status;
}

Status Recorder::destroy_body(BodyId id) {
  DestroyBody command{id};
  return apply_and_log(command);
}

Status Recorder::set_pose(BodyId id, const Position& position, const Quat& rotation) {
  SetPose command{id, position, rotation};
  return apply_and_log(command);
}

Status Recorder::set_velocity(BodyId id, const Vec3<Real>& linear_velocity, const Vec3<Real>& angular_velocity) {
  SetVelocity command{id, linear_velocity, angular_velocity};
  return apply_and_log(command);
}

Status Recorder::apply_force(BodyId id, const Vec3<Scaled>& force) {
  ApplyForce command{id, force};
  return apply_and_log(command);
}

Status Recorder::apply_torque(BodyId id, const Vec3<Scaled>& torque) {
  ApplyTorque command{id, torque};
  return apply_and_log(command);
}

Status Recorder::apply_impulse(BodyId id, const Vec3<Scaled>& impulse) {
  ApplyImpulse command{id, impulse};
  return apply_and_log(command);
}

Status Recorder::apply_impulse_at(BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm) {
  ApplyImpulseAt command{id, impulse, arm};
  return apply_and_log(command);
}

Status Recorder::apply_angular_impulse(BodyId id, const Vec3<Scaled>& impulse) {
  ApplyAngularImpulse command{id, impulse};
  return apply_and_log(command);
}

Status Recorder::set_gravity(const Vec3<Real>& gravity) {
  SetGravity command{gravity};
  return apply_and_log(command);
}

Status Recorder::wake_body(BodyId id) {
  WakeBody command{id};
  return apply_and_log(command);
}

Status Recorder::sleep_body(BodyId id) {
  SleepBody command{id};
  return apply_and_log(command);
}

Status Recorder::set_user_data(BodyId id, uint32_t user_data) {
  SetUserData command{id, user_data};
  return apply_and_log(command);
}

Status Recorder::set_filter(BodyId id, const Filter& filter) {
  SetFilter command{id, filter};
  return apply_and_log(command);
}

Status Recorder::bind_asset(uint32_t index) {
  BindAsset command{index};
  return apply_and_log(command);
}

Status Recorder::set_type(BodyId id, BodyType type) {
  SetType command{id, type};
  return apply_and_log(command);
}

Status Recorder::set_shape(BodyId id, const Shape& shape) {
  SetShape command{id, shape};
  return apply_and_log(command);
}

Status Recorder::set_mass(BodyId id, Scaled mass) {
  SetMass command{id, mass};
  return apply_and_log(command);
}

Status Recorder::set_inertia(BodyId id, const Vec3<Scaled>& inertia) {
  SetInertia command{id, inertia};
  return apply_and_log(command);
}

Status Recorder::set_density(BodyId id, Scaled density) {
  SetDensity command{id, density};
  return apply_and_log(command);
}

Status Recorder::set_material(BodyId id, const Material& material) {
  SetMaterial command{id, material};
  return apply_and_log(command);
}

Status Recorder::set_damping(BodyId id, Real linear, Real angular) {
  SetDamping command{id, linear, angular};
  return apply_and_log(command);
}

Status Recorder::set_gravity_scale(BodyId id, Real scale) {
  SetGravityScale command{id, scale};
  return apply_and_log(command);
}

Status Recorder::set_rotation_locks(BodyId id, uint32_t locks) {
  SetRotationLocks command{id, locks};
  return apply_and_log(command);
}

Status Recorder::set_sensor(BodyId id, bool sensor) {
  SetSensor command{id, sensor};
  return apply_and_log(command);
}

Status Recorder::set_settings(const WorldDef& def) {
  SetSettings command{def};
  return apply_and_log(command);
}

Status Recorder::apply_force_at(BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm) {
  ApplyForceAt command{id, force, arm};
  return apply_and_log(command);
}

Status Recorder::apply_force_at_point(BodyId id, const Vec3<Scaled>& force, const Position& point) {
  ApplyForceAtPoint command{id, force, point};
  return apply_and_log(command);
}

Status Recorder::apply_impulse_at_point(BodyId id, const Vec3<Scaled>& impulse, const Position& point) {
  ApplyImpulseAtPoint command{id, impulse, point};
  return apply_and_log(command);
}

Status Recorder::explode(const Explosion& explosion) {
  Explode command{explosion};
  return apply_and_log(command);
}

Status Recorder::move_kinematic(BodyId id, const Position& position, const Quat& rotation) {
  MoveKinematic command{id, position, rotation};
  return apply_and_log(command);
}

Status Recorder::query_ray(const RayQuery& query, QueryHits hits, QueryReport& report) {
  RayCommand command{query};
  return ask_and_log(command, hits, report);
}

Status Recorder::query_cast(const CastQuery& query, QueryHits hits, QueryReport& report) {
  CastCommand command{query};
  return ask_and_log(command, hits, report);
}

Status Recorder::query_overlap(const OverlapQuery& query, QueryHits hits, QueryReport& report) {
  OverlapCommand command{query};
  return ask_and_log(command, hits, report);
}

Status Recorder::query_bounds(const BoundsQuery& query, QueryHits hits, QueryReport& report) {
  BoundsCommand command{query};
  return ask_and_log(command, hits, report);
}

Status Recorder::query_closest(const ClosestQuery& query, QueryHits hits, QueryReport& report) {
  ClosestCommand command{query};
  return ask_and_log(command, hits, report);
}

Status Recorder::create_joint(const JointDef& def, JointId& id) {
  CreateJoint command{{}, def};
  const Status status = apply_and_log(command);
  if (status == Status::ok) id = command.id;
  return status;
}

Status Recorder::destroy_joint(JointId id) {
  DestroyJoint command{id};
  return apply_and_log(command);
}

Status Recorder::set_joint(JointId id, const JointDef& def) {
  SetJoint command{id, def};
  return apply_and_log(command);
}

Status Recorder::make(const QueryCode& code, void* command) {
  QueryReport report;
  return ask_and_log(code, command, {}, report);
}

StepReport Recorder::step() {
  const bool traced = tracer_ != nullptr && recording() && trace_.level != TraceLevel::digests &&
                      tick_ + 1 >= trace_.from && tick_ + 1 <= trace_.to;
  const StepReport report = traced ? tracer_->step(*this) : detent::step(world_);
  if (!recording()) return report;
  const bool digested = is_due(def_.digest_interval, report.tick);
  const bool keyframe = is_due(def_.keyframe_interval, report.tick);
  TickDigested command{digested || keyframe ? digest(world_) : 0};
  // The record is logged before tick_ increases. So the header of a chunk that starts with this record has the number
  // of ticks that were completed before this tick.
  if (digested) {
    log(k_record_code<TickDigested>, &command);
  } else {
    Tick plain;
    log(k_record_code<Tick>, &plain);
  }
  tick_ = report.tick;
  ++ticks_;
  if (keyframe) write_keyframe(command.digest);
  return report;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
