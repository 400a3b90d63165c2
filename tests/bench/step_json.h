#pragma once
#include <stdlib.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/step_times.h"
#include "tests/common/support/text_table.h"

/// Rows of whole steps as JSON.
namespace detent_bench {

/// Without digits that mean nothing.
inline double rounded(double value, int digits) {
  return strtod(detent_text::text("%.*g", digits, value).c_str(), nullptr);
}

inline void add_times(nlohmann::ordered_json& row, const StepTimes& times, const StageShares& stages) {
  const auto us = [](double value) { return strtod(detent_text::text("%.3f", value).c_str(), nullptr); };
  row["us_mean"] = us(times.mean);
  row["us_median"] = us(times.median);
  row["us_p99"] = us(times.p99);
  row["us_max"] = us(times.max);
  for (const auto& [stage, share] : stages) row["stages"][stage] = rounded(share, 3);
}

/// A JSON array, a row a line.
inline std::string lines_of(const std::vector<nlohmann::ordered_json>& rows) {
  std::string text;
  for (const nlohmann::ordered_json& row : rows) text += (text.empty() ? "[\n" : ",\n") + row.dump();
  return text.empty() ? "[]\n" : text + "\n]\n";
}

}  // namespace detent_bench
