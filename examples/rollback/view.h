#pragma once
#include <termios.h>

#include <string>

#include "examples/rollback/game.h"

namespace detent_rollback {

/// Draws the pitch from above, in characters, from the terminal's upper left corner on.
std::string draw(const detent::World& world);

/// The keys of this terminal: w, a, s, d set the direction, x stops, the space bar throws. A direction stays until the
/// next key, because a terminal reports that a key goes down, but not that it comes up.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;
  /// The input for the keys pressed so far.
  uint8_t input();

 private:
  termios before_ = {};
  bool is_terminal_;
  uint8_t displacement_ = 0;
};

}  // namespace detent_rollback
