#include <detent/rollback.h>
#include <string.h>

#include "replay/game_state.h"
#include "replay/sparse_rollback.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Status RollbackSession::begin(const World& world, const RollbackDef& def, TickMaker maker, uint8_t* memory,
                              uint32_t memory_bytes, GameState game) {
  const WorldInfo info = get_info(world);
  const RollbackLayout layout = rollback_layout(info.capacity, def);
  if (layout.bytes == 0) return Status::out_of_range;
  if (maker.make == nullptr || (def.local >> def.players) != 0 || !is_game_state(game, def.game_bytes))
    return Status::bad_argument;
  if (memory == nullptr || memory_bytes < layout.bytes) return Status::buffer_too_small;
  // SnapshotRing::begin() also checks the alignment of `memory`, for sparse sessions too.
  if (const Status status = states_.begin(memory, memory_bytes, info.capacity, def.window); status != Status::ok)
    return status;
#if DETENT_SPARSE
  sparse_ = def.sparse ? SparseRollback::begin(memory, world, def.window) : nullptr;
#endif
  memset(memory + layout.games, 0, static_cast<uint32_t>(layout.bytes) - layout.games);
  def_ = def;
  maker_ = maker;
  game_ = game;
  games_ = memory + layout.games;
  inputs_ = memory + layout.inputs;
  stamps_ = reinterpret_cast<uint64_t*>(memory + layout.stamps);
  sums_ = reinterpret_cast<Checksum*>(memory + layout.sums);
  kept_ = layout.kept;
  begun_ = true;
  start_ = tick_ = info.tick;
  wrong_ = UINT64_MAX;
  desync_ = {};
  // With a delay, a local player's inputs are zero in the first ticks, until its first input takes effect. The other
  // machines receive these zero inputs like all other inputs.
  for (uint32_t player = 0; player < def.players; ++player) {
    next_[player] = start_;
    if (is_remote(player)) continue;
    for (uint32_t i = 0; i < def.delay; ++i) stamp_of(player, start_ + i) = start_ + i + 1;
    next_[player] += def.delay;
  }
  return Status::ok;
}

uint8_t* RollbackSession::input_of(uint32_t player, uint64_t tick) const {
  return inputs_ + (place(tick) * def_.players + player) * def_.input_bytes;
}

uint64_t& RollbackSession::stamp_of(uint32_t player, uint64_t tick) const {
  return stamps_[place(tick) * def_.players + player];
}

/// Returns the first tick whose inputs another machine may still need: two rollback windows (RollbackDef::window)
/// before the present tick or before known_tick(), whichever is earlier, but not before the session's start.
/// known_tick() can be after the present tick: with a delay, or without local players, inputs may be known for ticks
/// that are not simulated yet.
uint64_t RollbackSession::oldest() const {
  const uint64_t known = known_tick(), back = 2 * uint64_t{def_.window};
  const uint64_t now = known < tick_ ? known : tick_;
  return now - start_ > back ? now - back : start_;
}

/// Returns the first tick for which the input of any player is unknown.
uint64_t RollbackSession::known_tick() const {
  uint64_t first = next_[0];
  for (uint32_t player = 1; player < def_.players; ++player) {
    if (next_[player] < first) first = next_[player];
  }
  return first;
}

void RollbackSession::set_input(uint32_t player, uint64_t tick, const uint8_t* input) {
  uint8_t* const known = input_of(player, tick);
  if (tick < tick_ && tick < wrong_ && !same_bytes(known, input, def_.input_bytes)) wrong_ = tick;
  memcpy(known, input, def_.input_bytes);
  stamp_of(player, tick) = tick + 1;
  while (is_known(player, next_[player])) ++next_[player];
  take_confirmed_checksums();
}

Status RollbackSession::add_local_input(uint32_t player, const uint8_t* input, uint64_t& tick) {
  if (!begun_ || player >= def_.players || is_remote(player) || input == nullptr) return Status::bad_argument;
  const uint64_t next = tick_ + def_.delay;
  if (next_[player] != next) return Status::bad_argument;
  set_input(player, next, input);
  tick = next;
  return Status::ok;
}

Status RollbackSession::add_input(uint32_t player, uint64_t tick, const uint8_t* input) {
  if (!begun_ || !is_remote(player) || input == nullptr) return Status::bad_argument;
  if (tick < next_[player]) return Status::ok;
  if (tick - oldest() >= kept_) return Status::out_of_range;
  if (!is_known(player, tick)) set_input(player, tick, input);
  return Status::ok;
}

