#include <detent/numbers.h>
#include <detent/toi_methods.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

int main() {
  Convex door, crate;
  check(make_convex(box({0.5, 0.1, 0.5}), door));
  check(make_convex(box({0.25, 0.25, 0.25}), crate));
  const Motion swing = {.rotation_vector = {0.0, 0.0, 2.0}};  // during the step, rad
  const Motion fall = {.start = {{0.0, 2.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, .displacement = {0.0, -3.0, 0.0}};

  TimeOfImpact impact;
  check(time_of_impact_by(ToiMethod::mirtich, door, swing, crate, fall, impact));
  printf("at %.6f of the step, %u times the closest points\n", fraction_to_host(impact.time), impact.gjk_calls);

  TimeOfImpact own;
  check(time_of_impact(door, swing, crate, fall, own));
  check(own.outcome == ToiOutcome::hit && impact.outcome == ToiOutcome::hit);
  check(fabs(fraction_to_host(impact.time) - fraction_to_host(own.time)) < 1e-5);
}
