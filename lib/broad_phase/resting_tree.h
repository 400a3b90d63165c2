#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "shape/bounds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The bounds of the bodies that rest, fixed and sleeping ones, as a tree: a step asks it who is near, and changes it
/// only where a body comes to rest or leaves it.
///
/// A binary trie on each body's place: the size of its bounds in steps of 16, so that what is large does not swell the
/// nodes of what is small; then the cell of its centre, of about that size, along a Morton curve; then its slot. So the
/// tree's shape depends on the bodies in it alone, not on how they came, and no way down is longer than k_depth_max.
/// The tree is a cache and in no snapshot: what a query finds does not depend on its shape.
///
/// Nothing recurs and nothing is stacked: ways lead back up by the parents.
/// Source: Morrison, "PATRICIA", 1968; Lauterbach and others, "Fast BVH Construction on GPUs", 2009 (Morton order).
struct RestingTree {
  static constexpr uint32_t k_depth_max = 96;

  TreeRoot& root;
  Span<TreeNode> nodes;       ///< one fewer than bodies
  Span<uint32_t> parents;     ///< of the leaves, by slot
  Span<const Bounds> bounds;  ///< by slot; those of a body in the tree must stay as they are

  void make_empty() const;
  bool has(uint32_t slot) const { return parents[slot] != 0; }
  void insert(uint32_t slot) const;
  void remove(uint32_t slot) const;

  /// Visits the slots of all bodies whose bounds overlap `box`. `visit` must leave the tree as it is.
  template <class Visit>
  void for_each_near(const Bounds& box, const Visit& visit) const {
    const auto meets = [&](const Bounds& bounds_there) {
      ++root.visited;
      return overlap(bounds_there, box);
    };
    walk(
        meets, [](const Bounds&, const Bounds&) { return false; }, visit);
  }

  /// Visits the slots of all bodies that `meets(bounds)`, asked of all that is around them as well, does not rule out,
  /// and changes nothing. Of two branches the second comes first if `swaps(bounds of the first, of the second)`, which
  /// must always say the same.
  template <class Meets, class Swaps, class Visit>
  void walk(const Meets& meets, const Swaps& swaps, const Visit& visit) const {
    if (root.link == 0) return;
    const auto first_of = [&](const TreeNode& node) {
      return node.child[swaps(bounds_of(node.child[0]), bounds_of(node.child[1])) ? 1 : 0];
    };
    uint32_t link = root.link;
    for (;;) {
      if (meets(bounds_of(link))) {
        if (!is_leaf(link)) {
          link = first_of(nodes[index_of(link)]);
          continue;
        }
        visit(index_of(link));
      }
      for (;;) {
        const uint32_t parent = parent_of(link);
        if (parent == k_above_root) return;
        const TreeNode& node = nodes[parent - k_first_parent];
        const bool was_first = first_of(node) == link;
        link = was_first ? node.child[node.child[0] == link ? 1 : 0] : node_link(parent - k_first_parent);
        if (was_first) break;
      }
    }
  }

 private:
  // What a parent field holds: 0 for what is not in the tree, this for what has no parent, else a node's index and 2.
  static constexpr uint32_t k_above_root = 1, k_first_parent = 2;

  // A link leads to a node or a leaf; 0 leads nowhere.
  static constexpr uint32_t node_link(uint32_t index) { return 2 * index + 2; }
  static constexpr uint32_t leaf_link(uint32_t slot) { return 2 * slot + 3; }
  static constexpr bool is_leaf(uint32_t link) { return (link & 1) != 0; }
  static constexpr uint32_t index_of(uint32_t link) { return link / 2 - 1; }

  const Bounds& bounds_of(uint32_t link) const {
    return is_leaf(link) ? bounds[index_of(link)] : nodes[index_of(link)].bounds;
  }
  uint32_t& parent_of(uint32_t link) const {
    return is_leaf(link) ? parents[index_of(link)] : nodes[index_of(link)].parent;
  }
  void set_child(uint32_t parent, uint32_t before, uint32_t after) const;
  uint32_t take_node() const;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
