#pragma once
#include <stdint.h>

#include <functional>
#include <set>
#include <vector>

/// Delta debugging: the search for a smallest input that still shows a fault. Source: Zeller, Hildebrandt, "Simplifying
/// and isolating failure-inducing input", IEEE Transactions on Software Engineering 28 (2), 2002. Unlike there, the
/// search only tries to leave out chunks; it does not try chunks alone.
namespace detent_tool {

/// The numbers, ascending, of parts of an input that can be left out.
using Units = std::vector<uint32_t>;
/// Whether an input of only these units shows the fault.
using ShowsFault = std::function<bool(const Units&)>;

/// Asks a predicate, at most `limit` times, and never twice about units that do not show the fault.
class Trials {
 public:
  explicit Trials(uint32_t limit) : limit_(limit) {}

  /// Whether the units show the fault. Returns false without asking if they did not show it before, or if the limit is
  /// reached.
  bool shows(const Units& units, const ShowsFault& predicate);
  /// Counts a trial that the caller makes without shows(). Returns false if the limit is reached.
  bool take();
  /// Forgets which units did not show the fault: the numbers of units have another meaning from now on.
  void forget() { failed_.clear(); }

  uint32_t made() const { return made_; }
  bool limit_reached() const { return limit_reached_; }

 private:
  uint32_t limit_;
  uint32_t made_ = 0;
  bool limit_reached_ = false;
  std::set<uint64_t> failed_;  ///< hashes of the units that did not show the fault
};

/// Leaves out units that the fault does not need: tries to leave out all at once, then chunks of half as many units,
/// and so on down to single units. `others`: units that stay; the predicate gets them, too. Returns the units that are
/// left. Together with `others` they show the fault, and no single one of them can be left out. If the trials reach
/// their limit, returns the fewest units found. Range: `units` and `others` together show the fault.
Units minimise(Units units, const Units& others, Trials& trials, const ShowsFault& shows);

}  // namespace detent_tool
