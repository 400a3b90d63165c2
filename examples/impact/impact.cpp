#include <detent/distance.h>
#include <detent/numbers.h>
#include <detent/toi.h>
#include <stdio.h>
using namespace detent;

int main() {
  Convex door, crate;
  if (make_convex(box({0.5, 0.1, 0.5}), door) != Status::ok ||
      make_convex(rounded(box({0.2, 0.2, 0.2}), 0.05), crate) != Status::ok) {
    return 1;
  }
  // During the step the door rotates by 3 rad, and the crate falls by 3 m.
  const Motion swing = {.start = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, .rotation_vector = {0.0, 0.0, 3.0}};
  const Motion fall = {.start = {{0.0, 2.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, .displacement = {0.0, -3.0, 0.0}};

  Closest closest;
  if (closest_points(door, swing.start, crate, fall.start, closest) != Status::ok) return 1;
  printf("at the start %.6f m apart\n", real_to_host(closest.distance));

  TimeOfImpact impact;
  if (time_of_impact(door, swing, crate, fall, impact) != Status::ok) return 1;
  if (impact.outcome == ToiOutcome::hit) {
    printf("they meet at %.6f of the step, normal (%.3f, %.3f, %.3f)\n", fraction_to_host(impact.time),
           unit_to_host(impact.normal.x), unit_to_host(impact.normal.y), unit_to_host(impact.normal.z));
  }

  CastHit hit;
  if (cast_ray(crate, fall.start, {0.0, -1.0, 0.0}, {0.0, 2.0, 0.0}, hit) != Status::ok) return 1;
  printf("a ray from below meets the crate at %.6f of its way\n", fraction_to_host(hit.time));
}
