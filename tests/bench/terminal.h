#pragma once
#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

#include <string>
#include <utility>

namespace detent_bench {

/// A line on standard error, on a terminal only, renewed as work goes on.
class Line {
 public:
  explicit Line(std::string label) : label_(std::move(label)) {}
  ~Line() {
    if (shown_) fputs("\r\x1b[K", stderr);
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  void show(uint64_t done, uint64_t total) {
    const int percent = static_cast<int>(done * 100 / total);
    if (percent == percent_ || isatty(STDERR_FILENO) == 0) return;
    percent_ = percent;
    shown_ = true;
    fprintf(stderr, "\r\x1b[K%s: %d %%", label_.c_str(), percent);
    fflush(stderr);
  }

 private:
  std::string label_;
  int percent_ = -1;
  bool shown_ = false;
};

}  // namespace detent_bench
