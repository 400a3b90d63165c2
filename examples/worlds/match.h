#pragma once
#include <detent/world.h>

#include <vector>

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace worlds {

/// No bot moves in these ticks: after them all matches are still equal.
inline constexpr uint32_t k_common_ticks = 60;

/// A match of four bots on the pitch of examples/rollback, in a block of memory of its own. What the bots do follows
/// from the seed alone.
struct Match {
  /// With an empty world, for a state that is restored.
  Match();
  /// With a new pitch.
  explicit Match(uint64_t seed);
  Match(Match&&) = default;  // not a copy: a world is a handle to its block
  Match& operator=(Match&&) = default;

  /// Plays so many ticks, each with the inputs of the bots.
  void play(uint32_t ticks);

  uint64_t seed = 0;
  std::vector<uint64_t> block;
  World world;
};

}  // namespace worlds
}  // namespace DETENT_NAMESPACE
}  // namespace detent
