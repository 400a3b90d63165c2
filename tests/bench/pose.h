#pragma once
#include <math.h>

#include "tests/common/queries/triple.h"

/// Poses along a path, for engines that take a start and an end instead of a turn.
namespace detent_bench {

using detent_queries::Path;
using detent_queries::Query;
using detent_queries::Rotation;
using detent_queries::Triple;

struct PoseAt {
  Triple position;
  Rotation rotation;  ///< of length 1
};

/// The rotation b, then a.
inline Rotation product(const Rotation& a, const Rotation& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

inline PoseAt pose_at(const Path& path, double time) {
  using namespace detent_queries;
  PoseAt pose = {path.position + path.displacement * time, path.rotation};
  const double angle = length(path.rotation_vector) * time;
  if (angle != 0) {
    const Triple v = path.rotation_vector * (time * sin(angle / 2) / angle);
    pose.rotation = product({v[0], v[1], v[2], cos(angle / 2)}, path.rotation);
  }
  double square = 0;
  for (const double component : pose.rotation) square += component * component;
  for (double& component : pose.rotation) component /= sqrt(square);
  return pose;
}

/// The larger turn of the two, rad.
inline double turn_of(const Query& query) {
  return fmax(detent_queries::length(query.path_a.rotation_vector),
              detent_queries::length(query.path_b.rotation_vector));
}

}  // namespace detent_bench
