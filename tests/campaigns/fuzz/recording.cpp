#include "base/crc.h"
#include "replay/format.h"
#include "tests/campaigns/fuzz/targets.h"
#include "tests/campaigns/sequences/game.h"
#include "tests/common/support/usable.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

constexpr uint32_t k_ticks_max = 200, k_jumps = 4, k_jump_ticks = 24, k_world_bytes_max = 1u << 20;
constexpr uint8_t k_mend = 1, k_repeat_queries = 2, k_jump = 4, k_without_world = 8;  ///< of the first byte

/// Right checksums and numbers of chunks, as far as the lengths lead.
void mend(uint8_t* bytes, size_t count) {
  if (count < k_header_bytes) return;
  constexpr uint32_t k_fields = k_header_bytes - k_checksum_bytes;
  write_checksum(bytes + k_fields, crc32(bytes, k_fields));
  size_t at = k_header_bytes;
  for (uint32_t sequence = 0;; ++sequence) {
    if (count - at < k_chunk_header_bytes + k_checksum_bytes) return;
    uint8_t* chunk = bytes + at;
    const uint32_t checked = k_chunk_header_bytes + chunk[2] + 256u * chunk[3];
    if (count - at < checked + k_checksum_bytes) return;
    for (uint32_t k = 0; k < 4; ++k) chunk[4 + k] = static_cast<uint8_t>(sequence >> (8 * k));
    write_checksum(chunk + checked, crc32(chunk, checked));
    at += checked + k_checksum_bytes;
  }
}

/// A recording that is read as the first byte says.
class Reading {
 public:
  Reading(const Bytes& recording, uint8_t ways)
      : recording_(recording),
        ways_(ways),
        memory_{&recording_},
        player_(has(k_jump) ? memory_.seekable_source() : memory_.source(), buffer_, sizeof buffer_) {
    if (has(k_repeat_queries)) player_.repeat_queries();
  }

  /// True if nothing was wrong with it as far as it was read.
  bool read() {
    WorldDef def;
    def.capacity = {1, 1, 0};
    Status status = player_.open();
    const bool opened = status == Status::ok;
    if (opened) {
      const uint32_t size = world_bytes(player_.info().capacity);
      if (size == 0 || size > k_world_bytes_max) return false;
      def.capacity = player_.info().capacity;
    }
    OwnedWorld owned(def, Game::assets());
    owned.world.hooks.filter_rules = Game::rules();
    if (opened) status = has(k_without_world) ? pass() : has(k_jump) ? jump(owned.world) : play(owned.world);
    if (status == Status::ok) return true;
    expect_stopped(owned.world);
    if (!has(k_without_world) && !has(k_jump)) recover(owned.world);
    expect_usable(owned.world);
    return false;
  }

 private:
  bool has(uint8_t displacement) const { return (ways_ & displacement) != 0; }

  Status pass() {
    TickResult result;
    Status status = Status::ok;
    while (status == Status::ok && !result.finished) status = player_.skip_tick(result);
    return status;
  }

  Status play(World& world) {
    TickResult result;
    const uint64_t empty = digest(world);
    Status status = player_.start(world);
    if (status != Status::ok) {
      EXPECT_EQ(digest(world), empty);
    }
    for (uint32_t tick = 0; status == Status::ok && !result.finished && tick < k_ticks_max; ++tick) {
      status = player_.next_tick(world, result);
    }
    return status;
  }

  /// Hither and thither, as the recording's own bytes have it.
  Status jump(World& world) {
    detent_queries::Random random(crc32(recording_.data(), static_cast<uint32_t>(recording_.size())));
    for (uint32_t i = 0; i < k_jumps; ++i) {
      const uint64_t before = digest(world), tick = player_.info().tick + random.below(k_jump_ticks);
      Status status = player_.go_to(world, tick);
      if (status == Status::out_of_range && player_.error().status == Status::ok) {
        EXPECT_EQ(digest(world), before);
        continue;
      }
      if (status != Status::ok) return status;
      EXPECT_EQ(get_info(world).tick, tick);
      TickResult result;
      if (random.chance(0.5)) status = player_.next_tick(world, result);
      if (status != Status::ok) return status;
    }
    return Status::ok;
  }

  /// The player says where and why it stopped, and goes on saying it.
  void expect_stopped(World& world) {
    const ReplayError error = player_.error();
    EXPECT_NE(error.status, Status::ok);
    EXPECT_STRNE(error.field, "");
    EXPECT_LE(error.offset, recording_.size());
    TickResult result;
    EXPECT_NE(player_.next_tick(world, result), Status::ok);
    EXPECT_EQ(player_.error().status, error.status);
    EXPECT_NE(player_.go_to(world, player_.info().tick), Status::ok);
  }

