#include "cook_mesh.h"

#include <math.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "shape/mesh.h"
#include "writer.h"

namespace detent_cook {
namespace {

using detent::Vec32;

constexpr double k_extent_max = 16384;  // m
constexpr uint32_t k_none = UINT32_MAX;

struct Face {
  std::array<uint32_t, 3> vertex;
  uint8_t material;
};

struct GridMesh {
  int exponent = 0;
  std::vector<Vec32> vertices{};
  std::vector<Face> faces{};
};

std::array<int32_t, 3> key_of(const Vec32& v) { return {v.x, v.y, v.z}; }

std::string reason_against(const MeshSource& source, const MeshOptions& options) {
  if (!(options.weld >= 0) || options.weld > k_extent_max) return "the weld tolerance is no distance";
  for (size_t i = 0; i < source.vertices.size(); ++i) {
    for (const double value : source.vertices[i]) {
      if (!isfinite(value)) return "vertex " + std::to_string(i + 1) + " has a coordinate that is not a finite number";
      if (fabs(value) >= k_extent_max) return "vertex " + std::to_string(i + 1) + " lies 16 km or more from the origin";
    }
  }
  if (source.triangles.empty()) return "there are no triangles";
  if (source.vertices.size() > 0xffffffffu / 2) return "there are too many vertices";
  for (size_t i = 0; i < source.triangles.size(); ++i) {
    for (const uint32_t vertex : source.triangles[i].vertex) {
      if (vertex >= source.vertices.size())
        return "triangle " + std::to_string(i + 1) + " names a vertex that is missing";
    }
  }
  return {};
}

/// Puts the vertices on the grid of the least power of two above all coordinates.
void round_vertices(const MeshSource& source, GridMesh& mesh) {
  double greatest = 0;
  for (const Point& p : source.vertices) {
    for (const double value : p) greatest = std::max(greatest, fabs(value));
  }
  frexp(greatest, &mesh.exponent);
  mesh.exponent = std::max(mesh.exponent, int{detent::k_terrain_exponent_min});
  for (const Point& p : source.vertices) {
    std::array<int32_t, 3> v;
    for (size_t k = 0; k < 3; ++k) {
      const double steps = floor(ldexp(p[k], 30 - mesh.exponent) + 0.5);
      constexpr double k_most = detent::k_terrain_coordinate_max;
      // a value may round up to the unit itself
      v[k] = static_cast<int32_t>(std::min(std::max(steps, -k_most), k_most));
    }
    mesh.vertices.push_back({v[0], v[1], v[2]});
  }
}

/// For each vertex, gives the vertex that replaces it. Visits the vertices in ascending order; a vertex is replaced by
/// the least vertex within `weld` steps that was kept before.
std::vector<uint32_t> welded_to(const std::vector<Vec32>& vertices, double weld) {
  std::vector<uint32_t> order(vertices.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::make_tuple(key_of(vertices[a]), a) < std::make_tuple(key_of(vertices[b]), b);
  });
  const double size = std::max(weld, 1.0);
  const auto cell_of = [&](const Vec32& v) {
    return std::array<int64_t, 3>{static_cast<int64_t>(floor(v.x / size)), static_cast<int64_t>(floor(v.y / size)),
                                  static_cast<int64_t>(floor(v.z / size))};
  };
  std::map<std::array<int64_t, 3>, std::vector<uint32_t>> kept;
  std::vector<uint32_t> result(vertices.size());
  uint32_t last = k_none;
  for (const uint32_t i : order) {
    const Vec32& v = vertices[i];
    result[i] = i;
    if (last != k_none && vertices[last] == v) {
      result[i] = result[last];
      continue;
    }
    last = i;
    if (!(weld > 0)) continue;
    const std::array<int64_t, 3> cell = cell_of(v);
    uint32_t found = k_none;
    for (int n = 0; n < 27 && found == k_none; ++n) {
      const auto near = kept.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      if (near == kept.end()) continue;
      for (const uint32_t other : near->second) {
        const Vec32& w = vertices[other];
        const double x = double{v.x * 1.0} - w.x, y = double{v.y * 1.0} - w.y, z = double{v.z * 1.0} - w.z;
        if (x * x + y * y + z * z > weld * weld) continue;
        found = other;
        break;
      }
    }
    if (found == k_none)
      kept[cell].push_back(i);
    else
      result[i] = found;
  }
  return result;
}

/// Takes the faces, except faces without area and repeated faces. `mesh.vertices` still contains unused vertices.
void take_faces(const MeshSource& source, const std::vector<uint32_t>& becomes, GridMesh& mesh, MeshResult& result) {
  std::map<std::array<uint32_t, 3>, bool> seen;
  for (const MeshSource::Triangle& triangle : source.triangles) {
    std::array<uint32_t, 3> v;
    for (size_t k = 0; k < 3; ++k) v[k] = becomes[triangle.vertex[k]];
    const std::vector<Vec32>& at = mesh.vertices;
    if (is_zero(detent::area_vector(at[v[0]], at[v[1]], at[v[2]]))) {
      ++result.degenerate;
      continue;
    }
    std::array<uint32_t, 3> turned = v;
    std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    if (!seen.emplace(turned, true).second) {
      ++result.repeated;
      continue;
    }
    mesh.faces.push_back({v, triangle.material});
  }
}

/// Numbers the used vertices in ascending order.
void renumber(GridMesh& mesh) {
  std::map<std::array<int32_t, 3>, uint32_t> number;
  for (const Face& face : mesh.faces) {
    for (const uint32_t v : face.vertex) number[key_of(mesh.vertices[v])] = 0;
  }
  std::vector<Vec32> used;
  for (auto& [at, i] : number) {
    i = static_cast<uint32_t>(used.size());
    used.push_back({at[0], at[1], at[2]});
  }
  for (Face& face : mesh.faces) {
    for (uint32_t& v : face.vertex) v = number[key_of(mesh.vertices[v])];
  }
  mesh.vertices = used;
}

/// Orders the faces for the tree. The triangles of each node are divided into halves along the axis on which their
/// centres extend furthest.
class Orderer {
 public:
  Orderer(GridMesh& mesh, const CookProgress& progress) : mesh_(mesh), progress_(progress) {
    for (const Face& face : mesh.faces) {
      std::array<int64_t, 3> sum{};
      for (const uint32_t v : face.vertex) {
        const std::array<int32_t, 3> at = key_of(mesh.vertices[v]);
        for (size_t k = 0; k < 3; ++k) sum[k] += at[k];
      }
      centre_.push_back(sum);
    }
    for (uint32_t i = 0; i < mesh.faces.size(); ++i) order_.push_back(i);
  }
  void order() {
    constexpr uint32_t k_leaf = detent::k_mesh_leaf_triangles;
    uint32_t span = k_leaf;
    while (span < order_.size()) span *= 2;
    split(0, static_cast<uint32_t>(order_.size()), span);
    std::vector<Face> faces;
    for (const uint32_t i : order_) faces.push_back(mesh_.faces[i]);
    mesh_.faces = faces;
  }

