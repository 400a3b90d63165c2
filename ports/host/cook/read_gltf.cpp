#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <string.h>
#include <tiny_gltf.h>

#include "../detent/file.h"
#include "read_mesh.h"

namespace detent_cook {
namespace {

constexpr int k_depth_max = 64;

/// A matrix in column order, as in glTF.
using Transform = std::array<double, 16>;

Transform product(const Transform& a, const Transform& b) {
  Transform result{};
  for (size_t column = 0; column < 4; ++column) {
    for (size_t row = 0; row < 4; ++row) {
      double sum = 0;
      for (size_t k = 0; k < 4; ++k) sum += a[4 * k + row] * b[4 * column + k];
      result[4 * column + row] = sum;
    }
  }
  return result;
}

double component(const std::vector<double>& values, size_t i, double otherwise) {
  return i < values.size() ? values[i] : otherwise;
}

Transform transform_of(const tinygltf::Node& node) {
  Transform m{};
  if (node.matrix.size() == 16) {
    for (size_t i = 0; i < 16; ++i) m[i] = node.matrix[i];
    return m;
  }
  const double x = component(node.rotation, 0, 0), y = component(node.rotation, 1, 0),
               z = component(node.rotation, 2, 0), w = component(node.rotation, 3, 1);
  const double rotation_vector[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  for (size_t column = 0; column < 3; ++column) {
    for (size_t row = 0; row < 3; ++row)
      m[4 * column + row] = rotation_vector[column][row] * component(node.scale, column, 1);
    m[12 + column] = component(node.translation, column, 0);
  }
  m[15] = 1;
  return m;
}

class Reader {
 public:
  explicit Reader(const tinygltf::Model& model) : model_(model), added_(model.nodes.size()) {}

  /// Adds a node, but each node only once. glTF does not permit shared nodes; with them a small file could create more
  /// triangles than fit in memory.
  void add_node(int index, const Transform& parent, int depth) {
    if (index < 0 || static_cast<size_t>(index) >= model_.nodes.size() || depth > k_depth_max) {
      return fail("a node that is missing, or too deep");
    }
    if (added_[static_cast<size_t>(index)]) return fail("a node in two places");
    added_[static_cast<size_t>(index)] = true;
    const tinygltf::Node& node = model_.nodes[static_cast<size_t>(index)];
    const Transform place = product(parent, transform_of(node));
    if (node.mesh >= 0 && static_cast<size_t>(node.mesh) < model_.meshes.size()) {
      for (const tinygltf::Primitive& primitive : model_.meshes[static_cast<size_t>(node.mesh)].primitives) {
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES && result.problem.empty()) add_primitive(primitive, place);
      }
    }
    for (const int child : node.children) {
      if (result.problem.empty()) add_node(child, place, depth + 1);
    }
  }

  void add_scene() {
    const size_t scene = model_.defaultScene < 0 ? 0 : static_cast<size_t>(model_.defaultScene);
    if (scene < model_.scenes.size()) return add_roots(model_.scenes[scene].nodes);
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && static_cast<size_t>(child) < is_child.size()) is_child[static_cast<size_t>(child)] = true;
      }
    }
    std::vector<int> roots;
    for (size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    add_roots(roots);
  }

  MeshRead result{};

 private:
  void add_roots(const std::vector<int>& nodes) {
    constexpr Transform k_still = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (const int node : nodes) {
      if (result.problem.empty()) add_node(node, k_still, 0);
    }
  }

  void fail(const std::string& what) {
    if (result.problem.empty()) result.problem = "the glTF names " + what;
  }

