#pragma once
#include "tests/common/queries/place.h"

/// How a feature of one polytope is sent at a feature of another.
namespace detent_queries {

/// A point of a vertex (`corners` 1), an edge (2) or a face (3) of the polytope that faces `direction`. Body frame, m.
Triple point_facing(Random& random, const Solid& solid, const Triple& direction, uint32_t corners);

/// Where two features are to come together.
struct Meeting {
  Triple displacement;      ///< of B, seen from A, over the step, m
  double time = 0;          ///< in the step or not long after it
  Triple point_a, point_b;  ///< of the features, body frames, m
  double beside = 0;        ///< m; by how much these pass each other then
};

/// Places B some way off and aims it so that a vertex of one polytope and a face of the other come together, or an edge
/// of each (`edges`), as they face each other and are turned by then. Half of them pass each other, mostly closely. Of
/// the aim it takes the scale and the gap at the start.
Meeting aim_at_feature(Random& random, Query& query, bool edges, const Aim& aim);

}  // namespace detent_queries
