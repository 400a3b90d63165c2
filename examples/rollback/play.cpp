#include "examples/rollback/play.h"

#include <inttypes.h>
#include <stdio.h>

#include <chrono>

namespace detent_rollback {

using detent::pitch::MatchDef;

namespace {

constexpr double k_patience = 10;       ///< s without progress before a player is dropped
constexpr double k_debt_max = 0.25;     ///< s of ticks that are caught up at once after a pause
constexpr double k_shown_every = 0.25;  ///< s

double host_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

MatchDef match_def(const Welcome& welcome, const Options& options) {
  const uint32_t delay = std::min(options.delay, welcome.window);
  return {welcome.match, welcome.player, welcome.players, welcome.window, delay, welcome.ticks};
}

}  // namespace

Play::Play(Transport& transport, const Peers& peers, const Welcome& welcome, const Options& options)
    : transport_(transport),
      peers_(peers),
      welcome_(welcome),
      options_(options),
      link_(options.conditions, welcome.seed * k_players_max + welcome.player),
      match_(match_def(welcome, options)),
      keyboard_(options.bot ? nullptr : new Keyboard),
      start_(host_seconds()) {}

double Play::now() const { return (host_seconds() - start_) * welcome_.speed / 100; }

void Play::run(const volatile int& stop) {
  while (!over_ && stop == 0) {
    receive();
    link_.deliver_due(now(), [&](uint32_t player, const uint8_t* bytes, uint32_t count) {
      if (match_.speaks_with(player)) transport_.send(peers_.peer[player], bytes, count, false);
    });
    if (now() >= next_frame_) frame();
    end();
  }
  transport_.close(2000);
}

/// Handles all events that have arrived; if a frame is not due yet, waits up to a millisecond for the first one.
void Play::receive() {
  for (uint32_t wait = now() < next_frame_ ? 1 : 0;; wait = 0) {
    const Transport::Event event = transport_.next(wait);
    if (event.kind == Transport::Kind::nothing) return;
    const uint32_t player = peers_.player_at(event.peer);
    if (player == k_players_max || !match_.speaks_with(player)) {
      if (event.kind != Transport::Kind::left) transport_.drop(event.peer);  // too late, or a second connection
    } else if (event.kind == Transport::Kind::left) {
      lose(player);
    } else {
      take(player, event);
    }
  }
}

void Play::take(uint32_t player, const Transport::Event& event) {
  const uint32_t count = static_cast<uint32_t>(event.bytes.size());
  Farewell farewell;
  if (!has_ended_[player] && read_farewell(event.bytes.data(), count, farewell) && farewell.match == welcome_.match) {
    last_progress_ = now();
    has_ended_[player] = true;
    digests_[player] = farewell.digest;
    return;
  }
  if (match_.take(player, event.bytes.data(), count, now()) != Verdict::refused || !match_.is_hostile(player)) return;
  lose(player);
}

void Play::lose(uint32_t player) {
  transport_.drop(peers_.peer[player]);
  if (is_host()) {
    match_.leave(player);
  } else {
    host_is_gone_ = over_ = !has_ended_[player];
  }
}

void Play::frame() {
  const uint64_t tick = match_.session().tick();
  const uint64_t for_tick = match_.input_tick();
  match_.frame(keyboard_ ? keyboard_->input() : detent::pitch::bot_input(welcome_.seed, welcome_.player, for_tick));
  for (uint32_t player = 0; player < welcome_.players; ++player) {
    uint8_t bytes[k_message_bytes_max];
    if (match_.speaks_with(player)) link_.send(player, bytes, match_.write_for(player, bytes), now());
  }
  // A machine that is ahead slows down, by at most a fifth, until the others have caught up.
  next_frame_ += (1 + std::min(match_.ticks_ahead(), 4.0) * 0.05) / 60;
  next_frame_ = std::max(next_frame_, now() - k_debt_max);

  if (match_.session().tick() != tick || match_.is_over()) last_progress_ = std::max(last_progress_, now());
  const uint32_t slowest = match_.slowest();
  if (now() - last_progress_ > k_patience * welcome_.speed / 100 && match_.speaks_with(slowest)) lose(slowest);
  if (now() - last_shown_ >= k_shown_every * welcome_.speed / 100) show();
}

bool Play::all_have_ended() const {
  for (uint32_t player = 0; player < welcome_.players; ++player) {
    if (match_.speaks_with(player) && !has_ended_[player]) return false;
  }
  return true;
}

void Play::say_farewell(uint32_t player) {
  uint8_t bytes[k_message_bytes_max];
  const Farewell farewell = {welcome_.match, digests_[welcome_.player]};
  transport_.send(peers_.peer[player], bytes, write_farewell(farewell, bytes), true);
}

/// A client sends its result to the host when it has all inputs. The host sends its result when it has the results of
/// all clients: until then they need its packets.
void Play::end() {
  if (over_ || !match_.is_over()) return;
  const bool said = has_ended_[welcome_.player];
  has_ended_[welcome_.player] = true;
  digests_[welcome_.player] = detent::digest(match_.world());
  if (!is_host() && !said) say_farewell(0);
  if (!all_have_ended()) return;
  for (uint32_t player = 1; is_host() && player < welcome_.players; ++player) {
    if (match_.speaks_with(player)) say_farewell(player);
  }
  over_ = true;
}

bool Play::is_good() const {
  if (!match_.is_over() || match_.session().desync().found) return false;
  for (uint32_t player = 0; player < welcome_.players; ++player) {
    if (match_.speaks_with(player) && !(has_ended_[player] && digests_[player] == digests_[welcome_.player]))
      return false;
  }
  return true;
}

void Play::show() {
  last_shown_ = now();
  const auto& figures = match_.figures();
  const double ping = match_.round_trip_ticks() * 1000 / 60;
  if (keyboard_) fputs(draw(match_.world()).c_str(), stderr);
  fprintf(stderr, "\rtick %" PRIu64 "/%" PRIu32 "  ping %.0f ms  rollbacks %.1f/s  waits %" PRIu64 "\x1b[K",
          match_.session().tick(), welcome_.ticks, ping, static_cast<double>(figures.rollbacks) / now(), figures.waits);
}

void Play::print_summary() const {
  const auto& figures = match_.figures();
  const detent::Desync& desync = match_.session().desync();
  printf("player %" PRIu32 " of %" PRIu32 ", %" PRIu64 " ticks, digest %016" PRIx64 "\n", welcome_.player,
         welcome_.players, match_.session().tick(), detent::digest(match_.world()));
  printf("rollbacks %" PRIu64 ", ticks made again %" PRIu64 ", longest %" PRIu64 ", waits %" PRIu64 "\n",
         figures.rollbacks, figures.ticks_again, figures.longest_rollback, figures.waits);
  printf("packets out %" PRIu64 ", in %" PRIu64 ", repeated %" PRIu64 ", refused %" PRIu64 "\n", figures.packets_out,
         figures.packets_in, figures.repeated, match_.refused());
  const double seconds = static_cast<double>(match_.session().tick()) / 60;
  printf("bytes a second out %.0f, in %.0f\n", static_cast<double>(transport_.bytes_out()) / seconds,
         static_cast<double>(transport_.bytes_in()) / seconds);
  for (uint32_t player = 0; player < welcome_.players; ++player) {
    if (match_.has_left(player)) printf("player %" PRIu32 " has left\n", player);
    if (match_.speaks_with(player) && has_ended_[player] && digests_[player] != digests_[welcome_.player]) {
      printf("player %" PRIu32 " ended with digest %016" PRIx64 "\n", player, digests_[player]);
    }
  }
  if (host_is_gone_) printf("the host is gone\n");
  if (desync.found) printf("out of step with player %" PRIu32 " since tick %" PRIu64 "\n", desync.player, desync.tick);
  printf("%s\n", is_good() ? "all equal" : "not all equal");
}

}  // namespace detent_rollback
