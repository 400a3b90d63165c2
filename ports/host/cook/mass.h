#pragma once
#include "exact_hull.h"

namespace detent_cook {

/// Moments of a solid of density 1. The points are in steps of 2^-30 of a unit of length, the results in that unit.
struct Moments {
  double volume = 0;
  std::array<double, 3> centre{};  ///< centre of mass
  /// Second moments about the centre, divided by the volume: xx, yy, zz, xy, yz, zx.
  std::array<double, 6> second{};
};

/// A rotation as integers, in 2^-30: x, y, z, w.
using GridRotation = std::array<int32_t, 4>;
/// Rows of a rotation matrix.
using Matrix = std::array<std::array<double, 3>, 3>;

inline constexpr GridRotation k_no_rotation = {0, 0, 0, 1 << 30};

/// Integrates over the hull, divided into tetrahedra that share one vertex of the hull. The volume of no tetrahedron is
/// negative, so no sum cancels: the volume and the second moments about that vertex have a relative error of 2^-44. The
/// shift to the centre costs at most 4 bits more along a principal axis. The determinants are exact integers.
Moments moments(const std::vector<GridPoint>& points, const ExactHull& hull);

/// The rotation from the principal axes to the source axes. Of all such rotations it is the nearest to the identity.
/// Products of inertia below 2^-22 of the geometric mean of their moments count as 0, so that a cube whose vertices are
/// floats keeps its axes.
/// Source: Jacobi's method; Golub, Van Loan, Matrix Computations, 8.5.
Matrix principal_axes(const std::array<double, 6>& second);

Matrix product(const Matrix& a, const Matrix& b);
/// The nearest rotation in integers, with w >= 0.
GridRotation rotation_from(const Matrix& matrix);
Matrix matrix_from(const GridRotation& rotation);

}  // namespace detent_cook
