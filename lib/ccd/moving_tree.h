#pragma once
#include "broad_phase/resting_tree.h"
#include "ccd/spare_memory.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_TASKS
/// The moving bodies in a tree by the bounds of their sweeps. The first searches of a tick visit the list of all moving
/// bodies. If a tick has many searches, the tree is made in spare memory and later searches use it. A search finds the
/// same bodies in both ways.
class MovingTree {
 public:
  bool is_made() const { return parents_.count != 0; }
  /// To be called before each search. Makes the tree when the searches so far have cost about as much as making it.
  void prepare(BitSet active, Span<const Bounds> bounds, SpareMemory& spare) {
    if (++searches_ == k_searches_max) make(active, bounds, spare);
  }
  /// Returns false if there is too little memory.
  bool make(BitSet active, Span<const Bounds> bounds, SpareMemory& spare) {
    if (is_made()) return true;
    parents_ = spare.take<uint32_t>(bounds.count);
    nodes_ = spare.take<TreeNode>(bounds.count);
    if (nodes_.count == 0) parents_ = {};
    if (!is_made()) return false;
    tree(bounds).make_empty();
    active.for_each([&](uint32_t slot) { insert(slot, bounds); });
    return true;
  }
  RestingTree tree(Span<const Bounds> bounds) { return {root_, nodes_, parents_, bounds}; }
  void insert(uint32_t slot, Span<const Bounds> bounds) {
    if (is_made() && !tree(bounds).has(slot)) tree(bounds).insert(slot);
  }
  /// To be called before the bounds of a body change; insert() is called afterwards.
  void remove(uint32_t slot, Span<const Bounds> bounds) {
    if (is_made() && tree(bounds).has(slot)) tree(bounds).remove(slot);
  }

 private:
  /// Making a tree takes about as long as this number of visits to the whole list of moving bodies.
  static constexpr uint32_t k_searches_max = 48;

  uint32_t searches_ = 0;
  TreeRoot root_ = {};
  Span<TreeNode> nodes_;
  Span<uint32_t> parents_;
};
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
