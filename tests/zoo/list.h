#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

/// The scenes of zoo.csv, and what is wanted of each.
namespace detent_zoo {

/// What is checked. Names as in zoo.csv.
inline constexpr const char* k_checks[] = {"gain",    "loss",   "gap",   "angle",    "limit", "sunk",
                                           "pierced", "lost",   "speed", "momentum", "spin",  "rest",
                                           "moved",   "fallen", "risen", "asleep"};

struct Entry {
  std::string scene;                                  ///< its file is scenes/<scene>.json
  std::string source;                                 ///< where its parameters are from
  bool rests = false;                                 ///< it comes to rest by its end
  std::map<std::string, double> bounds;               ///< of each check that applies
  std::string wants, why;                             ///< as written
  std::map<std::string, std::set<std::string>> gaps;  ///< by configuration: the checks that fail today
};

/// The rows of that file, or `problem`: the line and what is wrong with it.
std::vector<Entry> read_list(const std::string& path, std::string& problem);
/// Writes it anew with the entries' gaps. False if it cannot be.
bool write_list(const std::string& path, const std::vector<Entry>& entries);
std::string gaps_text(const std::map<std::string, std::set<std::string>>& gaps);

}  // namespace detent_zoo
