#pragma once
#include <string>

#include "difference.h"
#include "engine.h"

/// The tool's output about a file: one line of text, or one JSON object on one line. Results and JSON go to standard
/// output, problems to standard error.
namespace detent_tool {

struct Report {
  bool json = false;

  void recorded(const RecordRequest& request, const Outcome& outcome) const;
  void verified(const std::string& path, const Outcome& outcome) const;
  /// Prints the sums over many files; with JSON output, to standard error.
  void verified_all(uint64_t files, uint64_t bad, uint64_t passed_over, uint64_t ticks, double seconds) const;
  void recovered(const std::string& from, const std::string& to, const Outcome& outcome) const;
  void traced(const TraceRequest& request, const Outcome& outcome) const;
  /// False if the files could not be compared.
  bool compared(const std::string& a, const std::string& b, const Difference& difference) const;
  void compressed(const std::string& from, const std::string& to, uint64_t before, uint64_t after) const;
  void state(const std::string& path, const Outcome& outcome, const std::vector<BodyLine>& bodies) const;
  /// Always false.
  bool problem(const std::string& path, const std::string& problem) const;
  void described(const std::string& path, const Outcome& outcome) const;
  void scene(const SceneLine& line) const;
};

}  // namespace detent_tool
