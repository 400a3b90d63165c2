#pragma once
#include <stdint.h>

#include <functional>
#include <set>
#include <vector>

/// Delta debugging: the search for a smallest input that still shows a fault. Source: Zeller, Hildebrandt, "Simplifying
/// and isolating failure-inducing input", IEEE Transactions on Software Engineering 28 (2), 2002. Only the complements
/// of chunks are tried.
namespace detent_tool {

/// The parts of an input that can be left out, by their numbers, ascending.
using Units = std::vector<uint32_t>;
/// Whether the input of these units shows the fault.
using ShowsFault = std::function<bool(const Units&)>;

/// Asks a predicate, at most `limit` times, and never twice about units that do not show the fault.
class Trials {
 public:
  explicit Trials(uint32_t limit) : limit_(limit) {}

  /// False also for units that were asked about before, and beyond the limit.
  bool shows(const Units& units, const ShowsFault& predicate);
  /// Counts a trial that is made elsewhere. False beyond the limit.
  bool take();
  /// Forgets the units: their numbers have another meaning from now on.
  void forget() { failed_.clear(); }

  uint32_t made() const { return made_; }
  bool limit_reached() const { return limit_reached_; }

 private:
  uint32_t limit_;
  uint32_t made_ = 0;
  bool limit_reached_ = false;
  std::set<uint64_t> failed_;  ///< hashes
};

/// Leaves out all of the units that the fault does not need: first all, then chunks of half the size each time.
/// `others`: units that stay; the predicate gets them, too. Returns the units that are left: those and `others` show
/// the fault, and no single one of them can be left out; or, if the trials have reached their limit, the fewest found.
/// `units` and `others` must show the fault.
Units minimise(Units units, const Units& others, Trials& trials, const ShowsFault& shows);

}  // namespace detent_tool
