#pragma once
#include <detent/body_access.h>
#include <detent/forces.h>
#include <detent/query.h>
#include <detent/world_access.h>

/// @file
/// Recording and replay: a seed snapshot, every mutating call, and a digest per tick, as a stream of small checked
/// chunks. Format: docs/recording.md. Neither class allocates, or holds more than the caller's buffer; only
/// Player::go_to seeks.
///
/// Threads: a Recorder or Player is used like the world it is given to: by one thread at a time.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The layout of the bytes, apart from what a tick computes (`k_simulation_version`).
inline constexpr uint32_t k_recording_format_version = 5;
/// The working buffer of a Recorder or a Player: one chunk. No alignment is needed.
inline constexpr uint32_t k_recording_buffer_bytes = 544;

/// How much the recording says about each tick. Stored: a value is never reused.
enum class TraceLevel : uint32_t {
  digests = 0,  ///< one digest a tick
  stages = 1,   ///< in a window of ticks also digests of each body, contact and joint after each stage of the step
  full = 2,     ///< in a window of ticks also all that they hold after each stage
};

/// Ticks of which a recording tells more, by the number that is completed with them (StepReport::tick).
struct TraceDef {
  TraceLevel level = TraceLevel::full;  ///< of these ticks
  uint64_t from = 0;                    ///< the first
  uint64_t to = UINT64_MAX;             ///< the last
};

/// Where a recording goes. `write` takes all of `count` bytes, in order, or returns another status than ok.
/// A null `write` records nothing: the calls just apply.
struct Sink {
  /// Takes `count` bytes.
  Status (*write)(void* context, const uint8_t* bytes, uint32_t count) = nullptr;
  void* context = nullptr;  ///< handed to `write`
};

/// Where a recording comes from. `read` gives the next bytes in order: `got` <= count is how many, and fewer than
/// `count` only at the end. Anything but ok stops the replay as sink_failed.
struct Source {
  /// Gives up to `count` bytes.
  Status (*read)(void* context, uint8_t* bytes, uint32_t count, uint32_t& got) = nullptr;
  void* context = nullptr;  ///< handed to `read` and `seek`
  /// The next byte to give is the one `offset` bytes from the recording's start; at or beyond the end there is none.
  /// Null: the source goes forward only.
  Status (*seek)(void* context, uint64_t offset) = nullptr;
};

/// What a recording is to hold.
struct RecordingDef {
  uint32_t digest_interval = 1;    ///< a digest after every tick that is a multiple of it; 0: only at the end
  uint32_t keyframe_interval = 0;  ///< the whole state after every tick that is a multiple of it; 0: only the seed
};

/// The header of a recording.
struct RecordingInfo {
  uint32_t format_version = 0;                   ///< k_recording_format_version of the recorder
  uint32_t simulation_version = 0;               ///< k_simulation_version of the recorder
  Config config = k_config;                      ///< of the recorded world
  Capacity capacity = {};                        ///< of the recorded world, and of the one to replay in
  TraceLevel trace_level = TraceLevel::digests;  ///< how much it says about each tick
  uint32_t digest_interval = 0;                  ///< RecordingDef::digest_interval
  uint64_t tick = 0;               ///< of the seed: ticks that its world had completed when the recording began
  uint32_t snapshot_bytes = 0;     ///< of the seed, and of each keyframe
  uint32_t keyframe_interval = 0;  ///< RecordingDef::keyframe_interval
};

/// @cond
// The library's own: what goes for all calls, and for all queries.
struct CommandCode;
struct QueryCode;
// The way into the code that traces, and what looks on while a recording is read.
struct Tracer;
extern const Tracer k_tracer;
struct ReplayWatch;
/// @endcond

