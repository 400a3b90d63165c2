#pragma once
#include <utility>
#include <vector>

#include "examples/billiards/billiards.h"
#include "examples/billiards/track.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {

/// The match seen from above, as an animation that repeats in real time: one SVG file, animated by SMIL, without
/// scripts. It only reads the world; its doubles never reach the simulation.
class Picture {
 public:
  /// Records the poses after `tick` completed ticks: call it before each step and after the last one.
  void add(const World& world, int tick);
  /// Writes the file; `digest` belongs to the last recorded state. False if the file could not be written.
  bool write(const char* path, uint64_t digest) const;

 private:
  // Lengths in mm from the table's centre; for tracks on a ball, from the ball's.
  struct Ball {
    BodyId id;                                 ///< null when it is off the table
    Track centre{0.5};                         ///< x along the table, y across
    Track number{1.0};                         ///< the spot with the number
    Track caps[2] = {Track{1.0}, Track{1.0}};  ///< the white ends of a striped ball
    std::vector<std::pair<int, bool>> seen;    ///< from this tick on the ball is on the table, or off it
  };
  struct Cushion {
    double x, y, half_length, half_width;
  };
  struct Drop {
    int tick;
    uint32_t ball;
    double x, y;  ///< where the ball was last
  };

  void add_cushions(const World& world);
  void add_ball(Ball& ball, const World& world, int tick, bool moved);

  Ball balls_[k_ball_count];
  std::vector<Cushion> cushions_;
  std::vector<Drop> drops_;
  std::vector<int> shots_;  ///< the tick of each
  int ticks_ = 0;

  friend class Page;
};

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
