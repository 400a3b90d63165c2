#pragma once
#include <string>
#include <vector>

#include "tests/stress/cases.h"

namespace detent_stress {

/// One trial of one case.
struct Row {
  std::string group, scene, config;
  double scale = 1;
  uint64_t seed = 0;
  Outcome outcome;
};

/// A figure as people read it.
std::string figure(double value);
/// One line: what was measured, and what of it misses what is wanted.
std::string line_of(const Row& row);
/// A table: the worst of all seeds, a column a configuration.
std::string markdown_of(const std::vector<Row>& rows);
std::string json_of(const std::vector<Row>& rows);
/// Rows of k_gaps in bounds.h for what misses what is wanted: the worst of all seeds and half as much again.
std::string gaps_of(const std::vector<Row>& rows);

}  // namespace detent_stress
