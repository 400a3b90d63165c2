#pragma once
#include "replay/sparse_tick.h"

/// The report of a step that is made in part.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether the step lost nothing. The pools and buffers are then as if each island had its own.
bool is_whole(const StepReport& report);

/// TickHead::buffers.
uint32_t buffers_of(const WorldHooks& hooks);

/// Replaces, in each count of `total` that is a sum over islands, pairs or bodies, the part `base` by `made`.
void replace_sums(const StepReport& base, const StepReport& made, StepReport& total);

/// The same for what a step used of the pools.
void replace_use(const StepProbe& base, const StepProbe& made, TickHead& total);

/// Whether a whole step of these counts has room in every pool, and does not spend the work of impacts.
bool has_room(const TickHead& total, Capacity capacity);

/// The largest number of substeps of any island: of those inside, `most`, and of the others.
uint32_t most_substeps(const SparseTick& tick, uint32_t most);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
