#include <detent/feature_toi.h>
#include <detent/numbers.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

int main() {
  // A corner of cloth falls by 2 m onto a triangle while one side of the triangle is lifted.
  const Vec3<Real> start[4] = {{0.0, 1.0, 0.0}, {-1.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  const Vec3<Real> end[4] = {{0.0, -1.0, 0.0}, {-1.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 1.0, 1.0}};
  FeatureToi fallen;
  check(feature_toi_linear(FeatureKind::vertex_face, start, end, fallen));
  if (fallen.outcome == ToiOutcome::hit) printf("at %.6f of the step\n", fraction_to_host(fallen.time));
  // At time t the triangle under the corner is at height t / 2, and the corner at height 1 - 2 t.
  check(fallen.outcome == ToiOutcome::hit && fabs(fraction_to_host(fallen.time) - 0.4) < 1e-5);

  // A bar rotates by 3 rad, and one of its edges hits an edge of a post.
  const Vec3<Real> corners[4] = {{0.25, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  const Motion turns = {.rotation_vector = {0.0, 0.0, 3.0}};
  const Motion stands = {.start = {{0.0, 0.5, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
  FeatureToi struck;
  check(feature_toi(FeatureKind::edge_edge, corners, turns, stands, struck));
  check(struck.outcome == ToiOutcome::hit && fabs(fraction_to_host(struck.time) - asin(1.0) / 3) < 1e-5);
}
