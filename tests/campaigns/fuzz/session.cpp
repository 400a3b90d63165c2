#include <array>
#include <map>

#include "tests/campaigns/fuzz/targets.h"
#include "tests/campaigns/sequences/draw.h"
#include "tests/unit/replay/arena.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

constexpr uint32_t k_calls_max = 200, k_window_max = 8;

using Input = std::array<uint8_t, k_arena_input_bytes>;

/// A session that hears anything, against what its documentation says: inputs that were taken stay, what is confirmed
/// stays, and the world is as if it had been made with the inputs that are known, the others repeated.
class Heard {
 public:
  explicit Heard(const Bytes& tape) : draw_(tape.data(), tape.size()), arena_(1 + draw_.below(k_arena_players_max)) {
    def_.players = get_info(world()).bodies - 1;
    def_.local = draw_.below(1u << (def_.players + (draw_.bad() ? 1 : 0)));
    def_.input_bytes = k_arena_input_bytes;
    def_.window = 1 + draw_.below(k_window_max);
    def_.delay = draw_.below(def_.window + (draw_.bad() ? 2 : 1));
    def_.checksum_interval = draw_.below(4);
    def_.game_bytes = sizeof(Arena::Score);
  }

  /// False if there is no such session.
  bool play() {
    const bool wrong = def_.local >> def_.players != 0 || def_.delay > def_.window;
    std::vector<uint64_t> memory(rollback_bytes(Arena::k_capacity, def_) / 8);
    const Status status =
        session_.begin(world(), def_, arena_.maker(), bytes_of(memory), byte_count(memory), arena_.state());
    EXPECT_EQ(status != Status::ok, wrong);
    if (status != Status::ok) return false;
    for (uint32_t player = 0; player < def_.players; ++player) {
      for (uint64_t tick = 0; is_local(player) && tick < def_.delay; ++tick) known_[player][tick] = {};
    }
    for (uint32_t call = 0; call < k_calls_max && !draw_.ended() && !testing::Test::HasFailure(); ++call) {
      call_anything();
      check_confirmed();
    }
    RollbackReport report;
    EXPECT_OK(session_.correct(world(), report));
    check_confirmed();
    check_world();
    return true;
  }

 private:
  World& world() { return arena_.owned.world; }
  bool is_local(uint32_t player) const { return (def_.local >> player & 1) != 0; }

  Input any_input() {
    const uint32_t push = draw_.below(256), box = draw_.below(4);
    return {static_cast<uint8_t>(push), static_cast<uint8_t>(box)};
  }
  /// Near those that matter, or far from all.
  uint64_t any_tick(uint32_t player) {
    const uint64_t near = draw_.chance(0.5) ? session_.next_input(player) : session_.tick();
    const uint32_t off = draw_.below(8);
    switch (draw_.below(8)) {
      case 0:
        return near - off;
      case 1:
        return near + uint64_t{off} * def_.window;
      case 2:
        return draw_.chance(0.5) ? UINT64_MAX - off : uint64_t{draw_.word()} << off;
      default:
        return near + off / 2;
    }
  }

  void call_anything() {
    const uint32_t player = draw_.below(def_.players + (draw_.bad() ? 2 : 0));
    switch (draw_.below(8)) {
      case 0:
        return hear(player, any_tick(player), any_input());
      case 1:
        return hear_many(player);
      case 2:
        return hear_checksum(player);
      case 3:
        return ask(player);
      case 4: {
        RollbackReport report;
        EXPECT_OK(session_.correct(world(), report));
        if (draw_.chance(0.1)) check_world();
        return;
      }
      default:
        return advance();
    }
  }

  /// What is not known yet, in order, as far ahead as it will take.
  void hear_many(uint32_t player) {
    Input input = any_input();
    for (uint32_t left = draw_.below(64); left != 0; --left) {
      hear(player, session_.next_input(player), input);
      input[0] = static_cast<uint8_t>(input[0] + 7);
    }
  }
  void hear(uint32_t player, uint64_t tick, const Input& input) {
    const Status status = session_.add_input(player, tick, input.data());
    if (player >= def_.players || is_local(player)) {
      EXPECT_EQ(status, Status::bad_argument);
      return;
    }
    EXPECT_TRUE(status == Status::ok || status == Status::out_of_range) << status_text(status);
    if (status == Status::ok) known_[player].emplace(tick, input);  // what is known already stays
  }

