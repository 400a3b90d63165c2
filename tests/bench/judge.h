#pragma once
#include <string>

#include "tests/bench/truth.h"

/// Answers against the truth, and times: a row for each engine and set.
namespace detent_bench {

/// A gap below this part of the size is beyond what the oracle resolves.
inline constexpr double k_resolution = 1e-12;
/// The gap in units of size at which a hit is still right.
inline constexpr double k_tolerance = 1e-6;
/// A miss of a hit deeper than this part of the size counts as deep.
inline constexpr double k_deep = 1e-3;

struct Row {
  Task task = Task::toi;
  std::string set, method, config;
  uint32_t queries = 0;    ///< of the part that the engine had an answer to
  uint32_t hits = 0;       ///< among them, in truth
  uint32_t fn = 0;         ///< hits called clear or undecided
  uint32_t fn_deep = 0;    ///< of those the deep ones
  uint32_t fp = 0;         ///< hits or undecided where the truth stays farther off than the tolerance
  uint32_t undecided = 0;  ///< in fn or fp too
  double late_max = 0;     ///< of size; how deep they come by the reported time of a hit, at most
  double early_p99 = 0;    ///< of size; the gap at the reported time of a hit that is one
  double early_max = 0;    ///< of size
  double error_p99 = 0;    ///< of size; distance alone
  double error_max = 0;    ///< of size; distance alone
  double gjk_mean = 0, gjk_max = 0;
  double ns_mean = 0, ns_p99 = 0, ns_max = 0;
  double ratio_mean = 0;  ///< of the mean time to Bullet's in double, over the queries that both answered; 0: none
  double ratio_p99 = 0;   ///< likewise
};

/// Of all queries, of those that turn, of those that do not; and of these what is asked of two polytopes.
enum class Part { all, rotating, linear, rotating_polytopes, linear_polytopes };
inline constexpr Part k_parts[] = {Part::all, Part::rotating, Part::linear, Part::rotating_polytopes,
                                   Part::linear_polytopes};

/// What is known of one set: a list for each engine, since an engine's grid makes other queries of them.
struct Findings {
  std::string set;
  const EngineList* engines = nullptr;
  std::vector<const std::vector<detent_queries::Query>*> queries;
  std::vector<const std::vector<Truth>*> truths;
  std::vector<std::vector<Measured>> measured;
};

/// A row for each engine that answered whatever the library's default answered in the part: all of a part's rows are of
/// the same queries, but for those that the default refuses. (Of a run without it: whatever any engine answered.) None
/// if the part is no less than the one that it is a part of.
std::vector<Row> rows_of(const Findings& findings, Part part);

}  // namespace detent_bench
