#include "tests/campaigns/fuzz/targets.h"
#include "tests/campaigns/sequences/game.h"
#include "tests/common/support/usable.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

bool take(const Bytes& bytes) {
  OwnedWorld owned(OwnedWorld::def_of(k_fuzzed_capacity), Game::assets());
  owned.world.hooks.filter_rules = Game::rules();
  const uint64_t before = digest(owned.world);
  std::vector<uint64_t> words((bytes.size() + 7) / 8);
  if (!bytes.empty()) memcpy(words.data(), bytes.data(), bytes.size());
  if (load(owned.world, bytes_of(words), static_cast<uint32_t>(bytes.size())) != Status::ok) {
    EXPECT_EQ(digest(owned.world), before);
    return false;
  }
  expect_usable(owned.world);
  return true;
}

/// Of worlds that random calls have filled.
std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  for (uint64_t seed = 1; made.size() < 8; ++seed) {
    Game game(Draw(seed, false));
    game.play();
    if (!(game.capacity() == k_fuzzed_capacity)) continue;
    std::vector<uint64_t> words = game.save_all();
    made.emplace_back(bytes_of(words), bytes_of(words) + byte_count(words));
  }
  return made;
}

}  // namespace

const detent_fuzz::Target k_snapshot_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