  void advance() {
    for (uint32_t player = 0; player < def_.players; ++player) {
      if (!is_local(player) || draw_.bad()) continue;
      const Input input = any_input();
      uint64_t tick = 0;
      if (session_.add_local_input(player, input.data(), tick) == Status::ok) {
        EXPECT_TRUE(known_[player].emplace(tick, input).second);
      }
    }
    const uint64_t before = session_.tick();
    RollbackReport report;
    const Status status = session_.advance(world(), report);
    EXPECT_TRUE(status == Status::ok || status == Status::waiting || status == Status::bad_argument);
    EXPECT_EQ(session_.tick(), before + (status == Status::ok ? 1 : 0));
    EXPECT_EQ(get_info(world()).tick, session_.tick());
  }

  void ask(uint32_t player) {
    const uint64_t tick = any_tick(player);
    Input input;
    if (session_.get_input(player, tick, input.data()) != Status::ok) return;
    EXPECT_TRUE(known_[player].count(tick) != 0 && known_[player][tick] == input) << tick;
  }

  /// The right one, if it is known, or any.
  void hear_checksum(uint32_t player) {
    TickChecksum theirs;
    theirs.tick = any_tick(player);
    theirs.checksum = draw_.word();
    const auto own = confirmed_.find(theirs.tick);
    const bool right = own != confirmed_.end() && draw_.chance(0.8);
    if (right) theirs.checksum = own->second;
    const Status status = session_.add_checksum(player, theirs);
    lied_ = lied_ || (!right && (status == Status::ok || status == Status::digest_differs));
    EXPECT_TRUE(session_.desync().found || status != Status::digest_differs);
  }

  /// Confirmed ticks and their checksums stay.
  void check_confirmed() {
    EXPECT_GE(session_.confirmed_tick(), confirmed_tick_);
    EXPECT_LE(session_.confirmed_tick(), session_.tick());
    confirmed_tick_ = session_.confirmed_tick();
    TickChecksum last[4];
    const uint32_t count = session_.checksums(last, 4);
    for (uint32_t i = 0; i < count; ++i) {
      EXPECT_LE(last[i].tick, confirmed_tick_);
      EXPECT_EQ(confirmed_.emplace(last[i].tick, last[i].checksum).first->second, last[i].checksum);
    }
    EXPECT_TRUE(lied_ || !session_.desync().found);
  }

  void check_world() {
    Arena straight(def_.players);
    std::vector<Input> inputs(def_.players);
    for (uint64_t tick = 0; tick < session_.tick(); ++tick) {
      for (uint32_t player = 0; player < def_.players; ++player) {
        const auto known = known_[player].find(tick);
        if (known != known_[player].end()) inputs[player] = known->second;
      }
      Arena::make(&straight, straight.owned.world,
                  {tick, inputs[0].data(), def_.players, k_arena_input_bytes, 0, false});
    }
    EXPECT_EQ(arena_.sum(), straight.sum()) << session_.tick();
  }

  Draw draw_;
  Arena arena_;
  RollbackDef def_;
  RollbackSession session_;
  std::map<uint64_t, Input> known_[k_arena_players_max];
  std::map<uint64_t, uint32_t> confirmed_;
  uint64_t confirmed_tick_ = 0;
  bool lied_ = false;
};

bool take(const Bytes& bytes) { return Heard(bytes).play(); }

std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  detent_queries::Random random(1);
  while (made.size() < 8) {
    Bytes tape(1500);
    for (uint8_t& byte : tape) byte = static_cast<uint8_t>(random.below(256));
    if (take(tape)) made.push_back(tape);
  }
  return made;
}

}  // namespace

const detent_fuzz::Target k_session_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
