#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <string.h>
#include <tiny_gltf.h>

#include "read_mesh.h"

namespace detent_cook {
namespace {

/// Columns, as in glTF.
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
  const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                             {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                             {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  for (size_t column = 0; column < 3; ++column) {
    for (size_t row = 0; row < 3; ++row) m[4 * column + row] = turn[column][row] * component(node.scale, column, 1);
    m[12 + column] = component(node.translation, column, 0);
  }
  m[15] = 1;
  return m;
}

class Reader {
 public:
  explicit Reader(const tinygltf::Model& model) : model_(model) {}

  void add_node(int index, const Transform& parent, int depth) {
    if (index < 0 || static_cast<size_t>(index) >= model_.nodes.size() || depth > 64) {
      fail("a node that is missing, or part of itself");
      return;
    }
    const tinygltf::Node& node = model_.nodes[static_cast<size_t>(index)];
    const Transform place = product(parent, transform_of(node));
    if (node.mesh >= 0 && static_cast<size_t>(node.mesh) < model_.meshes.size()) {
      for (const tinygltf::Primitive& primitive : model_.meshes[static_cast<size_t>(node.mesh)].primitives) {
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) add_primitive(primitive, place);
      }
    }
    for (const int child : node.children) {
      if (result.problem.empty()) add_node(child, place, depth + 1);
    }
  }

  MeshRead result{};

 private:
  void fail(const std::string& what) {
    if (result.problem.empty()) result.problem = "the glTF names " + what;
  }

  /// The bytes of element i, `size` of them; null if they are not all there.
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
    const auto material = static_cast<uint8_t>(primitive.material < 0 ? 0 : primitive.material & 255);
    // A mirrored node turns its triangles round.
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
};

bool no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

const bool k_reads_gltf = true;

MeshRead read_gltf_mesh(const std::string& path) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(no_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const bool binary = path.size() >= 4 && path.compare(path.size() - 4, 4, ".glb") == 0;
  const bool loaded = binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path)
                             : loader.LoadASCIIFromFile(&model, &error, &warning, path);
  if (!loaded) return {{}, "this is no glTF that can be read: " + first_line(error)};
  Reader reader(model);
  constexpr Transform k_still = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const size_t scene = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
  if (scene < model.scenes.size()) {
    for (const int node : model.scenes[scene].nodes) reader.add_node(node, k_still, 0);
  } else {
    for (size_t i = 0; i < model.nodes.size(); ++i) reader.add_node(static_cast<int>(i), k_still, 0);
  }
  if (!reader.result.problem.empty()) return {{}, reader.result.problem};
  if (reader.result.mesh.triangles.empty()) return {{}, "the glTF's scene has no triangles"};
  return reader.result;
}

}  // namespace detent_cook
