#pragma once
#include <detent/rollback.h>

#if DETENT_SPARSE

#include "ccd/impact.h"
#include "replay/sparse_tick.h"
#include "state/view.h"

/// Sparse rollback: when a tick is repeated, only the bodies that the changed inputs reach are simulated. All other
/// bodies take the states that were recorded when the tick was last simulated. See docs/design/rollback.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Keeps the states and the records (TickRecord) of the last ticks of a session, and makes the steps of the session
/// from them. The object lies in the session's memory. An *image* is a copy of a world's state in this memory.
class SparseRollback {
 public:
  /// Makes a SparseRollback in `memory`, for worlds with the capacity of `world` and a window of `window` ticks. The
  /// layout of the memory is that of sparse_layout().
  static SparseRollback* begin(uint8_t* memory, const World& world, uint32_t window);

  /// Keeps the state of the world as the start of its next tick. Errors: capacity_differs.
  Status keep(const World& world);
  /// Restores the state at the start of a tick. Keeps the records of this tick and of all later ticks.
  /// Errors: capacity_differs, feature_missing.
  Status restore(World& world, uint64_t tick);
  /// Returns the kept state at the start of one of the last ticks, as a world that must only be read.
  World kept(uint64_t tick) const;
  /// From this call until end_tick(), this object makes the steps of the world, in place of step(). `again`: the tick
  /// is repeated.
  void start_tick(World& world, bool again);
  void end_tick(World& world);

  uint64_t summed = 0;        ///< the first tick whose checksum the session has not taken yet
  uint64_t bodies_again = 0;  ///< number of awake bodies that were simulated again, summed over the repeated ticks
  uint32_t ticks_whole = 0;   ///< number of repeated ticks in which all bodies were simulated

 private:
  static StepReport make_step(void* context, World& world);
  static void note_stage(void* context, const World& world, StepStage stage, uint32_t contacts);

  StateView<uint8_t> image(uint32_t index) const { return view_of(images_ + index * layout_.image_bytes, capacity_); }
  uint32_t start_image(uint64_t tick) const { return static_cast<uint32_t>(tick % (window_ + 1)); }
  TickRecord record_of(uint64_t tick) const;
  StepReport step(World& world);
  StepReport step_whole(World& world, const TickRecord& record);
  bool step_sparse(World& world, const TickRecord& record, StepReport& report);
  bool simulate(World& world, SparseTick& tick, StepReport& base, StepReport& made);
  bool take_known_part(const SparseTick& tick, StepReport& base);
  void keep_part(const SparseTick& tick, const StepReport& made, TickHead& head) const;
  bool run(World& world, SparseTick& tick, const StateView<const uint8_t>& from, const WorldHooks& hooks,
           StepProbe& probe, StepReport& report);
  void reach_at_rest(World& world, Span<Bounds> reach) const;
  void record_events(const World& world, const StepReport& report, const TickRecord& record) const;

  SparseLayout layout_ = {};
  uint8_t *memory_ = nullptr, *images_ = nullptr;
  Capacity capacity_ = {};
  uint32_t window_ = 0;
  uint32_t spare_ = 0;              ///< index of the image that no record uses
  bool again_ = false;              ///< argument `again` of start_tick()
  const uint8_t* block_ = nullptr;  ///< block of the world whose tick is being simulated
  StepObserver observer_ = {};
  const StepObserver* theirs_ = nullptr;  ///< the caller's observer
  bool inside_ = false;                   ///< the step that runs now simulates only some of the bodies
  bool noted_ = false;                    ///< note_stage() has filled `reach_` and `solved_`
  Span<Bounds> reach_ = {};               ///< TickRecord::reach or SparseTick::reach of the step that runs now
  BitSet solved_ = {};                    ///< TickRecord::solved or SparseTick::solved of the step that runs now
  /// What the last runs of the bodies inside (those that are simulated) used of pools and budgets: the run from the
  /// recorded state (base) and the run from the present state (made).
  StepProbe base_probe_ = {}, made_probe_ = {};
};
static_assert(sizeof(SparseRollback) <= k_sparse_control_bytes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
