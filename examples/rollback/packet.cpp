#include "examples/rollback/packet.h"

#include "examples/rollback/wire.h"

namespace detent_rollback {
namespace {

/// The first four bytes of a message, which give its kind.
constexpr uint32_t tag(uint32_t kind) { return 'd' | 't' << 8 | k_protocol << 16 | kind << 24; }
constexpr uint32_t k_packet_tag = tag('p'), k_hello_tag = tag('h'), k_welcome_tag = tag('w'), k_farewell_tag = tag('f');

bool read_run(Reader& reader, const Packet& packet, Run& run) {
  run.player = reader.take_u8();
  run.count = reader.take_u8();
  run.first = reader.take_u32();
  if (run.player >= packet.players || run.count < 1 || run.count > k_run_inputs_max || run.first > k_ticks_max) {
    return false;
  }
  for (uint32_t i = 0; i < run.count; ++i) {
    run.inputs[i] = reader.take_u8();
    if (run.inputs[i] >= k_inputs) return false;
  }
  return true;
}

/// Requires the runs in rising order of their players, so that no player appears twice.
bool read_runs(Reader& reader, Packet& packet) {
  packet.run_count = reader.take_u8();
  if (packet.run_count > packet.players) return false;
  for (uint32_t i = 0; i < packet.run_count; ++i) {
    if (!read_run(reader, packet, packet.runs[i])) return false;
    if (i != 0 && packet.runs[i].player <= packet.runs[i - 1].player) return false;
  }
  return true;
}

}  // namespace

uint32_t write_packet(const Packet& packet, uint8_t* bytes) {
  Writer writer(bytes);
  writer.put_u32(k_packet_tag);
  writer.put_u32(packet.match);
  writer.put_u32(packet.sequence);
  writer.put_u32(packet.tick);
  writer.put_u32(packet.checksum_tick);
  writer.put_u32(packet.checksum);
  writer.put_u8(packet.has_checksum ? 1 : 0);
  writer.put_u8(packet.player);
  writer.put_u8(static_cast<uint8_t>(packet.ahead));
  writer.put_u8(packet.players);
  for (uint32_t i = 0; i < packet.players; ++i) writer.put_u32(packet.wanted[i]);
  writer.put_u8(packet.run_count);
  for (uint32_t i = 0; i < packet.run_count; ++i) {
    const Run& run = packet.runs[i];
    writer.put_u8(run.player);
    writer.put_u8(run.count);
    writer.put_u32(run.first);
    for (uint32_t k = 0; k < run.count; ++k) writer.put_u8(run.inputs[k]);
  }
  return writer.count();
}

bool read_packet(const uint8_t* bytes, uint32_t count, Packet& packet) {
  Reader reader(bytes, count);
  if (count > k_packet_bytes_max || reader.take_u32() != k_packet_tag) return false;
  packet.match = reader.take_u32();
  packet.sequence = reader.take_u32();
  packet.tick = reader.take_u32();
  packet.checksum_tick = reader.take_u32();
  packet.checksum = reader.take_u32();
  const uint32_t has_checksum = reader.take_u8();
  packet.has_checksum = has_checksum == 1;
  packet.player = reader.take_u8();
  packet.ahead = static_cast<int8_t>(reader.take_u8());
  packet.players = reader.take_u8();
  if (packet.players < 2 || packet.players > k_players_max || packet.player >= packet.players) return false;
  if (packet.tick > k_ticks_max || packet.checksum_tick > packet.tick || has_checksum > 1) return false;
  if (!packet.has_checksum && (packet.checksum_tick != 0 || packet.checksum != 0)) return false;
  for (uint32_t i = 0; i < packet.players; ++i) {
    packet.wanted[i] = reader.take_u32();
    if (packet.wanted[i] > k_ticks_max + k_window_max) return false;
  }
  return read_runs(reader, packet) && reader.is_at_end();
}

uint32_t write_hello(const Hello& hello, uint8_t* bytes) {
  Writer writer(bytes);
  writer.put_u32(k_hello_tag);
  writer.put_u32(hello.simulation);
  writer.put_u32(hello.config);
  writer.put_u32(hello.key);
  return writer.count();
}

bool read_hello(const uint8_t* bytes, uint32_t count, Hello& hello) {
  Reader reader(bytes, count);
  if (reader.take_u32() != k_hello_tag) return false;
  hello.simulation = reader.take_u32();
  hello.config = reader.take_u32();
  hello.key = reader.take_u32();
  return reader.is_at_end();
}

uint32_t write_welcome(const Welcome& welcome, uint8_t* bytes) {
  Writer writer(bytes);
  writer.put_u32(k_welcome_tag);
  writer.put_u32(welcome.match);
  writer.put_u8(welcome.player);
  writer.put_u8(welcome.players);
  writer.put_u8(welcome.window);
  writer.put_u32(welcome.ticks);
  writer.put_u32(welcome.speed);
  writer.put_u64(welcome.seed);
  return writer.count();
}

bool read_welcome(const uint8_t* bytes, uint32_t count, Welcome& welcome) {
  Reader reader(bytes, count);
  if (reader.take_u32() != k_welcome_tag) return false;
  welcome.match = reader.take_u32();
  welcome.player = reader.take_u8();
  welcome.players = reader.take_u8();
  welcome.window = reader.take_u8();
  welcome.ticks = reader.take_u32();
  welcome.speed = reader.take_u32();
  welcome.seed = reader.take_u64();
  const bool is_one_of_them = welcome.player >= 1 && welcome.player < welcome.players;
  return reader.is_at_end() && is_one_of_them && welcome.players <= k_players_max && welcome.window >= 1 &&
         welcome.window <= k_window_max && welcome.ticks >= 1 && welcome.ticks <= k_ticks_max && welcome.speed >= 1 &&
         welcome.speed <= 10000;
}

uint32_t write_farewell(const Farewell& farewell, uint8_t* bytes) {
  Writer writer(bytes);
  writer.put_u32(k_farewell_tag);
  writer.put_u32(farewell.match);
  writer.put_u64(farewell.digest);
  return writer.count();
}

bool read_farewell(const uint8_t* bytes, uint32_t count, Farewell& farewell) {
  Reader reader(bytes, count);
  if (reader.take_u32() != k_farewell_tag) return false;
  farewell.match = reader.take_u32();
  farewell.digest = reader.take_u64();
  return reader.is_at_end();
}

}  // namespace detent_rollback
