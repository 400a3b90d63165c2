#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/world/lab.h"

/// A very long run in which bodies are created and destroyed.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_queries::Random;

constexpr uint32_t k_bodies = 40;   ///< besides the pit's five
constexpr uint32_t k_change = 4;    ///< ticks between changes
constexpr uint32_t k_check = 1000;  ///< ticks between checks of the whole state
constexpr double k_side = 3, k_height = 30;

/// Four walls and a ground.
void make_pit(Lab& lab) {
  lab.add_ground();
  for (const double side : {-1.0, 1.0}) {
    BodyDef wall;
    wall.type = BodyType::fixed;
    wall.shape = box(reals(0.5, k_height, k_side + 1));
    wall.position = position(side * (k_side + 0.5), k_height, 0);
    lab.add(wall);
    wall.shape = box(reals(k_side, k_height, 0.5));
    wall.position = position(0, k_height, side * (k_side + 0.5));
    lab.add(wall);
  }
}

/// Draws in braces, so that their order does not depend on the compiler.
detent_queries::Triple any_triple(Random& random, double low, double high) {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}
Vec3<Real> reals_of(const detent_queries::Triple& v) { return reals(v[0], v[1], v[2]); }

BodyDef any_body(Random& random) {
  BodyDef def;
  const detent_queries::Triple size = any_triple(random, 0.2, 0.4), place = any_triple(random, -2, 2);
  switch (random.below(3)) {
    case 0:
      def.shape = sphere(real(size[0]));
      break;
    case 1:
      def.shape = capsule(real(size[0] / 2), real(size[1]));
      break;
    default:
      def.shape = box(reals_of(size));
      break;
  }
  const detent_queries::Rotation q = random.rotation();
  def.rotation = {unit(q[0]), unit(q[1]), unit(q[2]), unit(q[3])};
  def.position = position(place[0], place[1] + 6, place[2]);
  def.linear_velocity = reals_of(any_triple(random, -4, 4));
  def.angular_velocity = reals_of(any_triple(random, -5, 5));
  def.density = scaled(random.uniform(100, 2000));
  def.material.friction = real(random.uniform(0, 1));
  def.material.restitution = real(random.chance(0.2) ? random.uniform(0, 0.8) : 0);
  def.user_data = random.below(1000);
  return def;
}

struct Soak {
  uint64_t digest = 0, losses = 0, escaped = 0, created = 0;
  /// Bodies stopped early in a tick: they had more impacts than a tick allows.
  uint64_t stopped = 0;
};