/// Applies calls to a world and logs those that succeeded. Its methods mirror world.h, body_access.h,
/// world_access.h and forces.h by name, arguments and statuses.
///
/// A call that fails changes nothing and is not logged. A failing sink doesn't disturb the world: the calls go on
/// applying, nothing more is written, and `status` and `end` report it. Between `begin` and `end` the world is changed
/// through the recorder alone; a change behind its back shows as digest_differs in the replay. In f32 and f64 a
/// negative zero is applied and logged as zero, and a NaN or infinity is refused (out_of_range) in any field, also in
/// one that the shape's type doesn't use: what is logged is what was applied.
class Recorder {
 public:
  /// `buffer` and the world must outlive the recorder. The buffer may be null with a null sink.
  Recorder(World& world, Sink sink, uint8_t* buffer, uint32_t buffer_bytes);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Traces these ticks: what a difference of two machines is found by (docs/first_difference.md). A trace goes to the
  /// sink from within `step`, in chunks, and takes some ten times the state in use a tick; World::observer is the
  /// recorder's while it steps, and the world's own is told first. A program that never calls this links none of its
  /// code. Errors: bad_argument (begun before, a level that there is not, or `from` after `to`).
  Status trace(const TraceDef& def) {
    if (state_ != State::idle || def.level > TraceLevel::full || def.from > def.to) return Status::bad_argument;
    trace_ = def;
    tracer_ = &k_tracer;
    return Status::ok;
  }
  /// Writes the header and the world's state as the seed; calls are logged from here on. With a null sink: ok, and
  /// nothing. Errors: bad_argument (begun before), buffer_too_small (k_recording_buffer_bytes), sink_failed.
  Status begin(const RecordingDef& def = {});
  /// Writes what is buffered as a chunk, so that a crash later loses nothing up to here. Errors: sink_failed.
  Status flush();
  /// Writes the rest and the end chunk; later calls apply and are not logged. Without `begin`: ok, and nothing.
  /// Errors: sink_failed, also for a failure since `begin`.
  Status end();
  /// ok, or the first failure of `begin` or the sink: from then on the recording is incomplete.
  Status status() const { return status_; }
  /// The world that the calls go to.
  const World& world() const { return world_; }

  /// As the function of this name in world.h, with its arguments and errors; logged if it succeeds.
  /// @{
  Status create_body(const BodyDef& def, BodyId& id);
  Status destroy_body(BodyId id);
  Status set_pose(BodyId id, const Position& position, const Quat& rotation);
  Status set_velocity(BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& spin);
  Status apply_force(BodyId id, const Vec3<Scaled>& force);
  Status apply_torque(BodyId id, const Vec3<Scaled>& torque);
  Status apply_impulse(BodyId id, const Vec3<Scaled>& impulse);
  Status apply_impulse_at(BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm);
  Status apply_angular_impulse(BodyId id, const Vec3<Scaled>& impulse);
  Status set_gravity(const Vec3<Real>& gravity);
  Status wake_body(BodyId id);
  Status put_to_sleep(BodyId id);
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
  Status set_turn_locks(BodyId id, uint32_t locks);
  Status set_sensor(BodyId id, bool sensor);
  Status set_settings(const WorldDef& def);
  Status apply_force_at(BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm);
  Status apply_force_at_point(BodyId id, const Vec3<Scaled>& force, const Position& point);
  Status apply_impulse_at_point(BodyId id, const Vec3<Scaled>& impulse, const Position& point);
  Status explode(const Explosion& explosion);
  Status move_kinematic(BodyId id, const Position& position, const Quat& rotation);
  /// @}
  /// The queries change nothing, and are logged with the digest of their answer.
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
  // The library's own: makes a call that a recording holds.
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
  uint32_t sequence_ = 0;       ///< of the next chunk
  uint32_t payload_count_ = 0;  ///< bytes of records that wait in the buffer
  uint64_t tick_ = 0;           ///< of the world, now
  uint64_t chunk_tick_ = 0;     ///< of the world, before the first waiting record
  uint64_t ticks_ = 0;          ///< logged since `begin`
};

/// What one tick of a replay showed.
struct TickResult {
  bool finished = false;   ///< the end of the recording: no tick was made; `digest` is that of the final state
  bool compared = false;   ///< the recording holds a digest of this tick (and it is equal, where there is a world)
  uint64_t tick = 0;       ///< ticks completed since the world was created
  uint64_t digest = 0;     ///< where `compared`
  uint32_t calls = 0;      ///< applied before the tick
  StepReport report = {};  ///< of the step; empty without a world
};