Status RollbackSession::get_input(uint32_t player, uint64_t tick, uint8_t* input) const {
  if (!begun_ || player >= def_.players || input == nullptr) return Status::bad_argument;
  if (!is_known(player, tick)) return Status::out_of_range;
  memcpy(input, input_of(player, tick), def_.input_bytes);
  return Status::ok;
}

uint64_t RollbackSession::confirmed_tick() const {
  if (!begun_) return 0;
  const uint64_t known = known_tick();
  const uint64_t made = wrong_ < tick_ ? wrong_ : tick_;
  return known < made ? known : made;
}

bool RollbackSession::is_at(const World& world) const { return begun_ && get_info(world).tick == tick_; }

bool RollbackSession::lacks_local_input() const {
  for (uint32_t player = 0; player < def_.players; ++player) {
    if (!is_remote(player) && !is_known(player, tick_)) return true;
  }
  return false;
}

/// Predicts the unknown inputs of a tick: the prediction is the input of the same player in the tick before (zero in
/// the first tick). Returns a set of bits: bit p is set if the input of player p is predicted.
uint32_t RollbackSession::predict(uint64_t tick) {
  uint32_t predicted = 0;
  for (uint32_t player = 0; player < def_.players; ++player) {
    if (is_known(player, tick)) continue;
    predicted |= 1u << player;
    if (tick == start_) {
      memset(input_of(player, tick), 0, def_.input_bytes);
    } else {
      memcpy(input_of(player, tick), input_of(player, tick - 1), def_.input_bytes);
    }
  }
  return predicted;
}

/// Keeps the state of the world and of the game at the start of `tick`. Without sparse rollback, also takes its
/// checksum.
Status RollbackSession::keep(const World& world, uint64_t tick) {
#if DETENT_SPARSE
  const Status status = sparse_ != nullptr ? sparse_->keep(world) : states_.keep(world);
#else
  const Status status = states_.keep(world);
#endif
  if (status != Status::ok) return status;
  if (game_.count != 0) memcpy(game_at(tick), game_.bytes, game_.count);
#if DETENT_SPARSE
  if (sparse_ != nullptr) return Status::ok;
#endif
  take_checksum(world, game_, tick);
  return Status::ok;
}

void RollbackSession::take_checksum(const World& world, const GameState& game, uint64_t tick) {
  if (def_.checksum_interval != 0 && tick % def_.checksum_interval == 0)
    own_checksum(tick) = {tick + 1, digest_fold(digest_of(world, game)), 0};
}

/// With sparse rollback, takes the checksums of those states that no input can change any more; it reads them from the
/// kept states, which are not packed. Without sparse rollback it does nothing, because keep() takes the checksum of
/// each state.
void RollbackSession::take_confirmed_checksums() {
#if DETENT_SPARSE
  if (sparse_ == nullptr) return;
  const uint64_t confirmed = confirmed_tick();
  for (uint64_t& tick = sparse_->summed; tick <= confirmed && tick < tick_; ++tick)
    take_checksum(sparse_->kept(tick), {game_.count == 0 ? nullptr : game_at(tick), game_.count}, tick);
#endif
}

Status RollbackSession::restore(World& world, uint64_t tick) {
#if DETENT_SPARSE
  const Status status = sparse_ != nullptr ? sparse_->restore(world, tick) : states_.restore(world, tick);
#else
  const Status status = states_.restore(world, tick);
#endif
  if (status != Status::ok) return status;
  if (game_.count != 0) memcpy(game_.bytes, game_at(tick), game_.count);
  return Status::ok;
}

Status RollbackSession::make_tick(World& world, uint64_t tick, bool again) {
  if (const Status status = keep(world, tick); status != Status::ok) return status;
  const uint32_t predicted = predict(tick);
#if DETENT_SPARSE
  if (sparse_ != nullptr) sparse_->start_tick(world, again);
#endif
  maker_.make(maker_.context, world, {tick, input_of(0, tick), def_.players, def_.input_bytes, predicted, again});
#if DETENT_SPARSE
  if (sparse_ != nullptr) sparse_->end_tick(world);
#endif
  if (get_info(world).tick == tick + 1) return Status::ok;
  begun_ = false;
  return Status::bad_argument;
}

