#pragma once
#include <detent/body.h>
#include <detent/query.h>
#include <detent/world.h>

/// @file
/// Recording and replay. A recording is a stream of small chunks, each with a checksum. The chunks hold a snapshot of
/// the initial state (the seed), every call that changes the world, and digests. Format: docs/recording.md. Recorder
/// and Player allocate nothing; each uses only the caller's buffer. Only Player::go_to calls Source::seek; all other
/// calls read and write in order.
///
/// Threads: only one thread at a time may use a Recorder or Player, or the world on which it works.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Version of the byte layout. The version of the computation is separate (`k_simulation_version`).
inline constexpr uint32_t k_recording_format_version = 6;
/// Size of the working buffer of a Recorder or Player, bytes: one chunk. No alignment is needed.
inline constexpr uint32_t k_recording_buffer_bytes = 544;

/// What a trace contains. Stored in recordings: a value is never reused.
enum class TraceLevel : uint32_t {
  digests = 0,  ///< no trace; the recording has only the digests of RecordingDef::digest_interval
  stages = 1,   ///< for each traced tick, after each stage of the step: a digest of each body, contact and joint
  full = 2,     ///< for each traced tick, after each stage of the step: the complete bodies, contacts and joints
};

/// The ticks that a recording traces. The number of a tick is its StepReport::tick.
struct TraceDef {
  TraceLevel level = TraceLevel::full;  ///< trace level of the traced ticks
  uint64_t from = 0;                    ///< the first traced tick
  uint64_t to = UINT64_MAX;             ///< the last traced tick
};

/// The output of a recording. `write` must take all `count` bytes, or return a status other than ok. If `write` is
/// null, the recorder only applies its calls to the world, and records nothing.
struct Sink {
  /// Takes the `count` bytes at `bytes`.
  Status (*write)(void* context, const uint8_t* bytes, uint32_t count) = nullptr;
  void* context = nullptr;  ///< passed to `write`
};

/// The input of a replay. `read` stores the next bytes in `bytes` and their number in `got`. The number is `count`;
/// only at the end of the recording may it be less. If `read` returns a status other than ok, the replay stops with
/// sink_failed.
struct Source {
  /// Reads up to `count` bytes.
  Status (*read)(void* context, uint8_t* bytes, uint32_t count, uint32_t& got) = nullptr;
  void* context = nullptr;  ///< passed to `read` and `seek`
  /// Sets the position of the next `read` to `offset` bytes from the recording's start. At or beyond the end, `read`
  /// then gets no bytes. Null: the source cannot seek.
  Status (*seek)(void* context, uint64_t offset) = nullptr;
};

/// What a recording contains.
struct RecordingDef {
  /// The recording gets a digest after every tick whose number is a multiple of this; 0: only at the end.
  uint32_t digest_interval = 1;
  /// The recording gets the whole state (a keyframe) after every tick whose number is a multiple of this; 0: never.
  uint32_t keyframe_interval = 0;
};

/// The header of a recording.
struct RecordingInfo {
  uint32_t format_version = 0;                   ///< k_recording_format_version of the recorder
  uint32_t simulation_version = 0;               ///< k_simulation_version of the recorder
  Config config = k_config;                      ///< math configuration of the recorded world
  Capacity capacity = {};                        ///< capacity of the recorded world, which a replay needs, too
  TraceLevel trace_level = TraceLevel::digests;  ///< TraceDef::level; `digests` without a trace
  uint32_t digest_interval = 0;                  ///< RecordingDef::digest_interval
  uint64_t tick = 0;                             ///< ticks that the world had completed when the recording began
  uint32_t snapshot_bytes = 0;                   ///< size of the seed snapshot, and of that of each keyframe, bytes
  uint32_t keyframe_interval = 0;                ///< RecordingDef::keyframe_interval
};

/// @cond
// Internal: descriptions of the recorded calls and queries.
struct CommandCode;
struct QueryCode;
// Internal: functions of the tracer, and an observer of a replay.
struct Tracer;
extern const Tracer k_tracer;
struct ReplayWatch;
/// @endcond

