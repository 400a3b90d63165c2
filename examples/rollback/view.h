#pragma once
#include <termios.h>

#include <string>

#include "examples/rollback/game.h"

namespace detent_rollback {

/// The pitch from above, in characters, from the terminal's upper left corner on.
std::string draw(const detent::World& world);

/// The keys of this terminal: w, a, s, d go on going that way, x stops, the space bar throws. A terminal tells when a
/// key goes down, but not when it comes up.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;
  /// The input that the keys mean now.
  uint8_t input();

 private:
  termios before_ = {};
  bool is_terminal_;
  uint8_t way_ = 0;
};

}  // namespace detent_rollback
