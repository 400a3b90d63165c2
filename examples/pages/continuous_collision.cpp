#include <detent/numbers.h>
#include <detent/toi.h>
#include <detent/world.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

/// The position of a bullet of 1 cm after a tick in which it moves 10 m towards a wall of 2 cm, 5 m away.
double fired(bool continuous) {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 2}> storage;
  World world;
  check(storage.create({.continuous = continuous}, world));
  BodyId wall, bullet;
  const Shape plate = box({Real(0.01), 2.0, 2.0});
  check(create_body(world, {.type = BodyType::fixed, .position = {5.0, 0.0, 0.0}, .shape = plate}, wall));
  check(create_body(world, {.linear_velocity = {600.0, 0.0, 0.0}, .shape = sphere(Real(0.005))}, bullet));
  const StepReport report = step(world);
  check(report.ccd.impacts == (continuous ? 1 : 0));
  Pose pose;
  check(get_pose(world, bullet, pose));
  return coord_to_host(pose.position.x);
}

}  // namespace

int main() {
  check(fired(true) < 5.0);
  check(fired(false) > 9.0);

  Convex door, crate;
  check(make_convex(box({0.5, 0.1, 0.5}), door));
  check(make_convex(rounded(box({0.2, 0.2, 0.2}), 0.05), crate));
  const Motion swing = {.rotation_vector = {0.0, 0.0, 3.0}};  // during the step, rad
  const Motion fall = {.start = {{0.0, 2.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, .displacement = {0.0, -3.0, 0.0}};
  TimeOfImpact impact;
  check(time_of_impact(door, swing, crate, fall, impact));
  if (impact.outcome == ToiOutcome::hit) printf("at %.6f of the step\n", fraction_to_host(impact.time));

  check(impact.outcome == ToiOutcome::hit && fabs(fraction_to_host(impact.time) - 0.41478) < 1e-5);
}
