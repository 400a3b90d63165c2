#include "tests/tool/cook/solids.h"

#include <math.h>
#include <string.h>

#include <algorithm>

#include "shape/hull.h"

namespace detent_cook_test {
namespace {

/// The view of a copy that is aligned; it lives as long as this.
class Reader {
 public:
  explicit Reader(const std::vector<uint8_t>& bytes) : words_(bytes.size() / 8 + 1) {
    memcpy(words_.data(), bytes.data(), bytes.size());
    hull = detent::hull_view(reinterpret_cast<const uint8_t*>(words_.data()));
  }
  detent::HullView hull;
  std::array<long double, 3> vertex(uint32_t i) const {
    const long double step = ldexpl(1, hull.exponent() - 30);
    return {hull.x(i) * step, hull.y(i) * step, hull.z(i) * step};
  }

 private:
  std::vector<uint64_t> words_;
};

}  // namespace

Cloud box_corners(double x, double y, double z) {
  Cloud cloud;
  for (int k = 0; k < 8; ++k) cloud.push_back({(k & 1) != 0 ? x : -x, (k & 2) != 0 ? y : -y, (k & 4) != 0 ? z : -z});
  return cloud;
}

Cloud tetrahedron() { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

Cloud octahedron(double radius) {
  Cloud cloud;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      cloud.push_back({});
      cloud.back()[axis] = sign * radius;
    }
  }
  return cloud;
}

Cloud icosahedron(double radius) {
  const double golden = (1 + sqrt(5)) / 2, scale = radius / sqrt(1 + golden * golden);
  Cloud cloud;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double one : {-scale, scale}) {
      for (const double other : {-scale * golden, scale * golden}) {
        cloud.push_back({});
        cloud.back()[axis] = one;
        cloud.back()[(axis + 1) % 3] = other;
      }
    }
  }
  return cloud;
}

Cloud prism(int sides, double radius, double half_length) {
  Cloud cloud;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / sides;
    for (const double z : {-half_length, half_length}) cloud.push_back({radius * cos(angle), radius * sin(angle), z});
  }
  return cloud;
}

Cloud ellipsoid(Random& random, int count, double x, double y, double z) {
  Cloud cloud;
  while (static_cast<int>(cloud.size()) < count) {
    const double a = random.uniform(-1, 1), b = random.uniform(-1, 1), c = random.uniform(-1, 1);
    const double length = sqrt(a * a + b * b + c * c);
    if (length > 0.1 && length < 1) cloud.push_back({x * a / length, y * b / length, z * c / length});
  }
  return cloud;
}

Cloud placed(const Cloud& cloud, const std::array<double, 4>& rotation, const std::array<double, 3>& translation) {
  const auto [x, y, z, w] = rotation;
  const double s = 2 / (x * x + y * y + z * z + w * w);
  Cloud result;
  for (const auto& p : cloud) {
    result.push_back({(1 - s * (y * y + z * z)) * p[0] + s * (x * y - w * z) * p[1] + s * (z * x + w * y) * p[2],
                      s * (x * y + w * z) * p[0] + (1 - s * (z * z + x * x)) * p[1] + s * (y * z - w * x) * p[2],
                      s * (z * x - w * y) * p[0] + s * (y * z + w * x) * p[1] + (1 - s * (x * x + y * y)) * p[2]});
    for (size_t k = 0; k < 3; ++k) result.back()[k] += translation[k];
  }
  return result;
}

Cloud shuffled(Random& random, Cloud cloud) {
  for (size_t i = cloud.size(); i > 1; --i) std::swap(cloud[i - 1], cloud[static_cast<size_t>(random.bits() % i)]);
  return cloud;
}

Integrals integrals_of(const std::vector<uint8_t>& bytes) {
  const Reader reader(bytes);
  Integrals result;
  std::array<long double, 3> first{}, square{}, mixed{};
  for (uint32_t face = 0; face < reader.hull.face_count; ++face) {
    const detent::HullIndices triangles = reader.hull.triangles(face);
    for (uint32_t t = 0; t < triangles.count; t += 3) {
      const auto a = reader.vertex(triangles.index[t]), b = reader.vertex(triangles.index[t + 1]),
                 c = reader.vertex(triangles.index[t + 2]);
      // Over a triangle, a polynomial of degree 2 is the mean of its values at the middles of the sides; of degree 3,
      // this rule of four points (Strang, Fix 1973): (25 at the points (3, 1, 1) / 5, less 27 at the centroid) / 48.
      const std::array<long double, 3> normal = {((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])) / 2,
                                                 ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])) / 2,
                                                 ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2};
      const long double weights[4][4] = {{1 / 3.0L, 1 / 3.0L, 1 / 3.0L, -27 / 48.0L},
                                         {0.6L, 0.2L, 0.2L, 25 / 48.0L},
                                         {0.2L, 0.6L, 0.2L, 25 / 48.0L},
                                         {0.2L, 0.2L, 0.6L, 25 / 48.0L}};
      for (const auto& weight : weights) {
        std::array<long double, 3> p;
        for (size_t i = 0; i < 3; ++i) p[i] = weight[0] * a[i] + weight[1] * b[i] + weight[2] * c[i];
        result.volume += weight[3] * p[0] * normal[0];
        for (size_t i = 0; i < 3; ++i) {
          const size_t j = (i + 1) % 3, k = (i + 2) % 3;
          first[i] += weight[3] * p[i] * p[i] / 2 * normal[i];
          square[i] += weight[3] * p[i] * p[i] * p[i] / 3 * normal[i];
          mixed[i] += weight[3] * p[j] * p[j] / 2 * p[k] * normal[j];
        }
      }
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    result.centre[i] = first[i] / result.volume;
    result.inertia[i] = (square[(i + 1) % 3] + square[(i + 2) % 3]) / result.volume;
    result.products[i] = mixed[i] / result.volume;
  }
  return result;
}

std::array<double, 3> stored_inertia(const std::vector<uint8_t>& bytes) {
  const Reader reader(bytes);
  std::array<double, 3> inertia;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const detent::HullScaled inverse_inertia = reader.hull.inverse_inertia(axis);
    inertia[axis] = ldexp(1.0 / inverse_inertia.mantissa, 2 * reader.hull.exponent() - inverse_inertia.exponent);
  }
  return inertia;
}

double stored_volume(const std::vector<uint8_t>& bytes) {
  const Reader reader(bytes);
  return ldexp(reader.hull.volume().mantissa, reader.hull.volume().exponent + 3 * reader.hull.exponent());
}

Cloud source_vertices(const std::vector<uint8_t>& bytes) {
  const Reader reader(bytes);
  detent::HullInfo info;
  if (detent::hull_info({reader.hull.bytes, static_cast<uint32_t>(bytes.size())}, info) != detent::Status::ok)
    return {};
  Cloud local;
  for (uint32_t i = 0; i < reader.hull.vertex_count; ++i) {
    const auto v = reader.vertex(i);
    local.push_back({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
  }
  std::array<double, 4> rotation;
  for (size_t k = 0; k < 4; ++k) rotation[k] = info.rotation[k];
  return placed(local, rotation, {info.origin[0], info.origin[1], info.origin[2]});
}

std::vector<size_t> face_sizes(const std::vector<uint8_t>& bytes) {
  const Reader reader(bytes);
  std::vector<size_t> sizes;
  for (uint32_t i = 0; i < reader.hull.face_count; ++i) sizes.push_back(reader.hull.face(i).count);
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

}  // namespace detent_cook_test
