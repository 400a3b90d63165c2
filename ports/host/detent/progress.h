#pragma once
#include <stdint.h>

#include <chrono>
#include <string>

namespace detent_tool {

/// A bar on standard error, for work that takes longer than half a second, on a terminal only. Gone when the work is.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(uint64_t done, uint64_t total);
  /// Until it is shown again: before a line is printed.
  void hide();

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace detent_tool
