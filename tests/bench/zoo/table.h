#pragma once
#include "tests/bench/zoo/measure.h"

/// What was measured, as text.
namespace detent_zoo {

/// A scene's line on the terminal.
std::string line_of(const SceneResults& scene);
/// How many each engine passes, how long it takes, what it cannot express.
std::string summary_of(const std::vector<SceneResults>& scenes, uint32_t repetitions);
/// docs/bench/zoo.md: the text of `page` up to its figures, and those anew.
std::string page_of(const std::string& page, const std::vector<SceneResults>& scenes, uint32_t repetitions);
std::string json_of(const std::vector<SceneResults>& scenes);

}  // namespace detent_zoo
