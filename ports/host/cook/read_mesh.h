#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cook_mesh.h"

namespace detent_cook {

/// No more vertices are read, and no more triangles, before those are left out that are not cooked.
inline constexpr size_t k_mesh_source_max = size_t{1} << 24;

struct MeshRead {
  MeshSource mesh{};
  std::string problem{};               ///< one line, with the line's number where there is one; empty if all is well
  std::vector<std::string> buffers{};  ///< further files that were read
};

/// The faces of a Wavefront OBJ: lines of `v` and `f`; a face of more than three vertices becomes a fan. The materials
/// that `usemtl` names are numbered from 0 on, as they come. All other lines are passed over.
MeshRead read_obj_mesh(std::string_view text, const CookProgress& progress = {});

/// All triangles of a glTF's scene (the default one; all nodes if it has none), placed by the nodes. `path`: of the
/// file that the bytes are of; its buffers may lie beside it. Materials keep their numbers. Not in every build: see
/// k_reads_gltf.
MeshRead read_gltf_mesh(const std::string& path, std::string_view bytes);
extern const bool k_reads_gltf;

/// By the name's end: `.gltf` and `.glb` are glTF, all else is an OBJ.
MeshRead read_mesh_file(const std::string& path, std::string_view bytes, const CookProgress& progress = {});

}  // namespace detent_cook
