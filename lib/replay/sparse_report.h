#pragma once
#include "replay/sparse_tick.h"

/// The report of a step in which only some bodies are simulated.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether the step dropped nothing for lack of room. Then the results are the same as if each island had pools and
/// buffers of its own.
bool is_whole(const StepReport& report);

/// Returns the value of TickHead::buffers.
uint32_t buffers_of(const WorldHooks& hooks);

/// In each count of `total` that is a sum over islands, pairs or bodies, replaces the part of the bodies inside:
/// subtracts `base`, the report of their run from the recorded state, and adds `made`, the report of their run from the
/// present state.
void replace_sums(const StepReport& base, const StepReport& made, StepReport& total);

/// As replace_sums(), for what a step used of the pools.
void replace_use(const StepProbe& base, const StepProbe& made, TickHead& total);

/// Whether a whole step with these counts would have room in every pool, and would not use up the budget of impacts.
bool has_room(const TickHead& total, Capacity capacity);

/// The largest number of substeps of any island. `most`: the largest number of the islands inside.
uint32_t most_substeps(const SparseTick& tick, uint32_t most);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
