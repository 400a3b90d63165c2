#include <string.h>

#include "replay/game_state.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Calls the maker for one tick. `index`: the tick's place in SyncTestDef::inputs. Returns false if the maker did not
/// advance the world by exactly one tick.
bool make_tick(World& world, const SyncTestDef& def, TickMaker maker, uint32_t index, bool again) {
  const uint64_t tick = get_info(world).tick;
  const uint8_t* inputs = def.inputs == nullptr ? nullptr : def.inputs + index * def.players * def.input_bytes;
  maker.make(maker.context, world, {tick, inputs, def.players, def.input_bytes, 0, again});
  return get_info(world).tick == tick + 1;
}

}  // namespace

Status sync_test(World& world, const SyncTestDef& def, TickMaker maker, uint8_t* memory, uint32_t memory_bytes,
                 GameState game, SyncTestReport& report) {
  const WorldInfo info = get_info(world);
  const uint32_t needed = sync_test_bytes(info.capacity, def.ticks, game.count);
  const uint64_t input_bytes = uint64_t{def.ticks} * def.players * def.input_bytes;
  if (needed == 0 || input_bytes > UINT32_MAX) return Status::out_of_range;
  if (maker.make == nullptr || !is_game_state(game, game.count) || (def.inputs == nullptr) != (input_bytes == 0))
    return Status::bad_argument;
  if (memory_bytes < needed) return Status::buffer_too_small;
  SnapshotRing start;
  const uint32_t start_bytes = snapshot_ring_bytes(info.capacity, 1);
  if (const Status status = start.begin(memory, memory_bytes, info.capacity, 1); status != Status::ok) return status;
  if (const Status status = start.keep(world); status != Status::ok) return status;
  uint64_t* const digests = reinterpret_cast<uint64_t*>(memory + start_bytes);
  uint8_t* const game_start = memory + start_bytes + 8 * def.ticks;
  if (game.count != 0) memcpy(game_start, game.bytes, game.count);
  for (uint32_t i = 0; i < def.ticks; ++i) {
    if (!make_tick(world, def, maker, i, false)) return Status::bad_argument;
    digests[i] = digest_of(world, game);
  }
  if (const Status status = start.restore(world, info.tick); status != Status::ok) return status;
  if (game.count != 0) memcpy(game.bytes, game_start, game.count);
  for (uint32_t i = 0; i < def.ticks; ++i) {
    if (!make_tick(world, def, maker, i, true)) return Status::bad_argument;
    const uint64_t second = digest_of(world, game);
    if (second == digests[i]) continue;
    report = {get_info(world).tick, digests[i], second};
    return Status::digest_differs;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