/// Applies calls to a world and logs the calls that succeed. Its methods have the names, arguments and statuses of the
/// functions of world.h, body.h and joint.h.
///
/// A call that fails changes nothing and is not logged. If the sink fails, calls are still applied, but nothing more is
/// written; `status` and `end` report the failure. Between `begin` and `end` only the recorder may change the world;
/// any other change appears as digest_differs in the replay. In f32 and f64 a negative zero is applied and logged as
/// zero. A NaN or infinity is refused (out_of_range) in every field, also in a field that the shape's type does not
/// use. Therefore the log has exactly the values that were applied.
class Recorder {
 public:
  /// `buffer` and the world must outlive the recorder. The buffer may be null with a null sink.
  Recorder(World& world, Sink sink, uint8_t* buffer, uint32_t buffer_bytes);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Selects the ticks to trace, to find the first difference of two machines (docs/first_difference.md). `step` writes
  /// the trace to the sink in chunks. The trace of a tick takes about ten times the bytes of the state in use. While
  /// the recorder steps, it replaces WorldHooks::observer by its own, which calls the world's observer first. A program
  /// that does not call this function does not link the code of the tracer. Errors: bad_argument (begun already, an
  /// unknown level, or `from` after `to`).
  Status trace(const TraceDef& def) {
    if (state_ != State::idle || def.level > TraceLevel::full || def.from > def.to) return Status::bad_argument;
    trace_ = def;
    tracer_ = &k_tracer;
    return Status::ok;
  }
  /// Writes the header and the world's state as the seed; calls are logged from here on. With a null sink it does
  /// nothing and returns ok. Errors: bad_argument (begun already), buffer_too_small (k_recording_buffer_bytes),
  /// sink_failed.
  Status begin(const RecordingDef& def = {});
  /// Writes the buffered records as a chunk, so that a later crash does not lose them. Errors: sink_failed.
  Status flush();
  /// Writes the buffered records and the end chunk; later calls are applied but not logged. Without `begin` it does
  /// nothing and returns ok. Errors: sink_failed, also for a failure since `begin`.
  Status end();
  /// ok, or the first failure of `begin` or the sink, after which the recording is incomplete.
  Status status() const { return status_; }
  /// The world to which the calls are applied.
  const World& world() const { return world_; }

  /// Calls the function of this name in world.h, body.h or joint.h, with the same arguments and errors. A call that
  /// succeeds is logged.
  /// @{
  Status create_body(const BodyDef& def, BodyId& id);
  Status destroy_body(BodyId id);
  Status set_pose(BodyId id, const Position& position, const Quat& rotation);
  Status set_velocity(BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& angular_velocity);
  Status apply_force(BodyId id, const Vec3<Scaled>& force);
  Status apply_torque(BodyId id, const Vec3<Scaled>& torque);
  Status apply_impulse(BodyId id, const Vec3<Scaled>& impulse);
  Status apply_impulse_at(BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm);
  Status apply_angular_impulse(BodyId id, const Vec3<Scaled>& impulse);
  Status set_gravity(const Vec3<Real>& gravity);
  Status wake_body(BodyId id);
  Status sleep_body(BodyId id);
  Status set_user_data(BodyId id, uint32_t user_data);
  Status set_filter(BodyId id, const Filter& filter);
  Status bind_asset(uint32_t index);
  Status create_joint(const JointDef& def, JointId& id);
  Status destroy_joint(JointId id);
  Status set_joint(JointId id, const JointDef& def);
  Status set_type(BodyId id, BodyType type);
  Status set_shape(BodyId id, const Shape& shape);
  Status set_mass(BodyId id, Scaled mass);
  Status set_inertia(BodyId id, const Vec3<Scaled>& inertia);
  Status set_density(BodyId id, Scaled density);
  Status set_material(BodyId id, const Material& material);
  Status set_damping(BodyId id, Real linear, Real angular);
  Status set_gravity_scale(BodyId id, Real scale);
  Status set_rotation_locks(BodyId id, uint32_t locks);
  Status set_sensor(BodyId id, bool sensor);
  Status set_settings(const WorldDef& def);
  Status apply_force_at(BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm);
  Status apply_force_at_point(BodyId id, const Vec3<Scaled>& force, const Position& point);
  Status apply_impulse_at_point(BodyId id, const Vec3<Scaled>& impulse, const Position& point);
  Status explode(const Explosion& explosion);
  Status move_kinematic(BodyId id, const Position& position, const Quat& rotation);
  /// @}
  /// Runs the query of this name in query.h. A query does not change the world. It is logged with the digest of its
  /// hits.
  /// @{
  Status query_ray(const RayQuery& query, QueryHits hits, QueryReport& report);
  Status query_cast(const CastQuery& query, QueryHits hits, QueryReport& report);
  Status query_overlap(const OverlapQuery& query, QueryHits hits, QueryReport& report);
  Status query_bounds(const BoundsQuery& query, QueryHits hits, QueryReport& report);
  Status query_closest(const ClosestQuery& query, QueryHits hits, QueryReport& report);
  /// @}

  /// Steps the world, and logs the tick and, every `digest_interval` ticks, the digest.
  StepReport step();

