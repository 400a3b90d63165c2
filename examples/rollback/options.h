#pragma once
#include <string>

#include "examples/rollback/conditioner.h"

namespace detent_rollback {

/// What the command line says. The host's word counts for what all must have alike: players, ticks, window, speed,
/// seed.
struct Options {
  bool hosts = false;
  std::string address;  ///< of the host, if this machine joins
  uint16_t port = 0;
  uint32_t key = 0;

  uint32_t players = 2, ticks = 3600, window = 16;
  double speed = 1;
  uint64_t seed = 1;

  uint32_t delay = 2;
  bool bot = false;  ///< nobody looks and plays here
  LinkConditions conditions;
  std::string recording;  ///< a path, or empty
};

}  // namespace detent_rollback
