#include "tests/bench/worlds/farm.h"

#include <stdlib.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "tests/bench/timer.h"

namespace detent_bench {

namespace {

/// Seconds that the processes which have ended were on a processor.
double cpu_of_children() {
  rusage use;
  getrusage(RUSAGE_CHILDREN, &use);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

}  // namespace

bool has_tool() { return DETENT_BENCH_TOOL[0] != 0; }

Farm::Farm(const Recordings& recordings) : count_(static_cast<double>(recordings.size())) {
  std::string name = (std::filesystem::temp_directory_path() / "detent-worlds-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return;
  path_ = name;
  for (size_t i = 0; i < recordings.size(); ++i) {
    std::ofstream file(path_ + "/" + std::to_string(i) + ".rec", std::ios::binary);
    file.write(reinterpret_cast<const char*>(recordings[i].data()), static_cast<std::streamsize>(recordings[i].size()));
  }
}

Farm::~Farm() {
  std::error_code error;
  if (!path_.empty()) std::filesystem::remove_all(path_, error);
}

bool Farm::verify(uint32_t jobs, WorldsVerification& result) const {
  const std::string command = std::string("'") + DETENT_BENCH_TOOL + "' verify --jobs " + std::to_string(jobs) + " '" +
                              path_ + "' >/dev/null 2>&1";
  const double cpu = cpu_of_children();
  const uint64_t start = monotonic_ns();
  const bool good = !path_.empty() && system(command.c_str()) == 0;
  const double wall = static_cast<double>(monotonic_ns() - start) * 1e-9;
  result = {jobs, count_ / (cpu_of_children() - cpu), count_ / wall};
  return good;
}

}  // namespace detent_bench
