#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

/// The scenes of zoo.csv, and the checks of each.
namespace detent_zoo {

/// The names of the checks, as in zoo.csv.
inline constexpr const char* k_checks[] = {
    "gain", "loss",  "gap",    "angle", "limit", "sunk", "pierced", "lost", "speed", "momentum", "angular_momentum",
    "rest", "moved", "fallen", "risen", "asleep"};

struct Entry {
  std::string scene;                                  ///< its file is scenes/<scene>.json
  std::string source;                                 ///< the source of its parameters
  bool rests = false;                                 ///< the scene comes to rest by its end
  std::map<std::string, double> bounds;               ///< bounds of the checks that apply
  std::string wants, why;                             ///< as in the file
  std::map<std::string, std::set<std::string>> gaps;  ///< by configuration: the checks that fail today
  bool ends_asleep = false;                           ///< it is played until all bodies sleep; no call wakes them
};

/// A row without gaps. On failure `problem` has the reason.
Entry make_entry(const std::string& scene, const std::string& source, const std::string& wants, std::string& problem);
/// Reads the rows of the file. On failure `problem` has the line and the reason.
std::vector<Entry> read_list(const std::string& path, std::string& problem);
/// Rewrites the file with the entries' gaps. False if it cannot be written.
bool write_list(const std::string& path, const std::vector<Entry>& entries);
std::string gaps_text(const std::map<std::string, std::set<std::string>>& gaps);

}  // namespace detent_zoo
