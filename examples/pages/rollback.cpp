#include <detent/convert.h>
#include <detent/recording.h>
#include <string.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

constexpr Capacity k_capacity = {.bodies = 8, .contacts = 16};
constexpr uint32_t k_window = 8;  // ticks that can be taken back

struct Match {
  WorldStorage<k_capacity> storage;
  World world;
  BodyId player;
  alignas(8) uint8_t snapshots[k_window][snapshot_bytes(k_capacity)];
};

void build(Match& match) {
  check(match.storage.create({}, match.world));
  BodyId ground;
  check(create_body(match.world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  check(create_body(match.world, {.position = {0.0, 0.5, 0.0}, .shape = sphere(0.5)}, match.player));
}

void advance(Match& match, bool jump) {
  const uint64_t tick = get_info(match.world).tick;
  check(save(match.world, match.snapshots[tick % k_window], snapshot_bytes(k_capacity)));
  if (jump) check(apply_impulse(match.world, match.player, {0.0, 2000.0, 0.0}));
  step(match.world);
}

void go_back(Match& match, uint64_t tick) {
  check(restore(match.world, match.snapshots[tick % k_window], snapshot_bytes(k_capacity)));
}

void roll_back() {
  static Match here, there;
  build(here);
  build(there);
  for (uint64_t tick = 0; tick < 20; ++tick) {
    advance(here, false);        // here nobody has heard of a jump yet
    advance(there, tick == 15);  // there it happened
  }
  check(digest(here.world) != digest(there.world));

  go_back(here, 15);
  for (uint64_t tick = 15; tick < 20; ++tick) advance(here, tick == 15);
  check(digest(here.world) == digest(there.world));
}

void join_late() {
  static Match server;
  static WorldStorage<k_capacity> storage;
  build(server);
  for (int tick = 0; tick < 10; ++tick) advance(server, false);

  alignas(8) static uint8_t bytes[snapshot_bytes(k_capacity)];
  check(save(server.world, bytes, sizeof bytes));  // sent to whoever joins

  World joined;
  check(storage.create({}, joined));
  check(load(joined, bytes, sizeof bytes));  // checks every field, and uses the bytes up
  check(digest(joined) == digest(server.world));

  check(save(server.world, bytes, sizeof bytes));
  bytes[0] ^= 1;
  check(load(joined, bytes, sizeof bytes) == Status::not_detent);
}

/// A recording in memory.
struct Tape {
  uint8_t bytes[65536];
  uint32_t count = 0;
  uint32_t at = 0;
};

Status write_tape(void* context, const uint8_t* bytes, uint32_t count) {
  Tape& tape = *static_cast<Tape*>(context);
  if (count > sizeof tape.bytes - tape.count) return Status::sink_failed;
  memcpy(tape.bytes + tape.count, bytes, count);
  tape.count += count;
  return Status::ok;
}

Status read_tape(void* context, uint8_t* bytes, uint32_t count, uint32_t& got) {
  Tape& tape = *static_cast<Tape*>(context);
  got = count < tape.count - tape.at ? count : tape.count - tape.at;
  memcpy(bytes, tape.bytes + tape.at, got);
  tape.at += got;
  return Status::ok;
}

Status seek_tape(void* context, uint64_t offset) {
  Tape& tape = *static_cast<Tape*>(context);
  tape.at = offset < tape.count ? static_cast<uint32_t>(offset) : tape.count;
  return Status::ok;
}

void record(Tape& tape) {
  static WorldStorage<k_capacity> storage;
  World world;
  check(storage.create({}, world));

  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(world, {write_tape, &tape}, buffer, sizeof buffer);
  check(recorder.begin({.keyframe_interval = 20}));  // ticks: the whole state, to go to
  BodyId ball;
  check(recorder.create_body({.position = {0.0, 5.0, 0.0}, .shape = sphere(0.5)}, ball));
  for (int tick = 0; tick < 60; ++tick) recorder.step();
  check(recorder.end());
}

void replay(Tape& tape) {
  static WorldStorage<k_capacity> storage;
  World world;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({read_tape, &tape}, buffer, sizeof buffer);
  check(player.open());
  check(storage.create({}, world));  // of the capacity that player.info() names
  check(player.start(world));
  for (TickResult result; !result.finished;) {
    const Status status = player.next_tick(world, result);
    if (status != Status::ok) printf("tick %u: %s\n", static_cast<unsigned>(player.error().tick), status_text(status));
    check(status);
  }
  check(get_info(world).tick == 60);
}

void look_back(Tape& tape) {
  static WorldStorage<k_capacity> storage;
  World world;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({read_tape, &tape, seek_tape}, buffer, sizeof buffer);
  tape.at = 0;
  check(player.open());
  check(storage.create({}, world));
  check(player.go_to(world, 50));  // from the keyframe after tick 40
  check(player.go_to(world, 12));  // from the seed
  check(get_info(world).tick == 12);
}

}  // namespace

int main() {
  roll_back();
  join_late();
  static Tape tape;
  record(tape);
  replay(tape);
  look_back(tape);
}
