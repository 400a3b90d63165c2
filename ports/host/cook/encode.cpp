#include "encode.h"

#include <math.h>
#include <string.h>

#include <algorithm>
#include <map>
#include <set>

#include "shape/hull.h"
#include "writer.h"

namespace detent_cook {
namespace {

int32_t core_radius(const std::vector<GridPoint>& vertices) {
  uint64_t greatest = 0;
  for (const GridPoint& v : vertices) {
    greatest = std::max(greatest, static_cast<uint64_t>(int64_t{v.x} * v.x + int64_t{v.y} * v.y + int64_t{v.z} * v.z));
  }
  // to within a step; the loop makes it exact
  uint64_t radius = static_cast<uint64_t>(sqrt(static_cast<double>(greatest)));
  while (radius * radius < greatest) ++radius;
  while (radius > 0 && (radius - 1) * (radius - 1) >= greatest) --radius;
  return static_cast<int32_t>(radius);
}

void put_faces(Writer& writer, const detent::HullLayout& at, const std::vector<PolygonFace>& faces) {
  uint32_t loop_at = 0, triangle_at = at.triangles;
  for (uint32_t i = 0; i < faces.size(); ++i) {
    const PolygonFace& face = faces[i];
    const uint32_t plane_at = at.planes + detent::k_hull_plane_bytes * i;
    for (uint32_t k = 0; k < 3; ++k) writer.put(plane_at + 4 * k, face.normal[k]);
    writer.put(plane_at + 12, face.offset);
    writer.put(at.loop_offsets + 2 * i, static_cast<uint16_t>(loop_at));
    for (const uint32_t vertex : face.loop) writer.put(at.loops + loop_at++, static_cast<uint8_t>(vertex));
    for (const Triangle& triangle : face.triangles) {
      for (const uint32_t vertex : triangle) writer.put(triangle_at++, static_cast<uint8_t>(vertex));
    }
  }
  writer.put(at.loop_offsets + 2 * static_cast<uint32_t>(faces.size()), static_cast<uint16_t>(loop_at));
}

void put_neighbours(Writer& writer, const detent::HullLayout& at, uint32_t vertex_count,
                    const std::vector<PolygonFace>& faces) {
  std::vector<std::set<uint32_t>> around(vertex_count);
  for (const PolygonFace& face : faces) {
    for (const Triangle& t : face.triangles) {
      for (size_t k = 0; k < 3; ++k) around[t[k]].insert(t[(k + 1) % 3]);
    }
  }
  uint32_t count = 0;
  for (uint32_t i = 0; i < vertex_count; ++i) {
    writer.put(at.neighbour_offsets + 2 * i, static_cast<uint16_t>(count));
    for (const uint32_t other : around[i]) writer.put(at.neighbours + count++, static_cast<uint8_t>(other));
  }
  writer.put(at.neighbour_offsets + 2 * vertex_count, static_cast<uint16_t>(count));
}

void put_edges(Writer& writer, const detent::HullLayout& at, const std::vector<PolygonFace>& faces) {
  std::map<std::pair<uint32_t, uint32_t>, uint16_t> face_of;
  for (size_t i = 0; i < faces.size(); ++i) {
    const std::vector<uint32_t>& loop = faces[i].loop;
    for (size_t k = 0; k < loop.size(); ++k) {
      face_of[{loop[k], loop[(k + 1) % loop.size()]}] = static_cast<uint16_t>(i);
    }
  }
  uint32_t edge_at = at.edges;
  for (const auto& [side, left] : face_of) {
    if (side.first > side.second) continue;
    writer.put(edge_at, static_cast<uint8_t>(side.first));
    writer.put(edge_at + 1, static_cast<uint8_t>(side.second));
    writer.put(edge_at + 2, left);
    writer.put(edge_at + 4, face_of[{side.second, side.first}]);
    edge_at += detent::k_hull_edge_bytes;
  }
}

}  // namespace

std::vector<uint8_t> encode_hull(const std::vector<GridPoint>& vertices, const std::vector<PolygonFace>& faces,
                                 const HullHeader& header) {
  const uint32_t vertex_count = static_cast<uint32_t>(vertices.size());
  const uint32_t face_count = static_cast<uint32_t>(faces.size());
  const uint32_t edge_count = vertex_count + face_count - 2;
  const detent::HullLayout at = detent::hull_layout(vertex_count, face_count, edge_count);
  Writer writer(at.end);

  writer.put_magic(detent::k_hull_magic, detent::k_hull_format_version);
  writer.put(detent::k_hull_exponent_at, header.exponent);
  writer.put(detent::k_hull_core_radius_at, core_radius(vertices));
  writer.put(detent::k_hull_vertex_count_at, vertex_count);
  writer.put(detent::k_hull_face_count_at, face_count);
  writer.put(detent::k_hull_edge_count_at, edge_count);
  writer.put_scaled(detent::k_hull_volume_at, header.volume);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    writer.put_scaled(detent::k_hull_inverse_inertia_at + 8 * axis, header.inverse_inertia[axis]);
    uint64_t bits;
    memcpy(&bits, &header.origin[axis], sizeof bits);
    writer.put(detent::k_hull_origin_at + 8 * axis, bits);
  }
  for (uint32_t k = 0; k < 4; ++k) writer.put(detent::k_hull_rotation_at + 4 * k, header.rotation[k]);
  writer.put(detent::k_hull_frame_at,
             static_cast<uint32_t>(header.principal ? detent::HullFrame::principal : detent::HullFrame::source));

  for (uint32_t i = 0; i < detent::hull_padded_count(vertex_count); ++i) {
    const GridPoint& v = vertices[i < vertex_count ? i : 0];
    writer.put(at.x + 4 * i, v.x);
    writer.put(at.y + 4 * i, v.y);
    writer.put(at.z + 4 * i, v.z);
  }
  put_faces(writer, at, faces);
  put_neighbours(writer, at, vertex_count, faces);
  put_edges(writer, at, faces);

  return writer.sealed();
}

}  // namespace detent_cook
