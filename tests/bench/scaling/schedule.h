#pragma once
#include "tests/bench/scaling/engine.h"

/// The time of a tick on more threads than the machine has.
namespace detent_bench {

/// Work of a tick in shared loops, as a share of the whole tick.
double shared_part(const TickRecord& tick);
/// The time, ns, of a recorded tick on so many threads: a greedy list schedule gives each part to the thread that is
/// free first. A loop costs `cost.loop` for each doubling of the number of threads, a group `cost.group`.
double scheduled_ns(const TickRecord& tick, uint32_t threads, const SharingCost& cost);

}  // namespace detent_bench
