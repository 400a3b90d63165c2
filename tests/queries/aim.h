#pragma once
#include "tests/queries/place.h"

/// How a feature of one polytope is sent at a feature of another.
namespace detent_queries {

/// A point of a vertex (`corners` 1), an edge (2) or a face (3) of the polytope that faces `direction`. Body frame, m.
Triple point_facing(Random& random, const Solid& solid, const Triple& direction, uint32_t corners);

/// Places B some way off and returns the way that it must go, seen from A, for a vertex of one and a face of the other
/// to come together, or an edge of each, as they are turned by then: that is in the step or not long after it. Half of
/// them pass each other beside that, mostly closely. `lateral_max` and `far` of the aim do not matter.
Triple way_to_feature(Random& random, Query& query, bool edges, const Aim& aim);

}  // namespace detent_queries
