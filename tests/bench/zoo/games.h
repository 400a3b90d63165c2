#pragma once
#include <string>
#include <vector>

#include "tests/campaigns/zoo/list.h"

/// The scenes of games.csv: what games do, chosen from the zoo.
namespace detent_zoo {

struct Game {
  std::string kind;
  Entry entry;
};

/// In the order of the file. On failure `problem` has the reason: a row that is malformed, that names no scene of
/// `entries`, or one that is there twice.
std::vector<Game> read_games(const std::string& path, const std::vector<Entry>& entries, std::string& problem);

}  // namespace detent_zoo
