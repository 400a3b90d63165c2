#include <detent/rollback.h>

#include "tests/campaigns/fuzz/targets.h"
#include "tests/campaigns/sequences/game.h"
#include "tests/common/support/usable.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

constexpr uint8_t k_mend = 1;  ///< of the first byte

/// What every delta is applied to.
const std::vector<uint64_t>& base() {
  static const std::vector<uint64_t> words = [] {
    const Bytes snapshot = k_snapshot_target.seeds()[0];
    std::vector<uint64_t> made(snapshot.size() / 8);
    memcpy(made.data(), snapshot.data(), snapshot.size());
    return made;
  }();
  return words;
}

uint32_t count_of(const Bytes& bytes) { return static_cast<uint32_t>(bytes.size()); }

struct Receiver {
  OwnedWorld owned = OwnedWorld(OwnedWorld::def_of(k_fuzzed_capacity), Game::assets());
  Receiver() { owned.world.hooks.filter_rules = Game::rules(); }
  World& world() { return owned.world; }
  Status take_over(std::vector<uint64_t> snapshot) { return load(world(), bytes_of(snapshot), byte_count(snapshot)); }
};

Bytes delta_to(const World& world) {
  std::vector<uint64_t> from = base();
  Bytes delta(delta_bytes_max(k_fuzzed_capacity));
  uint32_t count = 0;
  EXPECT_OK(save_delta(world, bytes_of(from), byte_count(from), delta.data(), count_of(delta), count));
  delta.resize(count);
  return delta;
}

/// A header of this base.
void mend(Bytes& delta) {
  static const Bytes right = [] {
    Receiver receiver;
    EXPECT_OK(receiver.take_over(base()));
    return delta_to(receiver.world());
  }();
  if (delta.size() >= k_delta_header_bytes) memcpy(delta.data(), right.data(), k_delta_header_bytes);
}

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  Bytes delta(bytes.begin() + 1, bytes.end());
  if ((bytes[0] & k_mend) != 0) mend(delta);
  std::vector<uint64_t> snapshot = base();
  if (apply_delta(bytes_of(snapshot), byte_count(snapshot), delta.data(), count_of(delta)) != Status::ok) {
    EXPECT_TRUE(snapshot == base());
    return false;
  }
  Receiver receiver;
  const uint64_t before = digest(receiver.world());
  if (receiver.take_over(snapshot) != Status::ok) {
    EXPECT_EQ(digest(receiver.world()), before);
    return false;
  }
  expect_usable(receiver.world());
  return true;
}

/// To other worlds that random calls have filled, and to the next ticks.
std::vector<Bytes> seeds() {
  std::vector<Bytes> deltas;
  for (const Bytes& snapshot : k_snapshot_target.seeds()) {
    std::vector<uint64_t> words(snapshot.size() / 8);
    memcpy(words.data(), snapshot.data(), snapshot.size());
    Receiver receiver;
    EXPECT_OK(receiver.take_over(words));
    deltas.push_back(delta_to(receiver.world()));
  }
  Receiver receiver;
  EXPECT_OK(receiver.take_over(base()));
  for (uint32_t tick = 0; tick < 4; ++tick) {
    step(receiver.world());
    deltas.push_back(delta_to(receiver.world()));
  }
  for (Bytes& delta : deltas) delta.insert(delta.begin(), k_mend);
  return deltas;
}

}  // namespace

const detent_fuzz::Target k_delta_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
