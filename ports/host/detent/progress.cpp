#include "progress.h"

#include <stdio.h>

#include <utility>
#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace detent_tool {

namespace {

constexpr int k_width = 32;
constexpr std::chrono::milliseconds k_patience{500};
constexpr std::chrono::milliseconds k_interval{100};

bool error_is_terminal() {
#if defined(_WIN32)
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) != 0;
#endif
}

}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), terminal_(error_is_terminal()), next_(std::chrono::steady_clock::now() + k_patience) {}

ProgressBar::~ProgressBar() { hide(); }

void ProgressBar::hide() {
  if (shown_) fputs("\r\x1b[K", stderr);
  shown_ = false;
}

void ProgressBar::show(uint64_t done, uint64_t total) {
  if (!terminal_ || total == 0) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + k_interval;
  shown_ = true;
  if (done > total) done = total;
  const double part = static_cast<double>(done) / static_cast<double>(total);
  const int filled = static_cast<int>(part * k_width);
  const std::string bar =
      std::string(static_cast<size_t>(filled), '#') + std::string(static_cast<size_t>(k_width - filled), '.');
  fprintf(stderr, "\r\x1b[K%s [%s] %3d %%", label_.c_str(), bar.c_str(), static_cast<int>(part * 100));
  fflush(stderr);
}

}  // namespace detent_tool
