#pragma once
#include "tests/campaigns/zoo/visit.h"

namespace detent_zoo {

struct Row {
  const Entry* entry;
  std::string config;
  Verdict verdict;
};

/// One line of the measured values and the failed checks.
std::string line_of(const Row& row);
/// docs/zoo.md: the text of `page` up to its table, and a new table. `rows`: grouped by scene.
std::string page_of(const std::string& page, const std::vector<Row>& rows);

}  // namespace detent_zoo
