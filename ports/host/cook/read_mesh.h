#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cook_mesh.h"

namespace detent_cook {

/// The largest number of vertices that are read, and of triangles, including those that cooking leaves out later.
inline constexpr size_t k_mesh_source_max = size_t{1} << 24;

struct MeshRead {
  MeshSource mesh{};
  std::string problem{};               ///< one line, with the line number if known; empty if there is none
  std::vector<std::string> buffers{};  ///< further files that were read
};

/// Reads the faces of a Wavefront OBJ: lines of `v` and `f`. A face of more than three vertices becomes a fan. The
/// materials of `usemtl` are numbered from 0 in the order of their first use. Skips all other lines.
MeshRead read_obj_mesh(std::string_view text, const CookProgress& progress = {});

/// Reads all triangles of a scene of a glTF: of the default scene, else of the first scene, else of all nodes. The
/// nodes place the triangles. `path`: path of the file with these `bytes`; its buffers may be files in the same folder.
/// Materials keep their numbers. Not every build reads glTF: see k_reads_gltf.
MeshRead read_gltf_mesh(const std::string& path, std::string_view bytes);
extern const bool k_reads_gltf;

/// Reads a mesh by the file's suffix: `.gltf` and `.glb` are glTF, any other file is an OBJ.
MeshRead read_mesh_file(const std::string& path, std::string_view bytes, const CookProgress& progress = {});

}  // namespace detent_cook
