#pragma once
#include <string.h>

#include <functional>
#include <vector>

#include "ports/host/cook/cook_height_field.h"
#include "ports/host/cook/cook_mesh.h"

/// Small terrains for tests, and their cooked bytes.
namespace detent_terrains {

using Source = detent_cook::MeshSource;

/// Bytes at an address that is a multiple of 8, in an allocation of exactly their size, so that a sanitizer detects
/// reads beyond it.
class Bytes {
 public:
  explicit Bytes(const std::vector<uint8_t>& from)
      : byte_count_(static_cast<uint32_t>(from.size())), words_(from.size() / 8) {
    if (!from.empty()) memcpy(data(), from.data(), from.size());
  }
  uint8_t* data() { return reinterpret_cast<uint8_t*>(words_.data()); }
  const uint8_t* data() const { return reinterpret_cast<const uint8_t*>(words_.data()); }
  uint32_t count() const { return byte_count_; }

 private:
  uint32_t byte_count_;
  std::vector<uint64_t> words_;
};

inline Bytes cooked(const Source& source, bool one_sided = false) {
  detent_cook::MeshOptions options;
  options.one_sided = one_sided;
  return Bytes(detent_cook::cook_mesh(source, options).bytes);
}

inline uint32_t add_vertex(Source& source, double x, double y, double z) {
  source.vertices.push_back({x, y, z});
  return static_cast<uint32_t>(source.vertices.size() - 1);
}
inline void add_triangle(Source& source, uint32_t a, uint32_t b, uint32_t c, uint8_t material = 0) {
  source.triangles.push_back({{a, b, c}, material});
}

/// A mesh of n by n quadrangles of side `size`, m, about the origin, at y = height(x, z). The normals point up. The
/// diagonals alternate.
inline Source ground(uint32_t n, double size, const std::function<double(double, double)>& height) {
  Source source;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const double x = (i - n / 2.0) * size, z = (j - n / 2.0) * size;
      add_vertex(source, x, height(x, z), z);
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        add_triangle(source, a, c, d);
        add_triangle(source, a, d, b);
      } else {
        add_triangle(source, a, c, b);
        add_triangle(source, b, c, d);
      }
    }
  }
  return source;
}
inline Source plane(uint32_t n, double size) {
  return ground(n, size, [](double, double) { return 0.0; });
}

/// A box with half extents h; each side has n by n quadrangles.
inline Source box_terrain(double hx, double hy, double hz, uint32_t n) {
  Source source;
  const double h[3] = {hx, hy, hz};
  for (uint32_t side = 0; side < 6; ++side) {
    const uint32_t axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double sign = side % 2 == 0 ? 1 : -1;
    const uint32_t base = static_cast<uint32_t>(source.vertices.size());
    for (uint32_t j = 0; j <= n; ++j) {
      for (uint32_t i = 0; i <= n; ++i) {
        double at[3];
        at[axis] = sign * h[axis];
        at[u] = h[u] * (2.0 * i / n - 1);
        at[v] = h[v] * (2.0 * j / n - 1);
        add_vertex(source, at[0], at[1], at[2]);
      }
    }
    for (uint32_t j = 0; j < n; ++j) {
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = base + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        add_triangle(source, a, sign > 0 ? b : d, sign > 0 ? d : b, static_cast<uint8_t>(side));
        add_triangle(source, a, sign > 0 ? d : c, sign > 0 ? c : d, static_cast<uint8_t>(side));
      }
    }
  }
  return source;
}

/// A field of n by n cells of `size`, m, about the origin.
inline Bytes field_of(uint32_t n, double size, const std::function<double(double, double)>& height, bool one_sided) {
  detent_cook::HeightFieldSource source;
  source.columns = source.rows = n;
  source.origin = {-0.5 * n * size, 0, -0.5 * n * size};
  source.spacing_x = source.spacing_z = size;
  source.one_sided = one_sided;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) source.heights.push_back(height((i - n / 2.0) * size, (j - n / 2.0) * size));
  }
  return Bytes(detent_cook::cook_height_field(source).bytes);
}

}  // namespace detent_terrains
