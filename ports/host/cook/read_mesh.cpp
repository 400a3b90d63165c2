#include "read_mesh.h"

#include <map>

#include "read_points.h"
#include "words.h"

namespace detent_cook {
namespace {

bool ends_with(const std::string& path, std::string_view end) {
  return path.size() >= end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
}

std::string read_face(std::string_view& line, uint8_t material, MeshSource& mesh) {
  std::vector<uint32_t> corners;
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    uint32_t index = 0;
    if (!index_from(word, mesh.vertices.size(), index)) return quoted(word) + " names no vertex before this line";
    corners.push_back(index);
    if (mesh.triangles.size() + corners.size() > k_mesh_source_max + 2) return "more triangles than can be cooked";
  }
  if (corners.size() < 3) return "a face needs three vertices";
  for (size_t k = 2; k < corners.size(); ++k) {
    mesh.triangles.push_back({{corners[0], corners[k - 1], corners[k]}, material});
  }
  return {};
}

}  // namespace

MeshRead read_obj_mesh(std::string_view text, const CookProgress& progress) {
  MeshRead result;
  std::map<std::string_view, uint8_t> materials;
  uint8_t material = 0;
  const size_t total = text.size();
  for (size_t number = 1; !text.empty(); ++number) {
    if (progress != nullptr && number % 65536 == 0) progress(total - text.size(), total);
    std::string_view line = next_line(text);
    const std::string_view kind = next_word(line);
    std::string problem;
    if (kind == "v") {
      Point point{};
      problem = read_vertex(line, point);
      if (result.mesh.vertices.size() == k_mesh_source_max) problem = "more vertices than can be cooked";
      result.mesh.vertices.push_back(point);
    } else if (kind == "f") {
      problem = read_face(line, material, result.mesh);
    } else if (kind == "usemtl") {
      const std::string_view name = next_word(line);
      if (materials.size() == 256 && materials.count(name) == 0)
        problem = "there are more than 256 materials";
      else
        material = materials.emplace(name, static_cast<uint8_t>(materials.size())).first->second;
    }
    if (!problem.empty()) return {{}, at_line(number, problem)};
  }
  if (result.mesh.triangles.empty()) result.problem = "no line starts with 'f': this is no OBJ with faces";
  return result;
}

MeshRead read_mesh_file(const std::string& path, std::string_view bytes, const CookProgress& progress) {
  if (ends_with(path, ".gltf") || ends_with(path, ".glb")) return read_gltf_mesh(path, bytes);
  return read_obj_mesh(bytes, progress);
}

#if !DETENT_HAS_GLTF
const bool k_reads_gltf = false;

MeshRead read_gltf_mesh(const std::string&, std::string_view) {
  return {{}, "glTF is not read by this build: it was made without tinygltf (Debian: libtinygltf-dev)"};
}
#endif

}  // namespace detent_cook
