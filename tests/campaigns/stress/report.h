#pragma once
#include <string>
#include <vector>

#include "tests/campaigns/stress/cases.h"

namespace detent_stress {

/// One trial of one case.
struct Row {
  std::string group, scene, config;
  double scale = 1;
  uint64_t seed = 0;
  Outcome outcome;
};

/// A number, formatted for reading.
std::string figure(double value);
/// One line: the measured values, and those that exceed their bounds.
std::string line_of(const Row& row);
/// A table of the worst values over all seeds, one column for each configuration.
std::string markdown_of(const std::vector<Row>& rows);
std::string json_of(const std::vector<Row>& rows);
/// Rows of k_gaps in bounds.h for the values that exceed their targets: 1.5 times the worst value over all seeds.
std::string gaps_of(const std::vector<Row>& rows);

}  // namespace detent_stress
