#include <detent/rollback.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/world/turmoil.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Bytes delta_of(const World& world, std::vector<uint64_t>& base) {
  Bytes delta(delta_bytes_max(get_info(world).capacity));
  uint32_t bytes = 0;
  EXPECT_OK(
      save_delta(world, bytes_of(base), byte_count(base), delta.data(), static_cast<uint32_t>(delta.size()), bytes));
  delta.resize(bytes);
  return delta;
}
uint32_t count_of(const Bytes& bytes) { return static_cast<uint32_t>(bytes.size()); }

DETENT_TEST(delta, applied_to_its_base_is_the_whole_snapshot_bit_for_bit) {
  for (uint64_t seed = 1; seed <= detent_oracle::rounds(60); ++seed) {
    OwnedWorld owned = make_turmoiled(seed, static_cast<uint32_t>(seed % 30));
    std::vector<uint64_t> base = save_all(owned.world);
    for (uint32_t tick = 0; tick < 6; ++tick) {
      const std::vector<uint64_t> now = save_all(owned.world);
      const Bytes delta = delta_of(owned.world, base);
      std::vector<uint64_t> applied = base;
      ASSERT_OK(apply_delta(bytes_of(applied), byte_count(applied), delta.data(), count_of(delta)));
      ASSERT_EQ(applied, now) << seed;
      OwnedWorld other = make_turmoiled(seed + 1, 10);
      ASSERT_OK(restore_delta(other.world, bytes_of(base), byte_count(base), delta.data(), count_of(delta)));
      ASSERT_EQ(save_all(other.world), now) << seed;
      ASSERT_OK(load(other.world, bytes_of(applied), byte_count(applied)));
      ASSERT_EQ(digest(other.world), digest(owned.world)) << seed;
      make_turmoil(owned.world, seed);
    }
  }
}

DETENT_TEST(delta, is_as_its_format_says) {
  Lab lab({1, 0, 0});
  lab.add({});
  std::vector<uint64_t> base = lab.snapshot();
  EXPECT_EQ(delta_of(lab.world, base).size(), 24u) << "nothing has changed";
  ASSERT_OK(set_user_data(lab.world, next_body(lab.world, {}), 0x01000203));
  const std::vector<uint64_t> now = lab.snapshot();
  uint32_t word = 6;  // behind the header
  while (now[word] == base[word]) ++word;
  const Bytes delta = delta_of(lab.world, base);
  Bytes expected = {0x44, 0x4e, 0x44, 0x4c, 1, 0, 0, 0};
  expected.resize(16);
  const uint32_t total = byte_count(base);
  for (uint32_t i = 0; i < 8; ++i) expected.push_back(static_cast<uint8_t>(uint64_t{total} >> (8 * i)));
  expected.push_back(0);
  expected.push_back(static_cast<uint8_t>(word - 6));
  ASSERT_LT(word - 6, 128u);
  // user_data is the lower or the upper half of its 64-bit word.
  const bool upper = bytes_of(base)[8 * word + 4] == 0 && delta[26] > 15;
  expected.push_back(upper ? 0xb0 : 0x0b);
  for (const uint8_t byte : {uint8_t{3}, uint8_t{2}, uint8_t{1}}) expected.push_back(byte);
  EXPECT_EQ(delta, expected);
}

DETENT_TEST(delta, a_buffer_that_is_too_small_by_any_count_is_refused) {
  OwnedWorld owned = make_turmoiled(3, 10);
  std::vector<uint64_t> base = save_all(owned.world);
  make_turmoil(owned.world, 3);
  const Bytes whole = delta_of(owned.world, base);
  for (uint32_t size = 0; size < count_of(whole); ++size) {
    Bytes small(size + 1, 0xee);
    uint32_t bytes = 77;
    ASSERT_EQ(save_delta(owned.world, bytes_of(base), byte_count(base), small.data(), size, bytes),
              Status::buffer_too_small);
    ASSERT_EQ(bytes, 77u);
    ASSERT_EQ(small[size], 0xee);
  }
  Bytes exact(whole.size());
  uint32_t bytes = 0;
  EXPECT_OK(save_delta(owned.world, bytes_of(base), byte_count(base), exact.data(), count_of(exact), bytes));
  EXPECT_EQ(exact, whole);
}

