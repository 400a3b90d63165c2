#pragma once
#include "replay/sparse_tick.h"

/// Makes the report of a step in which only some bodies are simulated, the bodies *inside* (sparse_tick.h).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether the step dropped nothing for lack of room, and decided every test of a sensor. The results are then the same
/// as if each island had pools and buffers of its own.
bool is_whole(const StepReport& report);

/// Returns the value of TickHead::buffers for a world with these hooks.
uint32_t buffers_of(const WorldHooks& hooks);

/// Replaces the contribution of the bodies inside (those that the step simulates) in each count of `total` that is a
/// sum over islands, pairs or bodies. Subtracts the count of `base`, the report of their run from the recorded state.
/// Adds the count of `made`, the report of their run from the present state.
void replace_sums(const StepReport& base, const StepReport& made, StepReport& total);

/// Does the same as replace_sums() for the counts of what a step used of pools and budgets.
void replace_use(const StepProbe& base, const StepProbe& made, TickHead& total);

/// Whether a step of the whole world with these counts has room in every pool, and does not use up the budget of work
/// of impacts.
bool has_room(const TickHead& total, Capacity capacity);

/// Returns the largest number of substeps of any island. `most`: the largest number among the islands of the bodies
/// inside, which the step simulates. The numbers of the other islands are in the recorded states of their bodies.
uint32_t most_substeps(const SparseTick& tick, uint32_t most);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
