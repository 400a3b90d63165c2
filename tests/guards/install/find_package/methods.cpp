#include <detent/toi_methods.h>

/// A ball that falls on another, by one of the methods of the library beside Detent.
int main() {
  using namespace detent;
  Convex ball;
  if (make_convex(sphere(Real(0.5)), ball) != Status::ok) return 1;
  const Motion rest;
  Motion fall;
  fall.start.position.y = 2.0;
  fall.displacement.y = -2.0;
  TimeOfImpact impact;
  if (time_of_impact_by(ToiMethod::baraff, ball, rest, ball, fall, impact) != Status::ok) return 1;
  return impact.outcome == ToiOutcome::hit ? 0 : 1;
}