 private:
  /// `span`: triangles in a full node of this level.
  void split(uint32_t from, uint32_t to, uint32_t span) {
    if (span <= detent::k_mesh_leaf_triangles) {
      std::sort(order_.data() + from, order_.data() + to);
      if (progress_ != nullptr && from % 4096 == 0) progress_(from, order_.size());
      return;
    }
    if (to - from > span / 2) {
      const size_t axis = widest(from, to);
      const auto before = [&](uint32_t a, uint32_t b) {
        return std::make_pair(centre_[a][axis], a) < std::make_pair(centre_[b][axis], b);
      };
      std::sort(order_.data() + from, order_.data() + to, before);
      split(from + span / 2, to, span / 2);
      to = from + span / 2;
    }
    split(from, to, span / 2);
  }
  size_t widest(uint32_t from, uint32_t to) const {
    std::array<int64_t, 3> low = centre_[order_[from]], high = low;
    for (uint32_t i = from; i < to; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], centre_[order_[i]][k]);
        high[k] = std::max(high[k], centre_[order_[i]][k]);
      }
    }
    size_t axis = 0;
    for (size_t k = 1; k < 3; ++k) axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
    return axis;
  }

  GridMesh& mesh_;
  const CookProgress& progress_;
  std::vector<std::array<int64_t, 3>> centre_{};
  std::vector<uint32_t> order_{};
};

/// The direction in which a face passes along an edge.
struct Passage {
  uint32_t low, high;  ///< vertices
  bool forward;
  uint32_t face, edge;
};

void put_triangles(const GridMesh& mesh, const detent::MeshView& view, Writer& writer, MeshResult& result) {
  std::vector<Passage> passages;
  for (uint32_t i = 0; i < mesh.faces.size(); ++i) {
    const std::array<uint32_t, 3>& v = mesh.faces[i].vertex;
    const uint32_t at = view.triangles_at + detent::k_mesh_triangle_bytes * i;
    for (uint32_t k = 0; k < 3; ++k) {
      writer.put(at + 4 * k, v[k] | (k == 0 ? uint32_t{mesh.faces[i].material} << 24 : 0));
      writer.put(at + 12 + 4 * k,
                 detent::k_mesh_index_mask | uint32_t{static_cast<uint8_t>(detent::EdgeKind::open)} << 24);
      const uint32_t next = v[(k + 1) % 3];
      passages.push_back({std::min(v[k], next), std::max(v[k], next), v[k] < next, i, k});
    }
  }
  std::sort(passages.begin(), passages.end(), [](const Passage& a, const Passage& b) {
    return std::make_tuple(a.low, a.high, a.face, a.edge) < std::make_tuple(b.low, b.high, b.face, b.edge);
  });
  const auto corner = [&](const Passage& p, uint32_t more) {
    return mesh.vertices[mesh.faces[p.face].vertex[(p.edge + more) % 3]];
  };
  const auto put_neighbour = [&](const Passage& p, const Passage& other) {
    const detent::EdgeKind kind = detent::edge_kind(corner(p, 0), corner(p, 1), corner(p, 2), corner(other, 2));
    writer.put(view.triangles_at + detent::k_mesh_triangle_bytes * p.face + 12 + 4 * p.edge,
               other.face | uint32_t{static_cast<uint8_t>(kind)} << 24);
  };
  for (size_t from = 0, to = 0; from < passages.size(); from = to) {
    while (to < passages.size() && passages[to].low == passages[from].low && passages[to].high == passages[from].high)
      ++to;
    if (to - from == 2 && passages[from].forward != passages[from + 1].forward) {
      put_neighbour(passages[from], passages[from + 1]);
      put_neighbour(passages[from + 1], passages[from]);
    } else {
      ++result.open_edges;
      if (to - from > 1) ++result.forked_edges;
    }
  }
}

