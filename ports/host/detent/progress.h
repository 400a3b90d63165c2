#pragma once
#include <stdint.h>

#include <chrono>
#include <string>

namespace detent_tool {

/// A progress bar on standard error. It appears only on a terminal, after half a second, and disappears when the work
/// is done.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(uint64_t done, uint64_t total);
  /// Removes the bar until its next update. Call this before printing a line.
  void hide();

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace detent_tool
