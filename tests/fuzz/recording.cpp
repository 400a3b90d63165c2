#include "base/crc.h"
#include "replay/format.h"
#include "tests/fuzz/targets.h"
#include "tests/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

constexpr uint32_t k_ticks_max = 200, k_world_bytes_max = 1u << 20;
constexpr uint8_t k_mend = 1, k_repeat_queries = 2;  ///< of the first byte

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

/// The player says where and why it stopped, and goes on saying it.
void expect_stopped(Player& player, World& world, const Bytes& recording) {
  const ReplayError error = player.error();
  EXPECT_NE(error.status, Status::ok);
  EXPECT_STRNE(error.field, "");
  EXPECT_LE(error.offset, recording.size());
  TickResult result;
  EXPECT_NE(player.next_tick(world, result), Status::ok);
  EXPECT_EQ(player.error().status, error.status);
}

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  Bytes recording(bytes.begin() + 1, bytes.end());
  if ((bytes[0] & k_mend) != 0) mend(recording.data(), recording.size());
  MemorySource memory{&recording};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  if ((bytes[0] & k_repeat_queries) != 0) player.repeat_queries();
  const bool opened = player.open() == Status::ok;
  WorldDef def;
  def.capacity = {1, 1, 0};
  if (opened) {
    const uint32_t size = world_bytes(player.info().capacity);
    if (size == 0 || size > k_world_bytes_max) return false;
    def.capacity = player.info().capacity;
  }
  OwnedWorld owned(def, Game::assets());
  owned.world.filter_rules = Game::rules();
  Status status = opened ? player.start(owned.world) : player.error().status;
  TickResult result;
  for (uint32_t tick = 0; status == Status::ok && !result.finished && tick < k_ticks_max; ++tick) {
    status = player.next_tick(owned.world, result);
  }
  if (status != Status::ok) expect_stopped(player, owned.world, recording);
  return status == Status::ok;
}

/// Of random calls, with a digest at the end alone: a changed call then leads on.
std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  for (uint64_t seed = 1; made.size() < 8; ++seed) {
    Game game(Draw(seed, false));
    game.play();
    MemorySource memory{&game.recording()};
    uint8_t buffer[k_recording_buffer_bytes];
    Player player(memory.source(), buffer, sizeof buffer);
    EXPECT_OK(player.open());
    if (player.info().digest_interval != 0) continue;
    made.push_back({static_cast<uint8_t>(made.size() % 2 == 0 ? k_mend : k_mend | k_repeat_queries)});
    made.back().insert(made.back().end(), game.recording().begin(), game.recording().end());
  }
  return made;
}

}  // namespace

const detent_fuzz::Target k_recording_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
