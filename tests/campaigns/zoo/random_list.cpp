#include "tests/campaigns/zoo/random_list.h"

#include <filesystem>
#include <fstream>

#include "tests/campaigns/zoo/random_scene.h"

namespace detent_zoo {

Entry write_random_scene(uint64_t seed, const std::string& folder, const std::string& assets,
                         const std::vector<Entry>& known, std::string& problem) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string path_to_assets = std::filesystem::proximate(assets, folder, error).generic_string() + "/";
  const RandomScene scene = random_scene(seed, path_to_assets);
  Entry entry = make_entry("random_" + std::to_string(seed), scene.ground, "rests sleeps", problem);
  entry.ends_asleep = true;
  for (const Entry& each : known) {
    if (each.scene == entry.scene) entry.gaps = each.gaps;
  }
  const std::string path = folder + "/" + entry.scene + ".json";
  if (!(std::ofstream(path) << scene.text)) problem = path + " cannot be written";
  return entry;
}

}  // namespace detent_zoo
