#pragma once
#include <memory>
#include <vector>

#include "examples/rollback/conditioner.h"
#include "examples/rollback/match.h"
#include "tests/common/support/test.h"

/// A match of several machines in one process, with a clock of its own.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct NetworkDef {
  uint32_t players = 2, ticks = 1000;
  uint64_t seed = 1;
  uint32_t window = 16;
  detent_rollback::LinkConditions conditions = {0.05, 0.01, 0.08, 0.04};
};

class Network {
 public:
  explicit Network(const NetworkDef& def) : def_(def) {
    for (uint32_t player = 0; player < def.players; ++player) {
      const pitch::MatchDef match = {7, player, def.players, def.window, 2, def.ticks};
      machines.push_back(std::make_unique<pitch::Match>(match));
      links_.emplace_back(def.conditions, def.seed * 16 + player);
      next_frame_.push_back(0.004 * player);
    }
  }

  /// What every player does.
  uint8_t input(uint32_t player, uint64_t tick) const { return pitch::bot_input(def_.seed, player, tick); }
  /// The digest that all must come to, if nobody leaves.
  uint64_t expected_digest() const {
    std::vector<uint8_t> inputs;
    for (uint64_t tick = 0; tick < def_.ticks; ++tick) {
      for (uint32_t player = 0; player < def_.players; ++player) inputs.push_back(input(player, tick));
    }
    return pitch::replay_inputs(inputs, def_.players, {});
  }

  /// A millisecond in each machine.
  void pass() {
    for (uint32_t player = 0; player < def_.players; ++player) {
      links_[player].deliver_due(now, [&](uint32_t to, const uint8_t* bytes, uint32_t count) {
        if (silent[player]) return;
        EXPECT_NE(machines[to]->take(player, bytes, count, now), detent_rollback::Verdict::refused);
      });
      if (now < next_frame_[player]) continue;
      pitch::Match& match = *machines[player];
      const double ahead = match.ticks_ahead();
      next_frame_[player] += (1 + (ahead > 4 ? 4 : ahead) * 0.05) / 60;
      match.frame(input(player, match.input_tick()));
      for (uint32_t other = 0; other < def_.players; ++other) {
        uint8_t bytes[detent_rollback::k_packet_bytes_max];
        if (!match.speaks_with(other)) continue;
        links_[player].send(other, bytes, match.write_for(other, bytes), now);
      }
    }
    now += 0.001;
  }

  bool is_over() const {
    for (const auto& machine : machines) {
      if (!silent[machine->def().player] && !machine->is_over()) return false;
    }
    return true;
  }
  void play_to_the_end() {
    while (!is_over() && now < def_.ticks / 20.0) pass();
    EXPECT_TRUE(is_over());
  }

  std::vector<std::unique_ptr<pitch::Match>> machines;
  bool silent[pitch::k_players_max] = {};  ///< whose packets nobody gets, and whose end nobody waits for
  double now = 0;

 private:
  NetworkDef def_;
  std::vector<detent_rollback::Conditioner> links_;
  std::vector<double> next_frame_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
