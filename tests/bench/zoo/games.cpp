#include "tests/bench/zoo/games.h"

#include <algorithm>
#include <fstream>

namespace detent_zoo {

std::vector<Game> read_games(const std::string& path, const std::vector<Entry>& entries, std::string& problem) {
  std::ifstream file(path);
  std::vector<Game> games;
  std::string line;
  if (!std::getline(file, line) || line != "kind,scene") problem = path + ":1: is not \"kind,scene\"";
  for (uint32_t number = 2; problem.empty() && std::getline(file, line); ++number) {
    const size_t comma = line.find(',');
    const std::string scene = comma == std::string::npos ? "" : line.substr(comma + 1);
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& each) { return each.scene == scene; });
    const bool twice =
        std::any_of(games.begin(), games.end(), [&](const Game& game) { return game.entry.scene == scene; });
    if (comma == 0 || entry == entries.end() || twice) {
      problem =
          path + ":" + std::to_string(number) + ": " +
          (comma == 0 ? "has no kind" : "\"" + scene + "\" is " + (twice ? "there twice" : "no scene of the zoo"));
      break;
    }
    games.push_back({line.substr(0, comma), *entry});
  }
  if (!problem.empty()) games.clear();
  return games;
}

}  // namespace detent_zoo
