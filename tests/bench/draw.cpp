#include "tests/bench/draw.h"

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace detent_bench {

bool draw(const std::string& folder, const std::string& name, const std::string& json) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string file = folder + "/" + name;
  std::ofstream(file) << json;
  const pid_t child = fork();  // Debian's Python: another one in the path would not have its packages
  if (child == 0) {
    // -B: nothing is left beside plot.py.
    execl("/usr/bin/python3", "python3", "-B", DETENT_BENCH_PLOT, file.c_str(), folder.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = -1;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace detent_bench
