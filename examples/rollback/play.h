#pragma once
#include <memory>

#include "examples/rollback/lobby.h"
#include "examples/rollback/view.h"

namespace detent_rollback {

/// A match over the network, by the clock, to its end.
class Play {
 public:
  Play(Transport& transport, const Peers& peers, const Welcome& welcome, const Options& options);

  /// Until the match is over and all have said how it ended, the host is gone, or `stop` is set.
  void run(const volatile int& stop);
  /// All that is to be said of it, in lines.
  void print_summary() const;
  /// Whether all ticks were made, and all that are left ended with the same digest and never differed.
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
  Conditioner link_;  ///< what this machine sends goes through it
  detent::pitch::Match match_;
  std::unique_ptr<Keyboard> keyboard_;  ///< null where a bot plays
  const double start_;                  ///< s, of the host's clock
  double next_frame_ = 0;               ///< s of the match's clock, as all that follow
  double last_progress_ = 0;            ///< when a tick was made for the last time, or an end heard of
  double last_shown_ = 0;
  bool over_ = false;
  bool host_is_gone_ = false;
  bool has_ended_[k_players_max] = {};  ///< who has said how it ended
  uint64_t digests_[k_players_max] = {};
};

}  // namespace detent_rollback
