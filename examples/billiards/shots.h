#pragma once
#include "examples/billiards/table.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {

/// A stroke: the cue ball's velocities after it.
struct Shot {
  const char* name;
  Vec3<Real> linear_velocity;   ///< m/s
  Vec3<Real> angular_velocity;  ///< rad/s
};

/// A stroke by a level cue. `direction` is horizontal and of length 1 within 1e-3; `speed` is the ball's, m/s. The tip
/// hits the ball `right` and `above` of its centre, as seen by the player, in ball radii. Beyond 0.5 from the centre
/// the tip would slip off (D. Alciatore, "The Lag Shot", Billiards Digest, October 2011: miscue limit 0.5 R).
///
/// The impulse m v at the offset b gives the ball an angular velocity w with m v b = 2/5 m r^2 w, so w = 5/2 (v / r) (b
/// / r): about the horizontal axis across the direction for `above`, about the vertical axis for `right`. The model
/// leaves out squirt: a hit to the side also pushes the cue aside.
consteval Shot stroke(const char* name, double direction_x, double direction_z, double speed, double right,
                      double above) {
  const double square = direction_x * direction_x + direction_z * direction_z;
  if (square < 0.998 || square > 1.002 || right * right + above * above > 0.25) __builtin_trap();  // at compile time
  const double angular_velocity = 2.5 * speed / k_ball_radius;
  return {name, vector(direction_x * speed, 0.0, direction_z * speed),
          vector(angular_velocity * above * direction_z, angular_velocity * right,
                 -angular_velocity * above * direction_x)};
}

/// The match. Speeds are within those of D. Alciatore, "How fast does the CB travel for a range of shots?"
/// (billiards.colostate.edu/faq/speed/typical): slow 0.45 to 0.89 m/s, medium to 1.9, fast to 3.2, power to 4.5, a
/// powerful break 11 to 13. Each shot starts from the positions that the previous shot left. The shots were aimed in
/// fx64. In the other configurations the balls lie elsewhere after the break, so the same strokes may hit other balls.
inline constexpr Shot k_shots[] = {
    stroke("break", 1.0000, 0.0087, 8.9, 0.0, 0.1),
    // no angular velocity: the cue ball stops, or leaves the other at 90 degrees
    stroke("stun", 0.9613, 0.2756, 2.4, 0.0, 0.0),
    stroke("draw", -0.9613, -0.2756, 2.8, 0.0, -0.35),  // back angular velocity: it rolls back from the ball
    stroke("follow", 0.9781, 0.2079, 1.9, 0.0, 0.4),    // hit at 2/5 r above the centre, it rolls from the start
    stroke("bank", 0.7254, 0.6884, 2.6, 0.0, 0.2),      // the ball goes to its pocket off a cushion
    stroke("right english", 0.8829, -0.4695, 1.5, 0.4,
           0.1),  // side angular velocity, which changes the rebound at a cushion
    stroke("left english", -0.3746, -0.9272, 1.4, -0.35, 0.2),
    stroke("drag", 0.3090, 0.9511, 1.6, 0.0,
           -0.1),  // a little back angular velocity, which the cloth's friction removes
};
inline constexpr uint32_t k_shot_count = sizeof(k_shots) / sizeof(k_shots[0]);

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
