#include "tests/common/queries/place.h"

#include "tests/common/queries/gap.h"
#include "tests/common/queries/solids.h"

namespace detent_queries {

namespace {

/// Rounds the positions to floats with the difference kept to about 1e-14: B's holds what A's cannot.
void round_positions(Query& query) {
  const Triple apart = query.path_a.position - query.path_b.position;
  query.path_a.position = to_float(apart);
  query.path_b.position = to_float(query.path_a.position - apart);
}

}  // namespace

Query at_one_place(Random& random, const Solid& a, const Solid& b, double scale) {
  Query query;
  query.a = a;
  query.b = b;
  for (double& coordinate : query.path_a.position) coordinate = to_float(random.uniform(-1, 1) * scale);
  query.path_b.position = query.path_a.position;
  query.path_a.rotation = random.rotation();
  query.path_b.rotation = random.rotation();
  return query;
}

void angular_velocity(Random& random, Query& query, double angle_min, double angle_max) {
  for (Path* path : {&query.path_a, &query.path_b})
    path->rotation_vector = to_float(random.direction() * random.uniform(angle_min, angle_max));
}

void share_motion(Random& random, Query& query, const Triple& relative, double common) {
  const Triple both = random.direction() * (common * random.uniform(0, 1));
  const double part = random.uniform(0, 1);
  query.path_a.displacement = to_float(both - relative * part);
  query.path_b.displacement = to_float(both + relative * (1 - part));
}

void send(Random& random, Query& query, const Aim& aim) {
  const double bounds = bound_of(query.a) + bound_of(query.b);
  Triple apart;
  if (aim.far != 0) {
    for (double& coordinate : query.path_a.position) coordinate = to_float(coordinate + random.sign() * aim.far);
  }
  do {  // far from the origin a float may not hold so small a step
    const double gap = aim.scale * random.uniform(aim.gap_min, aim.gap_max);
    query.path_b.position = to_float(query.path_a.position + random.direction() * (bounds + gap));
    apart = query.path_b.position - query.path_a.position;
  } while (length(apart) <= bounds);
  const Triple passing = random.perpendicular(apart) * (bounds * random.uniform(0, aim.lateral_max));
  share_motion(random, query, (passing - apart) * random.uniform(0.6, 1.6), 0.5 * aim.scale);
}

bool place_at_gap(Query& query, const Triple& direction, double gap) {
  const Triple centre = query.path_a.position;
  const double bounds = bound_of(query.a) + bound_of(query.b);
  double low = 0, high = bounds + gap;
  for (int i = 0; i < 60 && high - low > 1e-9 * gap; ++i) {
    const double middle = (low + high) / 2;
    query.path_b.position = centre + direction * middle;
    (gap_at(query, 0) < gap ? low : high) = middle;
  }
  query.path_b.position = centre + direction * high;
  round_positions(query);
  return fabs(gap_at(query, 0) / gap - 1) < 0.1;
}

bool graze(Query& query, double gap) {
  const double goal = fabs(gap);
  const double start_min = 0.01 * (bound_of(query.a) + bound_of(query.b));
  const auto moved = [&query](const Triple& by) { query.path_b.position = query.path_b.position + by; };
  for (int round = 0; round < 8; ++round) {
    const Approach approach = closest_approach(query);
    if (approach.gap <= 0 || approach.time < 0.02) return false;
    const Triple normal = gap_normal(query, approach.time);
    if (fabs(approach.gap - goal) > 0.05 * goal) {
      // Not all the way at once: beyond the goal, where they overlap, there is no normal.
      moved(normal * (approach.gap > 4 * goal ? 0.9 * (goal - approach.gap) : goal - approach.gap));
      continue;
    }
    if (gap < 0) moved(normal * (-2 * goal));
    round_positions(query);
    return fabs(closest_approach(query).gap / gap - 1) < 0.2 && gap_at(query, 0) > start_min;
  }
  return false;
}

}  // namespace detent_queries