/// `contacts`: the world's capacity.
Soak soak(uint32_t ticks, uint32_t contacts) {
  Lab lab({k_bodies + 5, contacts, 0}), copy({k_bodies + 5, contacts, 0});
  Random random(4);
  make_pit(lab);
  std::vector<BodyId> ids;
  Soak result;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    if (tick % k_change == 0) {
      // The fewer bodies there are, the likelier a new one is; sometimes all are destroyed.
      if (random.below(2000) == 0) {
        for (const BodyId id : ids) EXPECT_OK(destroy_body(lab.world, id));
        ids.clear();
      } else if (random.below(k_bodies) >= ids.size()) {
        ids.push_back(lab.add(any_body(random)));
        ++result.created;
      } else {
        const uint32_t which = random.below(static_cast<uint32_t>(ids.size()));
        EXPECT_OK(destroy_body(lab.world, ids[which]));
        EXPECT_FALSE(is_valid(lab.world, ids[which]));
        ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(which));
      }
    }
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.bodies, ids.size() + 5);
    EXPECT_LE(report.contacts.count, contacts);
    EXPECT_LE(report.contacts.count + report.lost.contacts + report.lost.pairs, report.contacts.pairs);
    EXPECT_LE(report.contacts.points, 4 * report.contacts.count);
    const WorldInfo info = get_info(lab.world);
    EXPECT_EQ(info.contacts, report.contacts.count);
    EXPECT_EQ(info.slots_retired, 0u);
    result.stopped += report.ccd.bodies_stopped;
    StepReport others = report;
    others.ccd.bodies_stopped = 0;
    if (!others.complete() && result.losses++ == 0) {
      printf("first loss, in tick %u: %u pairs, %u contacts dropped, %u searches capped, %u values clamped\n", tick,
             report.lost.pairs, report.lost.contacts, report.contacts.capped, report.saturations);
    }
    if (tick % k_check != k_check - 1) continue;
    // load() checks every byte of the state.
    const uint64_t digest_now = digest(lab.world);
    std::vector<uint64_t> bytes = lab.snapshot();
    EXPECT_OK(load(copy.world, bytes_of(bytes), byte_count(bytes)));
    EXPECT_EQ(digest(copy.world), digest_now);
    for (size_t i = ids.size(); i-- > 0;) {
      const Motion motion = lab.motion(ids[i]);
      if (fabs(motion.position[0]) <= k_side && fabs(motion.position[2]) <= k_side && motion.position[1] > 0) continue;
      ++result.escaped;
      EXPECT_OK(destroy_body(lab.world, ids[i]));
      ids.erase(ids.begin() + static_cast<ptrdiff_t>(i));
    }
    if (::testing::Test::HasFailure()) break;
  }
  result.digest = digest(lab.world);

  // Nothing leaks: when all bodies are destroyed the world is empty, and it has room for as many as at first.
  for (const BodyId id : ids) EXPECT_OK(destroy_body(lab.world, id));
  EXPECT_EQ(get_info(lab.world).contacts, 0u);
  EXPECT_EQ(get_info(lab.world).bodies, 5u);
  for (uint32_t i = 0; i < k_bodies; ++i) lab.add(any_body(random));
  BodyId one_more;
  EXPECT_EQ(create_body(lab.world, any_body(random), one_more), Status::pool_full);
  return result;
}

/// The final digests, the same on every target. A change of the simulation version changes them.
struct Ending {
  uint32_t ticks;
  uint64_t digest;
};
#if defined(DETENT_FX64)
constexpr Ending k_endings[] = {{10000, 0xdfeb137f9c20ed85}, {1000000, 0x6678a45f8f9a6ca3}};
#elif defined(DETENT_FX32)
constexpr Ending k_endings[] = {{10000, 0x3ffd6679d3fd9cd1}, {1000000, 0x4469099e412c7723}};
#elif defined(DETENT_F32)
constexpr Ending k_endings[] = {{10000, 0xe673e7e6898b43d8}};
#else
constexpr Ending k_endings[] = {{10000, 0x57ae77bfbd3a9037}};
#endif

/// A million ticks if DETENT_FULL is set.
uint32_t ticks_of_a_soak() {
  const uint32_t ticks = detent_oracle::rounds(10000);
  return ticks > 10000 ? 1000000 : ticks;
}

DETENT_TEST(soak, of_a_world_that_is_large_enough_loses_nothing) {
  const Soak result = soak(ticks_of_a_soak(), 400);
  printf("soak of %u ticks: %" PRIu64 " bodies made, %" PRIu64 " stayed behind, %" PRIu64 " escaped, digest %016" PRIx64
         "\n",
         ticks_of_a_soak(), result.created, result.stopped, result.escaped, result.digest);
  ::testing::Test::RecordProperty("digest", ::testing::PrintToString(result.digest));
  for (const Ending& ending : k_endings) {
    if (ending.ticks != ticks_of_a_soak()) continue;
    EXPECT_EQ(result.digest, ending.digest);
  }
  EXPECT_EQ(result.losses, 0u);
  EXPECT_EQ(result.escaped, 0u);
  EXPECT_LE(result.stopped, 2 + ticks_of_a_soak() / 50000) << "and each is reported";
}

DETENT_TEST(soak, of_a_world_with_too_few_contacts_says_so_and_goes_on) {
  const Soak result = soak(ticks_of_a_soak() / 5, 16);
  EXPECT_GT(result.losses, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
