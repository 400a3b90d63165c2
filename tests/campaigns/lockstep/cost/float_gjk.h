#pragma once
#include <stdint.h>

/// The distance of two convex shapes by the textbook method in single precision, as a port of a common engine to a
/// processor without floating point would compute it.
namespace float_gjk {

struct Vector {
  float x, y, z;
};

struct Solid {
  bool is_box = true;
  Vector half_extents = {};          ///< m; box
  const Vector* vertices = nullptr;  ///< m; otherwise
  uint32_t vertex_count = 0;
  const uint16_t* neighbour_offsets =
      /// If not null, supports use hill climbing: vertex_count + 1 offsets into `neighbours`.
      nullptr;
  const uint8_t* neighbours = nullptr;
};

struct Pose {
  Vector position;   ///< m
  float x, y, z, w;  ///< a unit quaternion
};

struct Result {
  float distance;  ///< m; 0 if the solids overlap
  Vector point_a, point_b;
  uint32_t iterations;
};

/// Source: Gilbert, Johnson, Keerthi 1988; nearest points of triangles and tetrahedra after Ericson, "Real-Time
/// Collision Detection", 2005, 5.1.5 and 5.1.6.
Result distance(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b);

}  // namespace float_gjk
