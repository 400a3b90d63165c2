#pragma once
#include <array>
#include <vector>

/// A query between two convex shapes as every engine, the oracle and the generators see it: plain doubles.
namespace detent_queries {

using Triple = std::array<double, 3>;

enum class Kind { sphere, capsule, box, cylinder, cone, hull, triangle, half_space };

/// Centred as the library's shapes (include/detent/shape.h): axes along y; the cone's base at y = -half_length / 2 and
/// its apex at y = 3 half_length / 2; the half-space is y <= 0.
struct Solid {
  Kind kind = Kind::sphere;
  double radius = 0;             ///< m; sphere, capsule, cylinder, cone
  double half_length = 0;        ///< m; capsule, cylinder, cone
  Triple half_extents = {};      ///< m; box
  double rounding = 0;           ///< m; box, cylinder, cone, hull, triangle: grown by a ball
  std::vector<Triple> points{};  ///< m; the vertices of a hull (all of them extreme) or a triangle
};

/// Over a step of length 1: position(t) = position + t displacement, rotation(t) = exp(t turn) rotation.
/// Every number is exactly a float; the rotation (x, y, z, w) is of length 1 to float's precision, to be normalised.
struct Path {
  Triple position = {};
  std::array<double, 4> rotation = {0, 0, 0, 1};
  Triple displacement = {};
  Triple rotation_vector = {};  ///< rad, world axes
};

struct Query {
  Solid a, b;
  Path path_a, path_b;
};

}  // namespace detent_queries