  /// @cond
  // Internal: makes a recorded call.
  Status make(const CommandCode& code, void* command) { return apply_and_log(code, command); }
  Status make(const QueryCode& code, void* command);
  /// @endcond

 private:
  friend struct TraceWriter;
  enum class State : uint32_t { idle, recording, ended };

  template <class Command>
  Status apply_and_log(Command& command);
  Status apply_and_log(const CommandCode& code, void* command);
  template <class Command>
  Status ask_and_log(Command& command, QueryHits hits, QueryReport& report);
  Status ask_and_log(const QueryCode& code, void* command, QueryHits hits, QueryReport& report);
  void log(const CommandCode& code, void* command);
  bool recording() const { return state_ == State::recording && status_ == Status::ok; }
  void write(const uint8_t* bytes, uint32_t count);
  void write_header();
  void write_state(uint32_t type, uint32_t payload_count);
  void write_keyframe(uint64_t digest);
  void write_chunk(uint32_t type, uint32_t payload_count);
  void flush_records();

  World& world_;
  Sink sink_;
  uint8_t* buffer_;
  uint32_t buffer_bytes_;
  State state_ = State::idle;
  Status status_ = Status::ok;
  RecordingDef def_ = {};
  TraceDef trace_ = {TraceLevel::digests, 0, 0};
  const Tracer* tracer_ = nullptr;
  uint32_t sequence_ = 0;       ///< number of the next chunk
  uint32_t payload_count_ = 0;  ///< bytes of buffered records
  uint64_t tick_ = 0;           ///< current tick of the world
  uint64_t chunk_tick_ = 0;     ///< tick of the world before the first buffered record
  uint64_t ticks_ = 0;          ///< ticks logged since `begin`
};

/// The result of one tick of a replay.
struct TickResult {
  bool finished = false;   ///< the recording has ended: no tick was simulated; `digest` is that of the final state
  bool compared = false;   ///< the recording has a digest of this tick; a replayed world has the same digest
  uint64_t tick = 0;       ///< ticks completed since the world was created
  uint64_t digest = 0;     ///< the recorded digest, if `compared`
  uint32_t calls = 0;      ///< number of recorded calls and queries before the tick
  StepReport report = {};  ///< the report of the step; empty without a world
};

/// Where and why a replay stopped. A program can print it in one line: "corrupt at byte 1234, tick 17: chunk checksum",
/// with status_text(status), `offset`, `tick` and `field`.
struct ReplayError {
  Status status = Status::ok;    ///< the status of the failed call
  uint64_t tick = 0;             ///< ticks completed when the replay stopped
  uint64_t offset = 0;           ///< bytes from the recording's start to the wrong header field, chunk or record
  const char* field = "";        ///< name of the wrong item; never null
  uint64_t digest_recorded = 0;  ///< if a digest (of a state or of hits) differs: the digest in the recording
  uint64_t digest_replayed = 0;  ///< if a digest differs: the digest that this machine computed
};

/// @cond
class Reader;
// Internal: functions that repeat recorded queries.
struct QueryRepeater;
extern const QueryRepeater k_query_repeater;
/// @endcond

/// Replays a recording from a stream. The stream may be untrusted: the player checks the CRC-32 of each chunk before it
/// reads the chunk, and every length and number before it uses them. After an error, all later calls return the same
/// error.
class Player {
 public:
  /// `buffer` must outlive the player.
  Player(Source source, uint8_t* buffer, uint32_t buffer_bytes);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Repeats the recorded queries from now on. If a result differs from the recorded one, the replay stops with
  /// digest_differs. Without this call, the player skips queries, and the program does not link their code.
  void repeat_queries() { repeater_ = &k_query_repeater; }
  /// @cond
  void watch(const ReplayWatch* watch) { watch_ = watch; }
  /// @endcond

  /// Reads the header. `info` is filled if the header's checksum is right, even if a later check fails.
  /// Errors: buffer_too_small, bad_argument (opened before), sink_failed, truncated, not_detent, format_unknown,
  /// corrupt, simulation_differs, config_differs.
  Status open();
  /// The header, after `open` has read it.
  const RecordingInfo& info() const { return info_; }

