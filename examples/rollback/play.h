#pragma once
#include <memory>

#include "examples/rollback/lobby.h"
#include "examples/rollback/view.h"

namespace detent_rollback {

/// Runs a network match in real time, to its end.
class Play {
 public:
  Play(Transport& transport, const Peers& peers, const Welcome& welcome, const Options& options);

  /// Runs until the match is over and all players have sent their results, or the host is gone, or `stop` is set.
  void run(const volatile int& stop);
  /// Prints the results, one a line.
  void print_summary() const;
  /// Whether all ticks were made, no checksum differed, and all remaining players ended with the same digest.
  bool is_good() const;

  const detent::pitch::Match& match() const { return match_; }

 private:
  double now() const;
  void receive();
  void take(uint32_t player, const Transport::Event& event);
  void frame();
  void lose(uint32_t player);
  bool is_host() const { return match_.def().player == 0; }
  bool all_have_ended() const;
  void say_farewell(uint32_t player);
  void end();
  void show();

  Transport& transport_;
  const Peers peers_;
  const Welcome welcome_;
  const Options options_;
  Conditioner link_;  ///< every packet of this machine passes through it
  detent::pitch::Match match_;
  std::unique_ptr<Keyboard> keyboard_;  ///< null where a bot plays
  const double start_;                  ///< s, of the host's clock
  double next_frame_ = 0;               ///< s of the match's clock, as the two times below
  double last_progress_ = 0;            ///< the time of the last new tick, or of the last result received
  double last_shown_ = 0;
  bool over_ = false;
  bool host_is_gone_ = false;
  bool has_ended_[k_players_max] = {};  ///< the players that have sent their results
  uint64_t digests_[k_players_max] = {};
};

}  // namespace detent_rollback
