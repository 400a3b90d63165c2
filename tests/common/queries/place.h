#pragma once
#include "tests/common/queries/random.h"

/// How a query's bodies are placed and sent on their way.
namespace detent_queries {

/// A query of the two solids at random rotations, A near the origin at random, B at A.
Query at_one_place(Random& random, const Solid& a, const Solid& b, double scale);

/// Turns of a random axis and angle, rad.
void angular_velocity(Random& random, Query& query, double angle_min, double angle_max);

/// Shares a displacement of B relative to A out between the two, on top of a common one.
void share_motion(Random& random, Query& query, const Triple& relative, double common);

struct Aim {
  double scale = 1;
  double gap_min = 0.05, gap_max = 2;  ///< m, times scale; between the bounds at the start
  double lateral_max = 1.3;            ///< of the summed bounds: by how much B's centre is to pass A's
  double far = 0;                      ///< m; each coordinate of A is about this, of either sign
};
/// B starts some way off and is aimed at A, to get there and perhaps past it, or not quite.
void send(Random& random, Query& query, const Aim& aim);

/// Moves B along `direction` from within to where the gap at the start is `gap`, to a tenth; false if that is not
/// reached. B is then all but at the origin, for a float to hold so small a gap.
bool place_at_gap(Query& query, const Triple& direction, double gap);

/// Shifts B so that the closest approach over the step is `gap` (if less than 0: the depth), to a fifth; false if this
/// query does not lend itself to it. B is then all but at the origin.
bool graze(Query& query, double gap);

}  // namespace detent_queries