  /// Loads the seed, the recorded initial state, into a world that was created with `info().capacity`.
  /// Errors: bad_argument (not opened, or started already) and capacity_differs, which leave the world unchanged; those
  /// of `load`, truncated and sink_failed, which leave the world empty.
  Status start(World& world);
  /// Starts at the current state of the world, which may be a snapshot that any machine saved during this recording.
  /// Skips the recording up to the world's tick. Errors: as start, and out_of_range (a tick before the seed or after
  /// the end).
  Status start_at(World& world);
  /// Makes the calls of one tick, steps, and compares the digest. One more call after the last tick does not step: it
  /// makes the calls that were recorded after that tick, compares the final digest, and sets `result.finished`. If a
  /// call fails in this world, or returns an id other than the recorded one, the status is digest_differs: the
  /// checksums are right, so the states must differ. Errors: bad_argument (not started, or finished), truncated,
  /// corrupt, digest_differs, sink_failed; `result` is then untouched.
  Status next_tick(World& world, TickResult& result) { return advance(&world, result); }
  /// As next_tick, but without a world: reads and checks the bytes of one tick, and makes no calls. If called directly
  /// after `open`, it first skips the seed.
  Status skip_tick(TickResult& result) { return advance(nullptr, result); }
  /// Sets the world to its state after `tick` completed ticks, before the calls of the next tick. The tick may be after
  /// or before the current one. `open` must have been called; `start` is not necessary. The player begins at the seed,
  /// at a keyframe or at the current state, whichever is the latest that is not after `tick`; it uses keyframes only if
  /// the source can seek. From there it plays as next_tick does. If the source can seek, a truncated recording can be
  /// played up to its last intact chunk. Errors: out_of_range (a tick outside the recording, or an earlier tick if the
  /// source cannot seek), and those of start and next_tick. After out_of_range nothing has changed, with one exception:
  /// if the source cannot seek and the tick is beyond the end, the replay is at the end. After bad_argument or
  /// capacity_differs the world is unchanged. After other errors it is empty, or at the tick where the replay stopped.
  Status go_to(World& world, uint64_t tick);
  /// The size of the intact part of the recording, bytes from its start. Valid after next_tick returned truncated, or
  /// corrupt because of a damaged chunk. The intact part, followed by the end that write_end() writes, is a recording
  /// of `error().tick` ticks.
  uint64_t whole_bytes() const { return whole_bytes_; }
  /// Writes the chunk that ends a recording, to be appended to the intact part (whole_bytes()). `world`: the world of
  /// the replay. Errors: bad_argument (the recording is complete, or the damage is in a chunk whose checksum is right;
  /// another world), sink_failed.
  Status write_end(const World& world, Sink sink);
  /// Where and why the replay stopped; `status` is ok until it stops.
  const ReplayError& error() const { return error_; }
  /// The number of bytes read so far, for a progress display.
  uint64_t bytes_read() const { return offset_; }

 private:
  enum class State : uint32_t { closed, opened, playing, finished, cut };
  /// Where a chunk starts.
  struct Place {
    uint64_t offset;
    uint64_t tick;
    uint32_t sequence;
  };

  Status fail(Status status, uint64_t offset, const char* field);
  Status read(uint8_t* bytes, uint32_t count, const char* field);
  Status read_chunk();
  void begin_state(uint32_t type);
  Status read_state(uint32_t offset, uint8_t* bytes, uint32_t count);
  static Status read_state_from(void* player, uint32_t offset, uint8_t* bytes, uint32_t count);
  Status load_state(World& world);
  Status pass_state();
  Status end_state();
  Status prepare(const World& world);
  Status pass_seed();
  Status begin_keyframe(uint64_t& digest);
  Status pass_keyframe(const World* world);
  Status seek(const Place& place);
  Status find_keyframe(Place& place, uint64_t tick, bool& found, bool& beyond);
  Status load_keyframe(World& world, const Place& place);
  Status approach(World& world, uint64_t tick);
  Status cut();
  Status advance(World* world, TickResult& result);
  Status call(World* world, uint32_t tag, Reader& reader, uint64_t offset);
  Status query(const World* world, Reader& reader, uint64_t offset);
  Status finish(const World* world, TickResult& made);
  Status compare(const World& world, uint64_t recorded, uint64_t offset, const char* field);

  Source source_;
  uint8_t* buffer_;
  uint32_t buffer_bytes_;
  const QueryRepeater* repeater_ = nullptr;
  const ReplayWatch* watch_ = nullptr;
  State state_ = State::closed;
  RecordingInfo info_ = {};
  ReplayError error_ = {};
  uint64_t offset_ = 0;        ///< bytes read
  uint64_t chunk_offset_ = 0;  ///< where the current chunk starts
  uint32_t chunk_type_ = 0;
  uint32_t payload_count_ = 0;
  uint32_t payload_at_ = 0;  ///< bytes of the payload that have been read
  uint32_t sequence_ = 0;    ///< number of the next chunk
  uint32_t state_type_ = 0;  ///< chunk type of the state that is being read: seed or keyframe
  uint32_t state_at_ = 0;    ///< bytes of that state that have been read
  uint32_t whole_sequence_ = 0;
  uint64_t whole_bytes_ = 0;
  uint64_t tick_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
