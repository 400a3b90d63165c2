#include <detent/convert.h>
#include <detent/feature_toi.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

int main() {
  // A corner of cloth falls by 2 m onto a triangle that is lifted on one side meanwhile.
  const Vec3<Real> start[4] = {{0.0, 1.0, 0.0}, {-1.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  const Vec3<Real> end[4] = {{0.0, -1.0, 0.0}, {-1.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 1.0, 1.0}};
  FeatureToi fallen;
  check(feature_toi_linear(FeatureKind::vertex_face, start, end, fallen));
  if (fallen.outcome == ToiOutcome::hit) printf("at %.6f of the step\n", fraction_to_host(fallen.time));
  // The triangle is t / 2 high under the corner, which is 1 - 2 t high.
  check(fallen.outcome == ToiOutcome::hit && fabs(fraction_to_host(fallen.time) - 0.4) < 1e-5);

  // An edge of a bar that turns by 3 rad comes round to an edge of a post.
  const Vec3<Real> corners[4] = {{0.25, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  const Motion turns = {.turn = {0.0, 0.0, 3.0}};
  const Motion stands = {.start = {{0.0, 0.5, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
  FeatureToi struck;
  check(feature_toi(FeatureKind::edge_edge, corners, turns, stands, struck));
  check(struck.outcome == ToiOutcome::hit && fabs(fraction_to_host(struck.time) - asin(1.0) / 3) < 1e-5);
}
