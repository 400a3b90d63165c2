#pragma once
#include <stddef.h>
#include <stdint.h>

#include <array>
#include <vector>

#include "tests/common/support/random.h"

/// Clouds of points with known properties, and what the cooked bytes say of themselves.
namespace detent_cook_test {

using Cloud = std::vector<std::array<double, 3>>;

struct Random {
  uint64_t state;
  uint64_t bits() { return detent_test::split_mix(state); }
  double uniform(double from, double to) { return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
};

Cloud box_corners(double x, double y, double z);  ///< half extents
Cloud tetrahedron();                              ///< the origin and one point on each axis
Cloud octahedron(double radius);
Cloud icosahedron(double radius);
/// A regular polygon of the given radius about z, at z = +-half_length.
Cloud prism(int sides, double radius, double half_length);
/// Points on an ellipsoid, to double's rounding.
Cloud ellipsoid(Random& random, int count, double x, double y, double z);
/// Turned by the unit quaternion nearest to (x, y, z, w), then moved.
Cloud placed(const Cloud& cloud, const std::array<double, 4>& rotation, const std::array<double, 3>& translation);
Cloud shuffled(Random& random, Cloud cloud);

/// Of the cooked bytes, read anew and by other formulae than the cook's: by the divergence theorem about the origin.
struct Integrals {
  long double volume = 0;                 ///< m^3
  std::array<long double, 3> centre{};    ///< m, in the hull's frame
  std::array<long double, 3> inertia{};   ///< about the hull's axes through the origin, over the volume, m^2
  std::array<long double, 3> products{};  ///< mean of y z, z x, x y, m^2
};
Integrals integrals_of(const std::vector<uint8_t>& bytes);

/// unit^2 over the inverse inertia in the bytes, m^2: the inertia over the mass.
std::array<double, 3> stored_inertia(const std::vector<uint8_t>& bytes);
double stored_volume(const std::vector<uint8_t>& bytes);

/// The vertices in the source's frame, m.
Cloud source_vertices(const std::vector<uint8_t>& bytes);
/// Corners of each face, ascending.
std::vector<size_t> face_sizes(const std::vector<uint8_t>& bytes);

}  // namespace detent_cook_test