/// Where and why a replay stopped. `field` and `status_text(status)` make one line for a reader:
/// "corrupt at byte 1234, tick 17: chunk checksum".
struct ReplayError {
  Status status = Status::ok;  ///< what the failing call returned
  uint64_t tick = 0;           ///< ticks completed when it stopped
  uint64_t offset = 0;         ///< of the header field, chunk or record that is wrong, bytes from the recording's start
  const char* field = "";      ///< what is wrong there; never null
  uint64_t digest_recorded = 0;  ///< digest_differs at a digest: the recording's
  uint64_t digest_replayed = 0;  ///< and this machine's
};

/// @cond
class Reader;
// The library's own: the way into the code that asks recorded queries again.
struct QueryRepeater;
extern const QueryRepeater k_query_repeater;
/// @endcond

/// Replays a recording from a stream. Any bytes may come: every length and number is checked before it is used, each
/// chunk by its CRC-32 before anything in it is read. The first error stays: later calls return it again.
class Player {
 public:
  /// `buffer` must outlive the player.
  Player(Source source, uint8_t* buffer, uint32_t buffer_bytes);
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// From now on asks the recorded queries again as well: another answer than the recorded one is digest_differs. If it
  /// is never called they are passed over, and the program links none of their code.
  void repeat_queries() { repeater_ = &k_query_repeater; }
  /// @cond
  void watch(const ReplayWatch* watch) { watch_ = watch; }
  /// @endcond

  /// Reads the header. `info` is filled once its checksum is right, also if this build refuses it by a later check.
  /// Errors: buffer_too_small, bad_argument (opened before), sink_failed, truncated, not_detent, format_unknown,
  /// corrupt, simulation_differs, config_differs.
  Status open();
  /// The header, once `open` has read it.
  const RecordingInfo& info() const { return info_; }

  /// Loads the seed into a world that was created with `info().capacity`. On failure the world is left empty.
  /// Errors: bad_argument (not opened, or started before), capacity_differs, and those of `load`; truncated,
  /// sink_failed.
  Status start(World& world);
  /// Goes on from a state that was saved during this recording, on any machine: passes over all up to the world's tick.
  /// Errors: as start, and out_of_range (a tick before the seed or after the end).
  Status start_at(World& world);
  /// Makes the calls of one tick, steps, and compares the digest; at the end, makes the calls after the last tick and
  /// compares the final digest. A call that this world refuses, or that gives another id than recorded, is
  /// digest_differs: the bytes are sound, so the states differ. Errors: bad_argument (not started, or finished),
  /// truncated, corrupt, digest_differs, sink_failed. `result` is then untouched.
  Status next_tick(World& world, TickResult& result) { return advance(&world, result); }
  /// As next_tick, without a world: reads and checks the bytes, and makes no call. After `open`, from the seed on.
  Status skip_tick(TickResult& result) { return advance(nullptr, result); }
  /// Makes the world's state that after `tick` completed ticks and before the calls of the next, forwards or back;
  /// after `open`, `start` is not needed. From the last keyframe at or before the tick, or the seed, or the state of
  /// now if that is nearer; what lies between is played as by next_tick. With a `seek`, a cut recording can be gone
  /// through as far as it is whole. Errors: out_of_range (a tick outside the recording, or before now without a `seek`:
  /// nothing is changed, except that without one a replay beyond the end stands at it), and those of start and
  /// next_tick; then the world is left empty or where it stopped.
  Status go_to(World& world, uint64_t tick);
  /// After next_tick returned truncated, or corrupt for a chunk that is not sound: how much of the recording is whole,
  /// bytes from its start. These bytes and the end that write_end makes are a recording of `error().tick` ticks.
  uint64_t whole_bytes() const { return whole_bytes_; }
  /// Writes that end. `world`: the one of the replay. Errors: bad_argument (the recording is whole, or damaged within a
  /// chunk whose checksum is right; another world), sink_failed.
  Status write_end(const World& world, Sink sink);
  /// Where and why the replay stopped; `status` is ok as long as it has not.
  const ReplayError& error() const { return error_; }
  /// Bytes read so far, for a progress display.
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
  uint32_t payload_at_ = 0;  ///< bytes of it that are used
  uint32_t sequence_ = 0;    ///< of the next chunk
  uint32_t state_type_ = 0;  ///< the chunks of the state that is read: seed or keyframe
  uint32_t state_at_ = 0;    ///< bytes of it that are used
  uint32_t whole_sequence_ = 0;
  uint64_t whole_bytes_ = 0;
  uint64_t tick_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
