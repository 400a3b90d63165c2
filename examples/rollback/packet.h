#pragma once
#include <stdint.h>

/// What the machines of a match tell each other, as bytes. Any bytes may come in: a function that reads them says
/// false, and leaves its result unspecified, if a length, a tag or a number is not as it must be.
namespace detent_rollback {

inline constexpr uint32_t k_players_max = 4;
inline constexpr uint32_t k_inputs = 32;           ///< an input is below it
inline constexpr uint32_t k_run_inputs_max = 128;  ///< of one player in a packet
inline constexpr uint32_t k_window_max = 40;
inline constexpr uint32_t k_ticks_max = 1u << 24;  ///< of a match: three days
inline constexpr uint32_t k_protocol = 1;          ///< raised by every change of the bytes

/// The inputs of one player in ticks that follow each other.
struct Run {
  uint32_t player = 0;
  uint32_t first = 0;  ///< tick
  uint32_t count = 0;  ///< at least 1
  uint8_t inputs[k_run_inputs_max] = {};
};

/// One machine's news for another, sent each frame and never again: what the other lacks is in the next one too.
struct Packet {
  uint32_t match = 0;                   ///< which match it is about
  uint32_t sequence = 0;                ///< of the sender's packets to this receiver
  uint32_t player = 0;                  ///< who sends it
  uint32_t tick = 0;                    ///< ticks that the sender has made
  int32_t ahead = 0;                    ///< by how many ticks the sender sees itself ahead of the receiver, [-128, 127]
  bool has_checksum = false;            ///< of a state that the sender's inputs can no longer change
  uint32_t checksum_tick = 0;           ///< ticks before that state
  uint32_t checksum = 0;                ///< 0 if there is none, as the tick
  uint32_t players = 0;                 ///< [2, k_players_max]
  uint32_t wanted[k_players_max] = {};  ///< of each player: the first tick whose input the sender lacks
  uint32_t run_count = 0;
  Run runs[k_players_max] = {};
};

inline constexpr uint32_t k_packet_bytes_max =
    28 + 4 * k_players_max + 1 + k_players_max * (6 + k_run_inputs_max);  ///< below any MTU

uint32_t write_packet(const Packet& packet, uint8_t* bytes);
bool read_packet(const uint8_t* bytes, uint32_t count, Packet& packet);

/// The first message of who joins. Sent reliably, as all that follow.
struct Hello {
  uint32_t simulation = 0;  ///< k_simulation_version
  uint32_t config = 0;      ///< Config
  uint32_t key = 0;         ///< what the host told its friends
};
uint32_t write_hello(const Hello& hello, uint8_t* bytes);
bool read_hello(const uint8_t* bytes, uint32_t count, Hello& hello);

/// The host's answer, once everybody is there: the match begins.
struct Welcome {
  uint32_t match = 0;
  uint32_t player = 0;   ///< who the receiver is: not 0, which is the host
  uint32_t players = 0;  ///< [2, k_players_max]
  uint32_t window = 0;   ///< RollbackDef::window, [1, k_window_max]
  uint32_t ticks = 0;    ///< [1, k_ticks_max]
  uint32_t speed = 0;    ///< how many times faster than life the clocks run, in hundredths, [1, 10000]
  uint64_t seed = 0;     ///< of the bots
};
uint32_t write_welcome(const Welcome& welcome, uint8_t* bytes);
bool read_welcome(const uint8_t* bytes, uint32_t count, Welcome& welcome);

/// How a match ended: from each client when it knows all inputs, and from the host when all of them have said so.
struct Farewell {
  uint32_t match = 0;
  uint64_t digest = 0;  ///< of the last state
};
uint32_t write_farewell(const Farewell& farewell, uint8_t* bytes);
bool read_farewell(const uint8_t* bytes, uint32_t count, Farewell& farewell);

inline constexpr uint32_t k_message_bytes_max = k_packet_bytes_max;

}  // namespace detent_rollback
