#pragma once
#include <math.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <vector>

/// Times of calls, and their distribution.
namespace detent_test {

/// The mean, the 99th percentile and the maximum of numbers.
struct Spread {
  double mean, late, most;
};
inline Spread spread_of(std::vector<double> numbers) {
  if (numbers.empty()) return {0, 0, 0};
  std::sort(numbers.begin(), numbers.end());
  const size_t count = numbers.size();
  return {std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(count), numbers[count * 99 / 100],
          numbers.back()};
}

/// The shortest time of a few runs, us.
template <class Run>
double time_of(int runs, const Run& run) {
  using Clock = std::chrono::steady_clock;
  double least = HUGE_VAL;
  for (int i = 0; i < runs; ++i) {
    const Clock::time_point begin = Clock::now();
    run();
    least = std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  return least;
}

/// Times and interval counts of many queries, as rows of docs/feature_toi.md.
struct Figures {
  std::vector<double> times{}, intervals{}, other_times{};

  void print(double turn_max) const {
    const Spread time = spread_of(times), looked = spread_of(intervals);
    printf("| %g rad | %.2f | %.2f | %.2f | %.1f | %.0f | %.2f |\n", turn_max, time.mean, time.late, time.most,
           looked.mean, looked.most, spread_of(other_times).mean);
  }
};

}  // namespace detent_test
