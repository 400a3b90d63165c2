#include "examples/rollback/match.h"

#include <algorithm>

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {

using detent_rollback::Packet;
using detent_rollback::Run;

static_assert(detent_rollback::k_players_max == k_players_max && detent_rollback::k_inputs == k_inputs);
static_assert(detent_rollback::k_window_max <= k_rollback_window_max);

namespace {

constexpr uint32_t k_checksum_interval = 10;

uint8_t* bytes_of(std::vector<uint64_t>& words) { return reinterpret_cast<uint8_t*>(words.data()); }
uint32_t byte_count(const std::vector<uint64_t>& words) { return static_cast<uint32_t>(words.size() * 8); }

/// The session's TickMaker. The recorder records nothing here; it only passes the world to the game's code.
void make_tick(void*, World& world, const TickInputs& inputs) {
  Recorder recorder(world, {}, nullptr, 0);
  play(recorder, inputs.inputs, inputs.players);
  recorder.step();
}

void make_world(std::vector<uint64_t>& block, World& made) {
  block.resize((world_bytes(k_capacity) + 7) / 8);
  must(create_world(bytes_of(block), byte_count(block), world(), {}, made));
}

}  // namespace

Match::Match(const MatchDef& def) : def_(def) {
  make_world(block_, world_);
  Recorder recorder(world_, {}, nullptr, 0);
  build(recorder, def.players);
  RollbackDef session;
  session.players = def.players;
  session.local = 1u << def.player;
  session.delay = def.delay;
  session.window = def.window;
  session.checksum_interval = k_checksum_interval;
  memory_.resize((rollback_bytes(k_capacity, session) + 7) / 8);
  must(session_.begin(world_, session, {make_tick, nullptr}, bytes_of(memory_), byte_count(memory_)));
}

void Match::frame(uint8_t input) {
  play_for_who_left();
  RollbackReport report;
  if (session_.tick() >= def_.ticks) {
    must(session_.correct(world_, report));
  } else {
    uint64_t tick = 0;
    if (session_.next_input(def_.player) <= input_tick()) must(session_.add_local_input(def_.player, &input, tick));
    const Status status = session_.advance(world_, report);
    if (status == Status::waiting) {
      ++figures_.waits;
    } else {
      must(status);
    }
  }
  figures_.rollbacks += report.ticks_again != 0 ? 1 : 0;
  figures_.ticks_again += report.ticks_again;
  figures_.longest_rollback = std::max<uint64_t>(figures_.longest_rollback, report.ticks_again);
  log_confirmed();
}

void Match::play_for_who_left() {
  const uint8_t nothing = 0;
  for (uint32_t player = 0; player < def_.players; ++player) {
    if (!has_left(player)) continue;
    while (session_.next_input(player) <= session_.tick()) {
      must(session_.add_input(player, session_.next_input(player), &nothing));
    }
  }
}

void Match::log_confirmed() {
  const uint64_t end = std::min<uint64_t>(session_.confirmed_tick(), def_.ticks);
  for (uint64_t tick = confirmed_.size() / def_.players; tick < end; ++tick) {
    for (uint32_t player = 0; player < def_.players; ++player) {
      uint8_t input = 0;
      must(session_.get_input(player, tick, &input));
      confirmed_.push_back(input);
    }
  }
}

bool Match::speaks_with(uint32_t other) const {
  if (other >= def_.players || other == def_.player || has_left(other)) return false;
  return def_.player == 0 || other == 0;
}

/// Whether a machine accepts this player's inputs from `from`: the player itself or the host.
bool Match::passes_on(uint32_t player, uint32_t from) const {
  return player != def_.player && (from == 0 || from == player);
}

int32_t Match::ahead_of(const Other& other) const {
  const int64_t ahead = static_cast<int64_t>(session_.tick()) - other.tick;
  return static_cast<int32_t>(std::clamp<int64_t>(ahead, -128, 127));
}

bool Match::add_run(uint32_t player, uint64_t first, Run& run) const {
  run.player = player;
  run.first = static_cast<uint32_t>(first);
  run.count = 0;
  while (run.count < detent_rollback::k_run_inputs_max &&
         session_.get_input(player, first + run.count, &run.inputs[run.count]) == Status::ok) {
    ++run.count;
  }
  return run.count != 0;
}

uint32_t Match::write_for(uint32_t other, uint8_t* bytes) {
  Other& state = others_[other];
  Packet packet;
  packet.match = def_.match;
  packet.sequence = ++state.sequence;
  packet.player = def_.player;
  packet.players = def_.players;
  packet.tick = static_cast<uint32_t>(session_.tick());
  packet.ahead = ahead_of(state);
  TickChecksum last;
  packet.has_checksum = session_.checksums(&last, 1) == 1;
  if (packet.has_checksum) {
    packet.checksum_tick = static_cast<uint32_t>(last.tick);
    packet.checksum = last.checksum;
  }
  for (uint32_t player = 0; player < def_.players; ++player) {
    packet.wanted[player] = static_cast<uint32_t>(session_.next_input(player));
    const bool is_ours_to_tell = player == def_.player || (def_.player == 0 && player != other);
    if (is_ours_to_tell && add_run(player, state.wanted[player], packet.runs[packet.run_count])) ++packet.run_count;
  }
  const uint32_t count = detent_rollback::write_packet(packet, bytes);
  ++figures_.packets_out;
  figures_.bytes_out += count;
  return count;
}

Verdict Match::take(uint32_t from, const uint8_t* bytes, uint32_t count, double now) {
  if (!speaks_with(from)) return Verdict::refused;
  ++figures_.packets_in;
  figures_.bytes_in += count;
  Guard& guard = others_[from].guard;
  Packet packet;
  const bool is_one = !guard.is_flood(now) && detent_rollback::read_packet(bytes, count, packet) &&
                      packet.match == def_.match && packet.players == def_.players && packet.player == from;
  if (is_one && guard.is_repeated(packet.sequence)) {
    ++figures_.repeated;
    return Verdict::repeated;
  }
  if (!is_one || !is_plausible(packet)) {
    guard.refuse();
    return Verdict::refused;
  }
  guard.remember(packet.sequence);
  use(packet);
  return Verdict::used;
}

/// The first tick for which some player's input is not known.
uint64_t Match::known_tick() const { return session_.next_input(slowest()); }

/// Whether a correct machine can have sent this packet. No machine makes more than `window` ticks without the inputs of
/// all players, and none gives inputs more than `delay` <= `window` ticks ahead. So no machine is more than two windows
/// and two delays ahead of the inputs known here, or more than a window and two delays ahead of the ticks made here. A
/// run starts at the first input that we reported as missing; we may have received that input since then.
bool Match::is_plausible(const Packet& packet) const {
  const uint64_t end = std::min(known_tick(), session_.tick()) + 4 * uint64_t{def_.window};
  if (packet.tick > end) return false;
  for (uint32_t player = 0; player < def_.players; ++player) {
    const bool is_ours_to_tell = player == def_.player || (def_.player == 0 && player != packet.player);
    if (is_ours_to_tell && packet.wanted[player] > session_.next_input(player)) return false;
  }
  for (uint32_t i = 0; i < packet.run_count; ++i) {
    const Run& run = packet.runs[i];
    if (!passes_on(run.player, packet.player) || run.first > session_.next_input(run.player)) return false;
    if (uint64_t{run.first} + run.count > end) return false;
  }
  return !packet.has_checksum || packet.checksum_tick % k_checksum_interval == 0;
}

void Match::use(const Packet& packet) {
  Other& other = others_[packet.player];
  other.tick = std::max(other.tick, packet.tick);
  other.ahead += (ahead_of(other) - other.ahead) / 16;
  other.behind += (packet.ahead - other.behind) / 16;
  for (uint32_t player = 0; player < def_.players; ++player) {
    other.wanted[player] = std::max(other.wanted[player], packet.wanted[player]);
  }
  for (uint32_t i = 0; i < packet.run_count; ++i) {
    const Run& run = packet.runs[i];
    for (uint32_t k = 0; k < run.count; ++k) must(session_.add_input(run.player, run.first + k, &run.inputs[k]));
  }
  // Ignores checksums that arrive too late or too early to compare; the session stores a mismatch.
  if (packet.has_checksum) {
    static_cast<void>(session_.add_checksum(packet.player, {packet.checksum_tick, packet.checksum}));
  }
}

uint32_t Match::slowest() const {
  uint32_t slowest = 0;
  for (uint32_t player = 1; player < def_.players; ++player) {
    if (session_.next_input(player) < session_.next_input(slowest)) slowest = player;
  }
  return slowest;
}

double Match::ticks_ahead() const {
  double most = 0;
  for (uint32_t other = 0; other < def_.players; ++other) {
    if (speaks_with(other)) most = std::max(most, (others_[other].ahead - others_[other].behind) / 2);
  }
  return most;
}

double Match::round_trip_ticks() const {
  double most = 0;
  for (uint32_t other = 0; other < def_.players; ++other) {
    if (speaks_with(other)) most = std::max(most, others_[other].ahead + others_[other].behind);
  }
  return most;
}

uint64_t Match::refused() const {
  uint64_t sum = 0;
  for (const Other& other : others_) sum += other.guard.refused();
  return sum;
}

uint64_t replay_inputs(const std::vector<uint8_t>& inputs, uint32_t players, Sink sink) {
  std::vector<uint64_t> block;
  World world;
  make_world(block, world);
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(world, sink, buffer, sizeof buffer);
  build(recorder, players);
  if (recorder.begin() != Status::ok) return 0;
  for (size_t at = 0; at + players <= inputs.size(); at += players) {
    play(recorder, &inputs[at], players);
    recorder.step();
  }
  return recorder.end() == Status::ok ? digest(world) : 0;
}

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
