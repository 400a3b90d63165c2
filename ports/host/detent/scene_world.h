#pragma once
#include "owned_world.h"
#include "run.h"
#include "scene_reader.h"

/// The world of a scene that is read, and the cooked files that it names.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct SceneAssets {
  Assets bytes;
  std::vector<Asset> table;
  std::vector<std::string> digests;

  /// False, and a problem, if one cannot be read or has another digest than the scene says.
  bool read(SceneReading& reading, const RunRequest& request);
};

/// False, and a problem, if it cannot be.
bool make_world(SceneReading& reading, const SceneAssets& assets, uint32_t bytes_max, OwnedWorld& owned);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
