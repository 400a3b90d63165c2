#pragma once
#include <string>

#include "examples/rollback/conditioner.h"

namespace detent_rollback {

/// The command line's options. All machines use the host's values of players, ticks, window, speed and seed.
struct Options {
  bool hosts = false;
  std::string address;  ///< of the host, if this machine joins a match
  uint16_t port = 0;
  uint32_t key = 0;

  uint32_t players = 2, ticks = 3600, window = 16;
  double speed = 1;
  uint64_t seed = 1;

  uint32_t delay = 2;
  bool bot = false;  ///< a bot plays here, and nothing is drawn
  LinkConditions conditions;
  std::string recording;  ///< a path, or empty
};

}  // namespace detent_rollback
