#pragma once
#include "owned_world.h"
#include "run.h"
#include "scene_reader.h"

/// Creates the world of a scene and reads its cooked files.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct SceneAssets {
  Assets bytes;
  std::vector<Asset> table;
  std::vector<std::string> digests;

  /// Reads the cooked files. Returns false, with a problem, if a file cannot be read, or if its digest differs from the
  /// digest in the scene.
  bool read(SceneReading& reading, const RunRequest& request);
};

/// Creates the world of the scene. Returns false, with a problem, on failure.
bool make_world(SceneReading& reading, const SceneAssets& assets, uint32_t bytes_max, OwnedWorld& owned);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
