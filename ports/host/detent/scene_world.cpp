#include "scene_world.h"

#include <filesystem>

#include "file.h"
#include "state/asset_binding.h"
#include "text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// The reason why a cooked file cannot be a shape of this type.
std::string refusal(FileKind kind, ShapeType type) {
  const bool terrain = kind == FileKind::mesh || kind == FileKind::height_field;
  if (type == ShapeType::hull && kind != FileKind::hull) return is_not(kind, "a cooked hull");
  if (type == ShapeType::compound && kind != FileKind::compound) return is_not(kind, "a cooked compound");
  if (type == ShapeType::terrain && !terrain) return is_not(kind, "a cooked mesh or height field");
  return "is damaged, or of another format version";
}

}  // namespace

bool SceneAssets::read(SceneReading& reading, const RunRequest& request) {
  const std::filesystem::path folder = std::filesystem::path(request.path).parent_path();
  bytes.resize(reading.assets.size());
  for (size_t i = 0; i < bytes.size(); ++i) {
    const SceneAsset& asset = reading.assets[i];
    const std::string path = (folder / asset.file).string();
    if (const std::string problem = read_asset(path, bytes[i]); !problem.empty()) {
      reading.problem(asset.file_origin, asset.file + " " + problem);
      return false;
    }
    if (is_same_file(path, request.recording)) {
      reading.problem(asset.file_origin, asset.file + " would be written over by the recording");
      return false;
    }
    table.push_back({reinterpret_cast<const uint8_t*>(bytes[i].words.data()), bytes[i].byte_count});
    AssetState state;
    const AssetTable so_far = {table.data(), static_cast<uint32_t>(table.size())};
    const Status status = describe_asset(so_far, static_cast<uint32_t>(i), feature_table<Features::all>, state);
    if (status != Status::ok || state.kind != static_cast<uint32_t>(asset_kind_of(asset.type))) {
      reading.problem(asset.file_origin, asset.file + " " + refusal(bytes[i].kind, asset.type));
      return false;
    }
    const std::string digest = hexadecimal(state.digest);
    if (!asset.digest.empty() && asset.digest != digest) {
      reading.problem(asset.digest_origin, "that of " + asset.file + " is " + digest);
      return false;
    }
    digests.push_back(digest);
  }
  return true;
}

bool make_world(SceneReading& reading, const SceneAssets& assets, uint32_t bytes_max, OwnedWorld& owned) {
  const WorldDef& def = reading.scene.world;
  const uint32_t bytes = world_bytes(def.capacity);
  if (bytes == 0 || bytes > bytes_max) {
    reading.problem({},
                    "its world would take more than " + std::to_string(bytes_max >> 20) + " MB: less capacity will do");
    return false;
  }
  const Status status = owned.create(def, {assets.table.data(), static_cast<uint32_t>(assets.table.size())});
  if (status != Status::ok) reading.problem({}, std::string("its world cannot be made: ") + status_text(status));
  return status == Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