DETENT_TEST(delta, bad_arguments_are_refused_and_change_nothing) {
  OwnedWorld owned = make_turmoiled(3, 10);
  World& world = owned.world;
  std::vector<uint64_t> base = save_all(world);
  make_turmoil(world, 3);
  const Bytes delta = delta_of(world, base);
  const uint64_t before = digest(world);
  const std::vector<uint64_t> same = base;
  const uint32_t total = byte_count(base), count = count_of(delta);
  Bytes out(delta_bytes_max(k_turmoil_capacity));
  uint32_t bytes = 0;
  EXPECT_EQ(save_delta(world, nullptr, total, out.data(), count_of(out), bytes), Status::truncated);
  EXPECT_EQ(save_delta(world, bytes_of(base), total - 1, out.data(), count_of(out), bytes), Status::truncated);
  EXPECT_EQ(save_delta(world, bytes_of(base), total, nullptr, count_of(out), bytes), Status::buffer_too_small);
  const auto refused = [&](const Bytes& bad, uint32_t base_count, Status expected) {
    EXPECT_EQ(apply_delta(bytes_of(base), base_count, bad.data(), count_of(bad)), expected);
    EXPECT_EQ(base, same);
    if (base_count == total) {
      EXPECT_EQ(restore_delta(world, bytes_of(base), total, bad.data(), count_of(bad)), expected);
      EXPECT_EQ(digest(world), before);
    }
  };
  EXPECT_EQ(apply_delta(nullptr, total, delta.data(), count), Status::truncated);
  EXPECT_EQ(apply_delta(bytes_of(base), total, nullptr, count), Status::truncated);
  refused(delta, 40, Status::truncated);
  refused(delta, total - 8, Status::capacity_differs);
  Bytes bad = delta;
  bad[0] ^= 1;
  refused(bad, total, Status::not_detent);
  bad = delta;
  bad[4] ^= 2;
  refused(bad, total, Status::format_unknown);
  bad = delta;
  bad[8] ^= 1;
  refused(bad, total, Status::bad_argument);
  const auto of_words = [&](const Bytes& words) {
    Bytes made(delta.begin(), delta.begin() + 24);
    made.insert(made.end(), words.begin(), words.end());
    return made;
  };
  refused(of_words({0}), total, Status::corrupt);                                // no count
  refused(of_words({0, 0}), total, Status::corrupt);                             // of no words
  refused(of_words({0, 0xff, 0xff, 0xff, 0xff, 0x0f}), total, Status::corrupt);  // beyond the end
  refused(of_words({0, 0xff, 0xff, 0xff, 0xff, 0x1f}), total, Status::corrupt);  // beyond 32 bits
  refused(of_words({0, 0xff, 0xff, 0xff, 0xff, 0xff, 0}), total, Status::corrupt);
  refused(of_words({0x81, 1}), total, Status::corrupt);  // a byte is missing
  Bytes rest = {0};                                      // to the last word, and one more
  uint32_t words = (total - 48) / 8;
  for (; words >= 128; words >>= 7) rest.push_back(static_cast<uint8_t>(words | 128));
  rest.push_back(static_cast<uint8_t>(words));
  EXPECT_OK(apply_delta(bytes_of(base), total, of_words(rest).data(), 24 + count_of(rest)));
  rest.push_back(1);
  rest.push_back(1);
  refused(of_words(rest), total, Status::corrupt);
  for (std::ptrdiff_t size = 0; size < 24; ++size) {
    refused(Bytes(delta.begin(), delta.begin() + size), total, Status::truncated);
  }
  OwnedWorld other(OwnedWorld::def_of({2, 2, 0}));
  EXPECT_EQ(restore_delta(other.world, bytes_of(base), total, delta.data(), count), Status::capacity_differs);
  EXPECT_EQ(save_delta(other.world, bytes_of(base), total, out.data(), count_of(out), bytes), Status::capacity_differs);
  EXPECT_EQ(delta_bytes_max({0, 1, 1}), 0u);
}

DETENT_TEST(delta, with_any_bit_flipped_is_refused_or_harmless) {
  Lab lab({4, 6, 0});
  lab.add_ground();
  lab.add_box(0.5, 0, 0.5, 0);
  lab.add_box(0.5, 0.1, 1.5, 0);
  lab.run(3);
  std::vector<uint64_t> base = lab.snapshot();
  lab.run(1);
  const Bytes delta = delta_of(lab.world, base);
  Lab other({4, 6, 0});
  uint32_t refused = 0, let_in = 0;
  for (uint32_t bit = 0; bit < 8 * count_of(delta); ++bit) {
    Bytes flipped = delta;
    flipped[bit / 8] = static_cast<uint8_t>(flipped[bit / 8] ^ 1u << bit % 8);
    std::vector<uint64_t> applied = base;
    const uint64_t before = digest(other.world);
    Status status = apply_delta(bytes_of(applied), byte_count(applied), flipped.data(), count_of(flipped));
    if (status != Status::ok) {
      ASSERT_EQ(applied, base);
    } else {
      status = load(other.world, bytes_of(applied), byte_count(applied));
    }
    if (status != Status::ok) {
      ++refused;
      ASSERT_EQ(digest(other.world), before);
      continue;
    }
    ++let_in;
    const uint64_t tick = get_info(other.world).tick;
    step(other.world);
    ASSERT_EQ(step(other.world).tick, tick + 2);
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(let_in, 100u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
