#include "examples/rollback/conditioner.h"

#include <vector>

#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_rollback;

DETENT_TEST(rollback_conditioner, loses_doubles_delays_and_reorders_as_it_is_told) {
  constexpr uint32_t k_packets = 20000;
  Conditioner conditioner({0.05, 0.01, 0.08, 0.04}, 1);
  std::vector<uint32_t> came(k_packets);
  uint32_t overtaken = 0, newest = 0;
  double displacement = 0, shortest = 1, longest = 0, now = 0;
  const auto arrive = [&](uint32_t to, const uint8_t* bytes, uint32_t count) {
    EXPECT_EQ(to, 3u);
    ASSERT_EQ(count, 2u);
    const uint32_t packet = bytes[0] + 256u * bytes[1];
    ++came[packet];
    overtaken += packet < newest ? 1u : 0u;
    newest = packet > newest ? packet : newest;
    const double took = now - packet / 100.0;
    displacement += took;
    shortest = took < shortest ? took : shortest;
    longest = took > longest ? took : longest;
  };
  for (uint32_t packet = 0; packet < k_packets + 20; ++packet) {
    for (uint32_t part = 0; part < 10; ++part, now = packet / 100.0 + part / 1000.0) {
      conditioner.deliver_due(now, arrive);
    }
    now = packet / 100.0;
    const uint8_t bytes[2] = {static_cast<uint8_t>(packet), static_cast<uint8_t>(packet >> 8)};
    if (packet < k_packets) conditioner.send(3, bytes, 2, now);
  }
  uint32_t lost = 0, twice = 0;
  for (const uint32_t times : came) {
    lost += times == 0 ? 1u : 0u;
    twice += times == 2 ? 1u : 0u;
  }
  EXPECT_NEAR(lost, 0.05 * k_packets, 100);
  EXPECT_NEAR(twice, 0.0095 * k_packets, 50);
  EXPECT_NEAR(displacement / (k_packets - lost + twice), 0.08, 0.002);
  EXPECT_NEAR(shortest, 0.04, 0.002);
  EXPECT_NEAR(longest, 0.12, 0.002);
  EXPECT_GT(overtaken, k_packets / 4);
}

DETENT_TEST(rollback_conditioner, does_the_same_again_for_the_same_seed) {
  std::vector<uint32_t> came[2];
  for (auto& log : came) {
    Conditioner conditioner({0.3, 0.2, 0.1, 0.1}, 7);
    for (uint8_t packet = 0; packet < 200; ++packet) {
      conditioner.send(packet, &packet, 1, packet / 60.0);
      conditioner.deliver_due(packet / 60.0, [&](uint32_t to, const uint8_t*, uint32_t) { log.push_back(to); });
    }
  }
  EXPECT_GT(came[0].size(), 100u);
  EXPECT_EQ(came[0], came[1]);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
