#include "tests/bench/scaling/schedule.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace detent_bench {

namespace {

double work_of(const SharedLoop& loop) {
  double sum = 0;
  for (const double part : loop.parts) sum += part;
  return sum;
}

double span_of(const SharedLoop& loop, uint32_t threads) {
  std::priority_queue<double, std::vector<double>, std::greater<double>> free_at;
  for (uint32_t i = 0; i < threads; ++i) free_at.push(0);
  double end = 0;
  for (const double part : loop.parts) {
    const double done = free_at.top() + part;
    free_at.pop();
    free_at.push(done);
    end = std::max(end, done);
  }
  return end;
}

uint32_t doublings(uint32_t threads) {
  uint32_t count = 0;
  while (1u << count < threads) ++count;
  return count;
}

}  // namespace

double shared_part(const TickRecord& tick) {
  double work = 0;
  for (const SharedLoop& loop : tick.loops) work += work_of(loop);
  return tick.ns > 0 ? work / tick.ns : 0;
}

double scheduled_ns(const TickRecord& tick, uint32_t threads, const SharingCost& cost) {
  double ns = tick.ns;
  if (threads < 2) return ns;
  for (const SharedLoop& loop : tick.loops)
    ns += span_of(loop, threads) - work_of(loop) + cost.loop * doublings(threads);
  return ns + cost.group * tick.groups;
}

}  // namespace detent_bench
