#include "mass.h"

#include <math.h>

#include <utility>

#include "integers.h"

namespace detent_cook {
namespace {

constexpr double k_product_least = 0x1p-22;
constexpr double k_one = 0x1p30;

}  // namespace

Moments moments(const std::vector<GridPoint>& points, const ExactHull& hull) {
  const GridPoint& apex = points[hull.vertices[0]];
  double volume = 0;  // times 6 2^90
  std::array<double, 3> first{};
  std::array<double, 6> second{};
  for (const Triangle& triangle : hull.triangles) {
    std::array<std::array<double, 3>, 3> corner;  // from the apex
    for (size_t k = 0; k < 3; ++k) {
      const GridPoint& p = points[triangle[k]];
      corner[k] = {static_cast<double>(int64_t{p.x} - apex.x), static_cast<double>(int64_t{p.y} - apex.y),
                   static_cast<double>(int64_t{p.z} - apex.z)};
    }
    const GridPoint& a = points[triangle[0]];
    const auto normal = area_normal(a, points[triangle[1]], points[triangle[2]]);
    const double determinant = to_double(Int128::product(normal[0], int64_t{a.x} - apex.x) +
                                         Int128::product(normal[1], int64_t{a.y} - apex.y) +
                                         Int128::product(normal[2], int64_t{a.z} - apex.z));
    volume += determinant;
    std::array<double, 3> sum;
    for (size_t i = 0; i < 3; ++i) {
      sum[i] = corner[0][i] + corner[1][i] + corner[2][i];
      first[i] += determinant * sum[i];
    }
    constexpr size_t k_pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    for (size_t m = 0; m < 6; ++m) {
      const auto [i, j] = k_pairs[m];
      double product = sum[i] * sum[j];
      for (size_t k = 0; k < 3; ++k) product += corner[k][i] * corner[k][j];
      second[m] += determinant * product;
    }
  }
  // Moments of a tetrahedron with one corner at the origin: its volume is determinant / 6, the mean of x is sum / 4,
  // and the mean of x y is (sum_x sum_y + x_0 y_0 + x_1 y_1 + x_2 y_2) / 20.
  Moments result;
  result.volume = volume / 6 * 0x1p-90;
  const std::array<double, 3> mean = {first[0] / volume / 4, first[1] / volume / 4, first[2] / volume / 4};
  result.centre = {(mean[0] + apex.x) / k_one, (mean[1] + apex.y) / k_one, (mean[2] + apex.z) / k_one};
  const std::array<double, 6> shift = {mean[0] * mean[0], mean[1] * mean[1], mean[2] * mean[2],
                                       mean[0] * mean[1], mean[1] * mean[2], mean[2] * mean[0]};
  for (size_t m = 0; m < 6; ++m) result.second[m] = (second[m] / volume / 20 - shift[m]) / (k_one * k_one);
  return result;
}

Matrix principal_axes(const std::array<double, 6>& second) {
  Matrix a = {
      {{second[0], second[3], second[5]}, {second[3], second[1], second[4]}, {second[5], second[4], second[2]}}};
  Matrix axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int k_sweeps_max = 32;  // Jacobi's method converges quadratically, in about 5 sweeps
  constexpr size_t k_planes[3][2] = {{0, 1}, {1, 2}, {0, 2}};
  bool turned = true;
  for (int sweep = 0; sweep < k_sweeps_max && turned; ++sweep) {
    turned = false;
    for (const auto& [p, q] : k_planes) {
      if (!(fabs(a[p][q]) > k_product_least * sqrt(fabs(a[p][p] * a[q][q])))) continue;
      turned = true;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double tangent = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));  // at most 45 degrees
      const double cosine = 1 / sqrt(tangent * tangent + 1), sine = tangent * cosine;
      for (size_t k = 0; k < 3; ++k) {  // a = a r
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = cosine * kp - sine * kq;
        a[k][q] = sine * kp + cosine * kq;
      }
      for (size_t k = 0; k < 3; ++k) {  // a = r* a
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = cosine * pk - sine * qk;
        a[q][k] = sine * pk + cosine * qk;
      }
      a[p][q] = a[q][p] = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double kp = axes[k][p], kq = axes[k][q];
        axes[k][p] = cosine * kp - sine * kq;
        axes[k][q] = sine * kp + cosine * kq;
      }
    }
  }
  return axes;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  }
  return result;
}

GridRotation rotation_from(const Matrix& m) {
  // Four times each quaternion component squared; the greatest is at least 1.
  const std::array<double, 4> four = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                                      1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
  size_t greatest = 3;
  for (size_t k = 0; k < 3; ++k) {
    if (four[k] > four[greatest]) greatest = k;
  }
  std::array<double, 4> q{};
  switch (greatest) {
    case 0:
      q = {four[0], m[0][1] + m[1][0], m[2][0] + m[0][2], m[2][1] - m[1][2]};
      break;
    case 1:
      q = {m[0][1] + m[1][0], four[1], m[1][2] + m[2][1], m[0][2] - m[2][0]};
      break;
    case 2:
      q = {m[2][0] + m[0][2], m[1][2] + m[2][1], four[2], m[1][0] - m[0][1]};
      break;
    default:
      q = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], four[3]};
  }
  double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (q[3] < 0) length = -length;
  GridRotation rotation;
  for (size_t k = 0; k < 4; ++k) rotation[k] = static_cast<int32_t>(floor(q[k] / length * k_one + 0.5));
  return rotation;
}

Matrix matrix_from(const GridRotation& rotation) {
  std::array<double, 4> q;
  double square = 0;
  for (size_t k = 0; k < 4; ++k) {
    q[k] = rotation[k];
    square += q[k] * q[k];
  }
  const double s = 2 / square;
  const auto [x, y, z, w] = q;
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (z * x + w * y)},
           {s * (x * y + w * z), 1 - s * (z * z + x * x), s * (y * z - w * x)},
           {s * (z * x - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

}  // namespace detent_cook
