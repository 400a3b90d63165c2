#include <detent/numbers.h>
#include <detent/recording.h>
#include <detent/rollback.h>
#include <string.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

constexpr Capacity k_capacity = {.bodies = 8, .contacts = 16};
constexpr uint32_t k_window = 8;  // ticks that can be undone

struct Match {
  WorldStorage<k_capacity> storage;
  World world;
  BodyId player;
  alignas(8) uint8_t memory[snapshot_ring_bytes(k_capacity, k_window)];
  SnapshotRing ring;
};

void build(Match& match) {
  check(match.storage.create({}, match.world));
  check(match.ring.begin(match.memory, sizeof match.memory, k_capacity, k_window));
  BodyId ground;
  check(create_body(match.world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  check(create_body(match.world, {.position = {0.0, 0.5, 0.0}, .shape = sphere(0.5)}, match.player));
}

void advance(Match& match, bool jump) {
  check(match.ring.keep(match.world));
  if (jump) check(apply_impulse(match.world, match.player, {0.0, 2000.0, 0.0}));
  step(match.world);
}

void roll_back() {
  static Match here, there;
  build(here);
  build(there);
  for (uint64_t tick = 0; tick < 20; ++tick) {
    advance(here, false);        // this machine has not received the jump yet
    advance(there, tick == 15);  // the jump happens on this machine
  }
  check(digest(here.world) != digest(there.world));

  check(here.ring.restore(here.world, 15));
  for (uint64_t tick = 15; tick < 20; ++tick) advance(here, tick == 15);
  check(digest(here.world) == digest(there.world));
}

void join_late() {
  static Match server;
  static WorldStorage<k_capacity> storage;
  build(server);
  for (int tick = 0; tick < 10; ++tick) advance(server, false);

  alignas(8) static uint8_t bytes[snapshot_bytes(k_capacity)];
  check(save(server.world, bytes, sizeof bytes));  // sent to the machine that joins

  World joined;
  check(storage.create({}, joined));
  check(load(joined, bytes, sizeof bytes));  // checks every field, and uses the bytes as scratch memory
  check(digest(joined) == digest(server.world));

  check(save(server.world, bytes, sizeof bytes));
  bytes[0] ^= 1;
  check(load(joined, bytes, sizeof bytes) == Status::not_detent);
}

void send_differences() {
  static Match server, client;
  build(server);
  build(client);

  alignas(8) static uint8_t base[snapshot_bytes(k_capacity)];
  static uint8_t delta[delta_bytes_max(k_capacity)];
  uint32_t bytes = 0;
  check(save(server.world, base, sizeof base));  // both machines have it
  advance(server, true);
  check(save_delta(server.world, base, sizeof base, delta, sizeof delta, bytes));
  check(bytes < 300);

  check(apply_delta(base, sizeof base, delta, bytes));  // on the client: base becomes the new snapshot
  check(load(client.world, base, sizeof base));
  check(checksum32(client.world) == checksum32(server.world));

  static WorldStorage<Capacity{.bodies = 100, .contacts = 300}> storage;
  World larger;
  check(storage.create({}, larger));
  check(copy_world(server.world, larger));
  check(digest(larger) == digest(server.world));
}

constexpr RollbackDef k_session = {.players = 2, .input_bytes = 1};

/// A player's machine.
struct Machine {
  WorldStorage<k_capacity> storage;
  World world;
  BodyId balls[2];
  RollbackSession session;
  alignas(8) uint8_t memory[rollback_bytes(k_capacity, k_session)];
};

void make_tick(void* context, World& world, const TickInputs& inputs) {
  const Machine& machine = *static_cast<Machine*>(context);
  for (uint32_t player = 0; player < inputs.players; ++player) {
    if (inputs.of(player)[0] == 1) check(apply_impulse(world, machine.balls[player], {0.0, 500.0, 0.0}));
  }
  step(world);
}

void join(Machine& machine, uint32_t player) {
  check(machine.storage.create({}, machine.world));
  BodyId ground;
  check(create_body(machine.world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  check(create_body(machine.world, {.position = {0.0, 0.5, 0.0}, .shape = sphere(0.5)}, machine.balls[0]));
  check(create_body(machine.world, {.position = {2.0, 0.5, 0.0}, .shape = sphere(0.5)}, machine.balls[1]));

  RollbackDef def = k_session;
  def.local = 1u << player;
  check(machine.session.begin(machine.world, def, {make_tick, &machine}, machine.memory, sizeof machine.memory));
}

/// A player's input in a tick, and a checksum to send with it.
struct Message {
  uint64_t tick;
  uint8_t input;
  TickChecksum checksum;
};

Message play(Machine& machine, uint32_t player, bool jump) {
  Message message = {};
  message.input = jump ? 1 : 0;
  check(machine.session.add_local_input(player, &message.input, message.tick));
  RollbackReport report;
  const Status status = machine.session.advance(machine.world, report);
  if (status != Status::waiting) check(status);  // waiting: no tick was made; retry after more inputs arrive
  machine.session.checksums(&message.checksum, 1);
  return message;
}

void receive(Machine& machine, uint32_t from, const Message& message) {
  check(machine.session.add_input(from, message.tick, &message.input));
  const Status status = machine.session.add_checksum(from, message.checksum);
  if (status == Status::digest_differs) {
    printf("out of step since tick %u\n", static_cast<unsigned>(machine.session.desync().tick));
  }
  check(status);
}

void play_together() {
  constexpr uint64_t k_ticks = 100, k_latency = 5;
  static Machine machines[2];
  static Message sent[2][k_ticks];
  for (uint32_t player = 0; player < 2; ++player) join(machines[player], player);
  for (uint64_t tick = 0; tick < k_ticks + k_latency; ++tick) {
    for (uint32_t player = 0; player < 2; ++player) {
      if (tick >= k_latency) receive(machines[player], 1 - player, sent[1 - player][tick - k_latency]);
      if (tick < k_ticks) sent[player][tick] = play(machines[player], player, tick % (20 + player) == 7);
    }
  }
  for (Machine& machine : machines) {
    RollbackReport report;
    check(machine.session.correct(machine.world, report));  // after the last tick
    check(machine.session.confirmed_tick() == k_ticks);
  }
  check(digest(machines[0].world) == digest(machines[1].world));
}

void test_the_maker() {
  static Machine machine;
  join(machine, 0);
  const uint8_t inputs[3 * 2] = {0, 1, 1, 0, 0, 1};  // three ticks of two players
  alignas(8) static uint8_t memory[sync_test_bytes(k_capacity, 3)];
  SyncTestReport report;
  const SyncTestDef def = {.ticks = 3, .inputs = inputs, .players = 2, .input_bytes = 1};
  check(sync_test(machine.world, def, {make_tick, &machine}, memory, sizeof memory, {}, report));
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
  check(recorder.begin({.keyframe_interval = 20}));  // ticks between keyframes, for go_to
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
  check(storage.create({}, world));  // with the capacity that player.info() gives
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
  check(player.go_to(world, 50));  // replays from the keyframe after tick 40
  check(player.go_to(world, 12));  // replays from the seed
  check(get_info(world).tick == 12);
}

}  // namespace

int main() {
  roll_back();
  join_late();
  send_differences();
  play_together();
  test_the_maker();
  static Tape tape;
  record(tape);
  replay(tape);
  look_back(tape);
}