Status RollbackSession::go_back(World& world, RollbackReport& report) {
  if (wrong_ >= tick_) return Status::ok;
  const uint64_t first = wrong_;
  if (const Status status = restore(world, first); status != Status::ok) return status;
  wrong_ = UINT64_MAX;
  for (uint64_t tick = first; tick < tick_; ++tick) {
    if (const Status status = make_tick(world, tick, true); status != Status::ok) return status;
  }
  report.went_back = first;
  report.ticks_again = report.ticks_whole = static_cast<uint32_t>(tick_ - first);
#if DETENT_SPARSE
  if (sparse_ != nullptr) {
    report.ticks_whole = sparse_->ticks_whole;
    report.bodies_again = sparse_->bodies_again;
  }
#endif
  return Status::ok;
}

Status RollbackSession::correct(World& world, RollbackReport& report) {
  if (!is_at(world)) return Status::bad_argument;
  RollbackReport made;
  if (const Status status = go_back(world, made); status != Status::ok) return status;
  made.tick = tick_;
  take_confirmed_checksums();
  compare_checksums();
  report = made;
  return Status::ok;
}

Status RollbackSession::advance(World& world, RollbackReport& report) {
  if (!is_at(world) || lacks_local_input()) return Status::bad_argument;
  const uint64_t known = known_tick();
  if (tick_ >= known && tick_ - known >= def_.window) return Status::waiting;
  RollbackReport made;
  if (const Status status = go_back(world, made); status != Status::ok) return status;
  take_confirmed_checksums();  // before the new tick overwrites the oldest kept state
  if (const Status status = make_tick(world, tick_, false); status != Status::ok) return status;
  made.tick = ++tick_;
  take_confirmed_checksums();
  compare_checksums();
  report = made;
  return Status::ok;
}

RollbackSession::Checksum& RollbackSession::own_checksum(uint64_t tick) const {
  return sums_[place(tick) * (def_.players + 1)];
}

RollbackSession::Checksum& RollbackSession::their_checksum(uint32_t player, uint64_t tick) const {
  return sums_[place(tick) * (def_.players + 1) + 1 + player];
}

uint32_t RollbackSession::checksums(TickChecksum* last, uint32_t count) const {
  if (!begun_ || last == nullptr) return 0;
  uint32_t found = 0;
  uint64_t tick = confirmed_tick();
  for (uint32_t i = 0; i < kept_ && found < count; ++i, --tick) {
    const Checksum& own = own_checksum(tick);
    if (own.stamp == tick + 1) last[found++] = {tick, own.value};
    if (tick == start_) break;
  }
  return found;
}

Status RollbackSession::add_checksum(uint32_t player, const TickChecksum& theirs) {
  const uint64_t tick = theirs.tick;
  if (!begun_ || !is_remote(player) || def_.checksum_interval == 0 || tick % def_.checksum_interval != 0)
    return Status::bad_argument;
  Checksum& kept = their_checksum(player, tick);
  const bool ahead = tick >= oldest() && tick - oldest() >= kept_;
  const bool gone = tick < confirmed_tick() && own_checksum(tick).stamp != tick + 1;
  if (ahead || gone || kept.stamp > tick + 1) return Status::out_of_range;
  if (kept.stamp != tick + 1) kept = {tick + 1, theirs.checksum, 0};
  compare_checksum(player, tick);
  return desync_.found ? Status::digest_differs : Status::ok;
}

void RollbackSession::compare_checksum(uint32_t player, uint64_t tick) {
  Checksum& theirs = their_checksum(player, tick);
  const Checksum& own = own_checksum(tick);
  if (theirs.stamp != tick + 1 || theirs.compared != 0 || own.stamp != tick + 1 || tick > confirmed_tick()) return;
  theirs.compared = 1;
  if (theirs.value == own.value) return;
  const bool earlier = !desync_.found || tick < desync_.tick || (tick == desync_.tick && player < desync_.player);
  if (earlier) desync_ = {true, tick, player, own.value, theirs.value};
}

void RollbackSession::compare_checksums() {
  if (def_.checksum_interval == 0) return;
  for (uint32_t i = 0; i < kept_; ++i) {
    for (uint32_t player = 0; player < def_.players; ++player) {
      const uint64_t stamp = sums_[i * (def_.players + 1) + 1 + player].stamp;
      if (stamp != 0) compare_checksum(player, stamp - 1);
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
