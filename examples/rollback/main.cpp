#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "examples/recording_file.h"
#include "examples/rollback/play.h"

namespace {

using namespace detent_rollback;

volatile sig_atomic_t stop = 0;

/// Splits "HOST:PORT" into the options. False if it has another form.
bool split(const std::string& there, Options& options) {
  const size_t colon = there.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  const long port = strtol(there.c_str() + colon + 1, nullptr, 10);
  if (port < 1 || port > 65535) return false;
  options.address = there.substr(0, colon);
  options.port = static_cast<uint16_t>(port);
  return true;
}

/// Writes a recording of the confirmed match, from its first tick on, for `detent verify`.
bool record(const Play& play, const std::string& path) {
  RecordingFile file(path.c_str());
  const auto& match = play.match();
  const uint64_t digest =
      file.is_open() ? detent::pitch::replay_inputs(match.confirmed_inputs(), match.def().players, file.sink()) : 0;
  if (digest == 0 || !file.close()) {
    fprintf(stderr, "rollback: %s cannot be written\n", path.c_str());
    return false;
  }
  if (match.is_over() && digest != detent::digest(match.world())) {
    fprintf(stderr, "rollback: the confirmed inputs do not lead to the match's end\n");
    return false;
  }
  printf("recorded %s\n", path.c_str());
  return true;
}

int run(const Options& options) {
  Transport transport;
  Welcome welcome;
  Peers peers;
  if (options.hosts) {
    if (!transport.listen(options.port, options.players + 7)) {
      fprintf(stderr, "rollback: port %u is taken\n", options.port);
      return 1;
    }
    fprintf(stderr, "waiting for %u more at port %u\n", options.players - 1, options.port);
    if (!gather(transport, options, stop, welcome, peers)) return 1;
  } else {
    const bool is_on_its_way = transport.connect(options.address.c_str(), options.port);
    const char* const problem =
        is_on_its_way ? join(transport, options, stop, welcome, peers) : "there is no machine of this name";
    if (problem != nullptr) {
      fprintf(stderr, "rollback: %s:%u: %s\n", options.address.c_str(), options.port, problem);
      return 1;
    }
  }
  Play play(transport, peers, welcome, options);
  play.run(stop);
  fprintf(stderr, "\n");
  play.print_summary();
  const bool is_recorded = options.recording.empty() || record(play, options.recording);
  return play.is_good() && is_recorded ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::string there;
  double loss = 0, latency = 0, jitter = 0, duplicate = 0;
  CLI::App app(
      "A game of physics for two to four players over a network, with rollback.\n"
      "One hosts, the others join: rollback --host 7000, rollback --join 127.0.0.1:7000");
  auto* const host =
      app.add_option("--host", options.port, "host a match at this UDP port")->check(CLI::Range(1, 65535));
  auto* const joins = app.add_option("--join", there, "join the host at HOST:PORT")->excludes(host);
  app.add_option("--key", options.key, "a number that the host and its guests know")->capture_default_str();
  app.add_option("--delay", options.delay, "ticks from an input to its effect; each player has their own")
      ->check(CLI::Range(0u, k_window_max))
      ->capture_default_str();
  app.add_flag("--bot,--headless", options.bot, "a bot plays here, and nothing is drawn");
  app.add_option("--record", options.recording, "write the match to this file, for detent verify");

  app.add_option("--players", options.players, "how many play")
      ->check(CLI::Range(2u, k_players_max))
      ->capture_default_str()
      ->group("Host");
  app.add_option("--ticks", options.ticks, "how long: 60 a second")
      ->check(CLI::Range(1u, k_ticks_max))
      ->capture_default_str()
      ->group("Host");
  app.add_option("--window", options.window, "ticks that a machine may run ahead of the last tick with all inputs")
      ->check(CLI::Range(1u, k_window_max))
      ->capture_default_str()
      ->group("Host");
  app.add_option("--speed", options.speed, "times faster than life, in tests")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str()
      ->group("Host");
  app.add_option("--seed", options.seed, "seed of the random numbers of bots and bad links")
      ->capture_default_str()
      ->group("Host");

  const char* const bad = "A bad link, for what this machine sends";
  app.add_option("--loss", loss, "%")->check(CLI::Range(0.0, 100.0))->group(bad);
  app.add_option("--duplicate", duplicate, "%")->check(CLI::Range(0.0, 100.0))->group(bad);
  app.add_option("--latency", latency, "ms, one way")->check(CLI::Range(0.0, 10000.0))->group(bad);
  app.add_option("--jitter", jitter, "ms more or less, so that packets overtake each other")
      ->check(CLI::Range(0.0, 10000.0))
      ->group(bad);
  CLI11_PARSE(app, argc, argv);

  options.hosts = host->count() != 0;
  options.conditions = {loss / 100, duplicate / 100, latency / 1000, jitter / 1000};
  if (options.hosts == (joins->count() != 0) || (!options.hosts && !split(there, options))) {
    fprintf(stderr, "rollback: say either --host PORT or --join HOST:PORT\n");
    return 2;
  }
  signal(SIGINT, [](int) { stop = 1; });
  signal(SIGTERM, [](int) { stop = 1; });
  return run(options);
}
