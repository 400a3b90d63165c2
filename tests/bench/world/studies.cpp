#include "tests/bench/world/studies.h"

#include <math.h>

#include "tests/campaigns/stress/measures.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

/// Of what stands.
States at_start(const Stage& stage, double) { return states_at_start(stage); }

/// S9: the only body slides down the slope, which descends towards +x.
States sliding(const Stage& stage, double seconds) {
  States states = states_at_start(stage);
  const auto along = detent_stress::to_world(stage.bodies[0].rotation, {1, 0, 0});
  const auto normal = detent_stress::to_world(stage.bodies[0].rotation, {0, 1, 0});
  const double pull = stage.gravity * (-along[1] - stage.bodies[1].friction * normal[1]);
  for (size_t i = 0; i < 3; ++i) states[1].position[i] += along[i] * pull * seconds * seconds / 2;
  return states;
}

/// S12: the only body falls, and comes back to the height that it fell from.
States bouncing(const Stage& stage, double seconds) {
  States states = states_at_start(stage);
  const StageBody& ball = stage.bodies[1];
  const double height = ball.position[1] - ball.size[0], fall = sqrt(2 * height / stage.gravity);
  const double since_top = remainder(seconds, 2 * fall);
  states[1].position[1] -= stage.gravity * since_top * since_top / 2;
  return states;
}

/// The only body slides until friction has given it the rotation of a ball that rolls.
States rolling(const Stage& stage, double seconds) {
  States states = states_at_start(stage);
  const StageBody& ball = stage.bodies[1];
  const double speed = ball.linear_velocity[0], pull = ball.friction * stage.gravity;
  const double rolls_at = 2 * speed / (7 * pull), slid = fmin(seconds, rolls_at), rolled = seconds - slid;
  const double turn = 2.5 * pull / ball.size[0] * (slid * slid / 2 + rolls_at * rolled);
  states[1].position[0] += speed * slid - pull * slid * slid / 2 + (speed - pull * rolls_at) * rolled;
  states[1].rotation[2] = -sin(turn / 2);
  states[1].rotation[3] = cos(turn / 2);
  return states;
}

}  // namespace

const std::vector<WorldStudy>& world_studies() {
  using namespace detent_stress;
  static const std::vector<WorldStudy> studies = {
      {{"S1", "pyramid of 210 boxes, which stands", [] { return pyramid(20); }, {{"S1", 60, 300}}},
       at_start,
       300,
       {"penetration_mean", "drift", "speed_mean"}},
      {{"S2", "tower of 10 boxes, which stands", [] { return tower(10, 1); }, {{"S2", 60, 600}}},
       at_start,
       600,
       {"penetration_mean", "drift", "speed_mean"}},
      {{"S6", "chain of 30 links, a weight of 100 at its end", [] { return chain(30, 100); }, {{"S6", 0, 1800}}},
       nullptr,
       120,
       {"stretch_max", "stretch_late", "energy"}},
      {{"S7", "box that rotates freely about its middle axis", [] { return free_rotation(); }, {{"S7", 0, 300}}},
       nullptr,
       300,
       {"energy"}},
      {{"S8", "40 dominoes", [] { return dominoes(40); }, {{"S8", 0, 480}}},
       nullptr,
       480,
       {"penetration_mean", "drift"}},
      {{"S9", "box that slides down a slope", [] { return incline(0.5, 1.5); }, {{"S9", 0, 180}}},
       sliding,
       180,
       {"penetration_mean"}},
      {{"S12", "ball that bounces back to its height", [] { return bounce(5, 3); }, {{"S12", 0, 300}}},
       bouncing,
       300,
       {"energy"}},
      {{"roll", "ball that slides and then rolls", [] { return slide_and_roll(6, 0.3); }, {{"roll", 0, 120}}},
       rolling,
       120,
       {"penetration_mean"}},
  };
  return studies;
}

double state_error(const Stage& stage, const States& states, const States& exact) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (stage.bodies[i].role != Role::dynamic) continue;
    const BodyState &a = states[i], &b = exact[i];
    double square = 0, cosine = 0;  // of half the angle between the rotations
    for (int axis = 0; axis < 3; ++axis)
      square += (a.position[axis] - b.position[axis]) * (a.position[axis] - b.position[axis]);
    for (int axis = 0; axis < 4; ++axis) cosine += a.rotation[axis] * b.rotation[axis];
    const double radius = bounding_radius(stage.bodies[i]);
    // The mean of |d + r (R - Q) e|^2 over the axes e and their opposites.
    sum += square + radius * radius * 8 * fmax(1 - cosine * cosine, 0) / 3;
    ++count;
  }
  return count == 0 ? 0 : sqrt(sum / static_cast<double>(count));
}

}  // namespace detent_bench
