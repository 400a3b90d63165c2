#include "tests/bench/step_times.h"

#include <math.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "tests/common/support/text_table.h"

namespace detent_bench {

StepTimes step_times(const std::vector<double>& us) {
  if (us.empty()) return {};
  double sum = 0;
  for (const double each : us) sum += each;
  return {sum / static_cast<double>(us.size()), detent_text::quantile(us, 0.5), detent_text::quantile(us, 0.99),
          *std::max_element(us.begin(), us.end())};
}

LeastTimes::LeastTimes(size_t ticks) : us_(ticks, std::numeric_limits<double>::infinity()) {}

void LeastTimes::take(size_t tick, double us) { us_[tick] = std::min(us_[tick], us); }

StepTimes LeastTimes::summary() const {
  std::vector<double> timed;
  std::copy_if(us_.begin(), us_.end(), std::back_inserter(timed), [](double us) { return isfinite(us); });
  return step_times(timed);
}

double Interruptions::own(double ns, uint64_t core_before) {
  constexpr double k_interruption_ns = 20000;
  const double own = static_cast<double>(detent_test::thread_ns() - core_before);
  ++asked_;
  if (ns <= own + k_interruption_ns) return ns;
  ++interrupted_;
  return own;
}

StageShares stage_shares(const detent_test::StageTimes& before, const detent_test::StageTimes& after) {
  uint64_t total = 0;
  const auto spent = [&](size_t i) { return after[i].ns - (i < before.size() ? before[i].ns : 0); };
  for (size_t i = 0; i < after.size(); ++i) total += spent(i);
  StageShares shares;
  for (size_t i = 0; i < after.size() && total != 0; ++i)
    shares.emplace_back(after[i].name, static_cast<double>(spent(i)) / static_cast<double>(total));
  return shares;
}

std::string stages_text(const StageShares& shares) {
  constexpr size_t k_shown = 2;
  StageShares sorted = shares;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string result;
  for (size_t i = 0; i < sorted.size() && i < k_shown; ++i)
    result += (i == 0 ? "" : ", ") + detent_text::text("%s %.0f %%", sorted[i].first.c_str(), 100 * sorted[i].second);
  return result;
}

}  // namespace detent_bench