/// Writes the nodes from the leaves up. Each written node is read back to compute its parent.
void put_nodes(const detent::MeshView& view, Writer& writer) {
  for (uint32_t level = 0; level < view.level_count; ++level) {
    for (uint32_t i = 0; i < view.level_size(level); ++i) {
      uint16_t node[6];
      detent::mesh_node(view, level, i, node);
      const uint32_t at = view.nodes_at + detent::k_mesh_node_bytes * (view.level_start[level] + i);
      for (uint32_t k = 0; k < 6; ++k) writer.put(at + 2 * k, node[k]);
    }
  }
}

std::vector<uint8_t> encode(const GridMesh& mesh, bool one_sided, MeshResult& result) {
  Vec32 low = mesh.vertices[0], high = low;
  detent::GridBox box = {low, high};
  for (const Vec32& v : mesh.vertices) include(v, box);
  low = box.low;
  const Vec32 size = detent::subtract(box.high, box.low);
  uint32_t shift = 0;
  while (((size.x | size.y | size.z) >> shift) >= 1 << 16) ++shift;

  const auto put_header = [&](Writer& writer) {
    writer.put_magic(detent::k_mesh_magic, detent::k_mesh_format_version);
    writer.put(detent::k_mesh_exponent_at, int32_t{mesh.exponent});
    writer.put(detent::k_mesh_vertex_count_at, static_cast<uint32_t>(mesh.vertices.size()));
    writer.put(detent::k_mesh_triangle_count_at, static_cast<uint32_t>(mesh.faces.size()));
    writer.put(detent::k_mesh_flags_at, one_sided ? detent::k_mesh_one_sided : 0u);
    writer.put(detent::k_mesh_low_at, low.x);
    writer.put(detent::k_mesh_low_at + 4, low.y);
    writer.put(detent::k_mesh_low_at + 8, low.z);
    writer.put(detent::k_mesh_shift_at, shift);
  };
  Writer header(detent::k_mesh_header_bytes);
  put_header(header);
  Writer writer(detent::mesh_view(header.data()).end);
  put_header(writer);
  const detent::MeshView view = detent::mesh_view(writer.data());
  for (uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const std::array<int32_t, 3> v = key_of(mesh.vertices[i]);
    for (uint32_t k = 0; k < 3; ++k) writer.put(view.vertices_at + detent::k_mesh_vertex_bytes * i + 4 * k, v[k]);
  }
  put_triangles(mesh, view, writer, result);
  put_nodes(view, writer);
  return writer.sealed();
}

}  // namespace

MeshResult cook_mesh(const MeshSource& source, const MeshOptions& options, const CookProgress& progress) {
  MeshResult result;
  result.reason = reason_against(source, options);
  if (!result.reason.empty()) return result;
  GridMesh mesh;
  round_vertices(source, mesh);
  result.step = ldexp(1.0, mesh.exponent - 30);
  const std::vector<uint32_t> becomes = welded_to(mesh.vertices, options.weld / result.step);
  for (uint32_t i = 0; i < becomes.size(); ++i) result.welded += becomes[i] != i ? 1u : 0u;
  take_faces(source, becomes, mesh, result);
  if (mesh.faces.empty()) {
    result.reason = "all triangles are degenerate";
    return result;
  }
  if (mesh.faces.size() > detent::k_mesh_triangles_max) {
    result.reason = "there are " + std::to_string(mesh.faces.size()) + " triangles; at most " +
                    std::to_string(detent::k_mesh_triangles_max) + " are possible";
    return result;
  }
  renumber(mesh);
  Orderer(mesh, progress).order();
  result.bytes = encode(mesh, options.one_sided, result);
  result.vertex_count = static_cast<uint32_t>(mesh.vertices.size());
  result.triangle_count = static_cast<uint32_t>(mesh.faces.size());
  return result;
}

}  // namespace detent_cook
