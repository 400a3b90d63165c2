#pragma once
#include <stdint.h>

/// The messages between the machines of a match, as bytes. Received bytes are not trusted: a read function returns
/// false and leaves its result unspecified if a length, a tag or a number is invalid.
namespace detent_rollback {

inline constexpr uint32_t k_players_max = 4;
inline constexpr uint32_t k_inputs = 32;           ///< all inputs are below it
inline constexpr uint32_t k_run_inputs_max = 128;  ///< of one player in one packet
inline constexpr uint32_t k_window_max = 40;
inline constexpr uint32_t k_ticks_max = 1u << 24;  ///< of a match: 3.2 days at 60 a second
inline constexpr uint32_t k_protocol = 1;          ///< increases with every change of the format

/// The inputs of one player in consecutive ticks.
struct Run {
  uint32_t player = 0;
  uint32_t first = 0;  ///< the tick of the first input
  uint32_t count = 0;  ///< at least 1
  uint8_t inputs[k_run_inputs_max] = {};
};

/// One machine's state for another, sent each frame and never resent: the next packet repeats what the receiver still
/// lacks.
struct Packet {
  uint32_t match = 0;     ///< the match that the packet belongs to
  uint32_t sequence = 0;  ///< number of this packet from the sender to this receiver
  uint32_t player = 0;    ///< the sender
  uint32_t tick = 0;      ///< ticks made by the sender
  /// ticks that the sender is ahead of the receiver by its own count, [-128, 127]
  int32_t ahead = 0;
  /// Whether the packet has a checksum, of a state that the sender's inputs can no longer change.
  bool has_checksum = false;
  uint32_t checksum_tick = 0;           ///< the number of ticks before that state; 0 without a checksum
  uint32_t checksum = 0;                ///< 0 without a checksum
  uint32_t players = 0;                 ///< [2, k_players_max]
  uint32_t wanted[k_players_max] = {};  ///< for each player: the first tick whose input the sender lacks
  uint32_t run_count = 0;
  Run runs[k_players_max] = {};
};

inline constexpr uint32_t k_packet_bytes_max =
    28 + 4 * k_players_max + 1 + k_players_max * (6 + k_run_inputs_max);  ///< smaller than any MTU

uint32_t write_packet(const Packet& packet, uint8_t* bytes);
bool read_packet(const uint8_t* bytes, uint32_t count, Packet& packet);

/// The first message of a machine that joins. This message and all those below are sent reliably.
struct Hello {
  uint32_t simulation = 0;  ///< k_simulation_version
  uint32_t config = 0;      ///< Config
  uint32_t key = 0;         ///< a number that the host has given to its guests
};
uint32_t write_hello(const Hello& hello, uint8_t* bytes);
bool read_hello(const uint8_t* bytes, uint32_t count, Hello& hello);

/// The host's answer when all players have joined: the match begins.
struct Welcome {
  uint32_t match = 0;
  uint32_t player = 0;   ///< the receiver's player, at least 1 (0 is the host)
  uint32_t players = 0;  ///< [2, k_players_max]
  uint32_t window = 0;   ///< RollbackDef::window, [1, k_window_max]
  uint32_t ticks = 0;    ///< [1, k_ticks_max]
  uint32_t speed = 0;    ///< the clocks' rate in hundredths of real time, [1, 10000]
  uint64_t seed = 0;     ///< for the bots
};
uint32_t write_welcome(const Welcome& welcome, uint8_t* bytes);
bool read_welcome(const uint8_t* bytes, uint32_t count, Welcome& welcome);

/// The result of a match. A client sends it when it has all inputs, the host when all clients have sent theirs.
struct Farewell {
  uint32_t match = 0;
  uint64_t digest = 0;  ///< of the last state
};
uint32_t write_farewell(const Farewell& farewell, uint8_t* bytes);
bool read_farewell(const uint8_t* bytes, uint32_t count, Farewell& farewell);

inline constexpr uint32_t k_message_bytes_max = k_packet_bytes_max;

}  // namespace detent_rollback