  /// The `size` bytes of element i; null if some are missing.
  const unsigned char* element(const tinygltf::Accessor& accessor, size_t i, size_t size) const {
    if (accessor.bufferView < 0 || static_cast<size_t>(accessor.bufferView) >= model_.bufferViews.size())
      return nullptr;
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<size_t>(accessor.bufferView)];
    if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= model_.buffers.size()) return nullptr;
    const std::vector<unsigned char>& data = model_.buffers[static_cast<size_t>(view.buffer)].data;
    const size_t stride = view.byteStride != 0 ? view.byteStride : size;
    const size_t at = view.byteOffset + accessor.byteOffset + i * stride;
    return i < accessor.count && at <= data.size() && size <= data.size() - at ? data.data() + at : nullptr;
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Transform& place) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end() || position->second < 0 ||
        static_cast<size_t>(position->second) >= model_.accessors.size()) {
      return fail("no positions");
    }
    const tinygltf::Accessor& points = model_.accessors[static_cast<size_t>(position->second)];
    if (points.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || points.type != TINYGLTF_TYPE_VEC3) {
      return fail("positions that are not three floats");
    }
    if (points.count > k_mesh_source_max - result.mesh.vertices.size()) return fail("more vertices than can be cooked");
    const auto base = static_cast<uint32_t>(result.mesh.vertices.size());
    for (size_t i = 0; i < points.count; ++i) {
      const unsigned char* bytes = element(points, i, 3 * sizeof(float));
      if (bytes == nullptr) return fail("positions that are missing");
      float p[3];
      memcpy(p, bytes, sizeof p);
      Point at{};
      for (size_t k = 0; k < 3; ++k) {
        at[k] = place[k] * double{p[0]} + place[4 + k] * double{p[1]} + place[8 + k] * double{p[2]} + place[12 + k];
      }
      result.mesh.vertices.push_back(at);
    }
    const bool indexed = primitive.indices >= 0;
    if (indexed && static_cast<size_t>(primitive.indices) >= model_.accessors.size())
      return fail("indices that are missing");
    const tinygltf::Accessor& indices =
        model_.accessors[static_cast<size_t>(indexed ? primitive.indices : position->second)];
    if (indices.count / 3 > k_mesh_source_max - result.mesh.triangles.size()) {
      return fail("more triangles than can be cooked");
    }
    const auto material = static_cast<uint8_t>(primitive.material < 0 ? 0 : primitive.material & 255);
    // A mirrored node reverses the order of its triangles' corners.
    const Transform& m = place;
    const bool mirrored =
        m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]) <
        0;
    for (size_t i = 0; i + 2 < indices.count; i += 3) {
      MeshSource::Triangle triangle;
      for (size_t k = 0; k < 3; ++k) {
        uint32_t index = static_cast<uint32_t>(i + k);
        if (indexed && !read_index(indices, i + k, index)) return fail("indices that are missing");
        if (index >= points.count) return fail("a vertex that is missing");
        triangle.vertex[mirrored ? 2 - k : k] = base + index;
      }
      triangle.material = material;
      result.mesh.triangles.push_back(triangle);
    }
  }

  bool read_index(const tinygltf::Accessor& indices, size_t i, uint32_t& index) const {
    const size_t size = indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT     ? 4
                        : indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                                                                                          : 1;
    const unsigned char* bytes = element(indices, i, size);
    if (bytes == nullptr) return false;
    index = 0;
    for (size_t k = 0; k < size; ++k) index |= uint32_t{bytes[k]} << (8 * k);
    return true;
  }

  const tinygltf::Model& model_;
  std::vector<bool> added_;  ///< by node
};

bool no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

/// Reads the buffers that are separate files.
struct Buffers {
  std::vector<std::string> paths;
  /// summed over all buffers, because a glTF may name one file repeatedly
  uint64_t bytes_left = detent_tool::k_whole_file_bytes_max;
};

bool read_buffer(std::vector<unsigned char>* bytes, std::string* problem, const std::string& path, void* context) {
  Buffers& buffers = *static_cast<Buffers*>(context);
  *problem = detent_tool::read_file(path, *bytes, buffers.bytes_left);
  if (!problem->empty()) return false;
  buffers.paths.push_back(path);
  buffers.bytes_left -= bytes->size();
  return true;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

const bool k_reads_gltf = true;

MeshRead read_gltf_mesh(const std::string& path, std::string_view bytes) {
  Buffers buffers;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(no_image, nullptr);
  loader.SetFsCallbacks({tinygltf::FileExists, tinygltf::ExpandFilePath, read_buffer, nullptr, &buffers});
  tinygltf::Model model;
  std::string error, warning;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto count = static_cast<unsigned int>(bytes.size());
  const bool binary = path.size() >= 4 && path.compare(path.size() - 4, 4, ".glb") == 0;
  const bool loaded =
      binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), count, folder)
             : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), count, folder);
  if (!loaded) return {{}, "this is no glTF that can be read: " + first_line(error)};
  Reader reader(model);
  reader.add_scene();
  reader.result.buffers = std::move(buffers.paths);
  if (reader.result.problem.empty() && reader.result.mesh.triangles.empty())
    reader.result.problem = "the glTF's scene has no triangles";
  return reader.result;
}

}  // namespace detent_cook