  /// What was whole of it is a recording up to where the player stopped.
  void recover(World& world) {
    MemorySink whole;
    if (player_.write_end(world, whole.sink()) != Status::ok) return;
    ASSERT_LE(player_.whole_bytes(), recording_.size());
    const auto end = recording_.begin() + static_cast<std::ptrdiff_t>(player_.whole_bytes());
    whole.bytes.insert(whole.bytes.begin(), recording_.begin(), end);
    Reading again(whole.bytes, ways_);
    OwnedWorld owned(OwnedWorld::def_of(player_.info().capacity), Game::assets());
    owned.world.hooks.filter_rules = Game::rules();
    EXPECT_OK(again.player_.open());
    EXPECT_OK(again.play(owned.world));
    EXPECT_EQ(get_info(owned.world).tick, player_.error().tick);
    EXPECT_EQ(digest(owned.world), digest(world));
  }

  const Bytes recording_;
  const uint8_t ways_;
  MemorySource memory_;
  uint8_t buffer_[k_recording_buffer_bytes];
  Player player_;
};

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  Bytes recording(bytes.begin() + 1, bytes.end());
  if ((bytes[0] & k_mend) != 0) mend(recording.data(), recording.size());
  return Reading(recording, bytes[0]).read();
}

/// Of a small world, with all that a recording may hold.
Bytes record_keyframes() {
  Recording made(OwnedWorld::def_of({5, 10, 0, true, 1, 2}));
  Recorder& recorder = made.recorder;
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = half_space();
  BodyId ground, first, second, ball;
  EXPECT_OK(recorder.create_body(def, ground));
  def = {};
  def.shape = box(reals(0.5, 0.25, 0.5));
  def.position = position(0, 0.5, 0);
  EXPECT_OK(recorder.create_body(def, first));
  def.position = position(1.25, 0.5, 0);
  EXPECT_OK(recorder.create_body(def, second));
  JointDef joint;
  joint.a = first;
  joint.b = second;
  joint.anchor_a = reals(0.625, 0, 0);
  joint.anchor_b = reals(-0.625, 0, 0);
  JointId joint_id;
  EXPECT_OK(recorder.create_joint(joint, joint_id));
  EXPECT_OK(recorder.begin({0, 4}));
  for (uint32_t tick = 0; tick < 14; ++tick) {
    if (tick == 3) {
      def = {};
      def.position = position(0.25, 2, 0);
      def.linear_velocity = reals(0, -10, 0);
      EXPECT_OK(recorder.create_body(def, ball));
    }
    if (tick == 5) {
      EXPECT_OK(recorder.apply_impulse(second, scaleds(100, 200, 0)));
    }
    if (tick == 7) {
      EXPECT_OK(recorder.set_sensor(ball, true));
    }
    if (tick == 10) {
      EXPECT_OK(recorder.destroy_joint(joint_id));
    }
    if (tick == 11) {
      EXPECT_OK(recorder.destroy_body(first));
    }
    QueryHit hit;
    QueryReport report;
    EXPECT_OK(recorder.query_ray({position(0.125, 4, 0.25), reals(0.5, -8, 0.25), {}, false}, {&hit, 1}, report));
    recorder.step();
  }
  EXPECT_OK(recorder.end());
  return made.memory.bytes;
}

/// Of random calls, with a digest at the end alone: a changed call then leads on. And with keyframes.
std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  const auto add = [&made](const Bytes& recording, uint8_t ways) {
    made.push_back({ways});
    made.back().insert(made.back().end(), recording.begin(), recording.end());
  };
  for (uint64_t seed = 1; made.size() < 8; ++seed) {
    Game game(Draw(seed, false));
    game.play();
    MemorySource memory{&game.recording()};
    uint8_t buffer[k_recording_buffer_bytes];
    Player player(memory.source(), buffer, sizeof buffer);
    EXPECT_OK(player.open());
    if (player.info().digest_interval != 0) continue;
    add(game.recording(), made.size() % 2 == 0 ? k_mend : k_mend | k_repeat_queries);
  }
  const Bytes keyframes = record_keyframes();
  const uint8_t ways[] = {k_mend | k_repeat_queries, k_repeat_queries, k_mend | k_jump,
                          k_mend | k_jump | k_repeat_queries, k_mend | k_without_world};
  for (const uint8_t displacement : ways) add(keyframes, displacement);
  return made;
}

}  // namespace

const detent_fuzz::Target k_recording_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
