#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "shape/bounds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A tree of the bounds of resting bodies: those that are fixed, asleep, or kinematic without velocity. A step queries
/// the tree for nearby bodies. It changes the tree only for bodies that come to rest or start to move.
///
/// The tree is a binary trie. The key of a body has three parts. The first part is the longest side of its bounds, as a
/// power of 16, so that large bodies do not enlarge the tree nodes of small bodies. The second part is the grid cell of
/// the centre, in Morton order; the cells are about as large as the body. The third part is the slot. Therefore the
/// shape of the tree depends only on the bodies in it, not on the order of insertion, and no path from the root is
/// longer than k_depth_max. The tree is a cache, which snapshots do not store. The result of a query does not depend on
/// the shape of the tree.
///
/// The traversal uses no recursion and no stack: it returns from a node to its parent through the stored parent.
/// Source: Morrison, "PATRICIA", 1968; Lauterbach and others, "Fast BVH Construction on GPUs", 2009 (Morton order).
struct RestingTree {
  static constexpr uint32_t k_depth_max = 96;

  TreeRoot& root;
  Span<TreeNode> nodes;       ///< inner nodes; for n bodies in the tree, n - 1 are in use
  Span<uint32_t> parents;     ///< parent fields of the leaves, by slot
  Span<const Bounds> bounds;  ///< by slot; they must not change while the body is in the tree

  void make_empty() const;
  bool has(uint32_t slot) const { return parents[slot] != 0; }
  void insert(uint32_t slot) const;
  void remove(uint32_t slot) const;

  /// Visits the slots of all bodies whose bounds overlap `box`. `visit` must not change the tree.
  template <class Visit>
  void for_each_near(const Bounds& box, const Visit& visit) const {
    walk([&](const Bounds& bounds_there) { return overlap(bounds_there, box); },
         [](const Bounds&, const Bounds&) { return false; }, visit);
  }

  /// Visits the slots of all bodies for which `meets(bounds)` is true, both for the bounds of the body and for the
  /// bounds of all tree nodes above it. Does not change the tree. A node has two branches. If `swaps(bounds of the
  /// first branch, bounds of the second branch)` is true, the second branch is visited first. `swaps` must always
  /// return the same value for the same branches.
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
  // Values of a parent field: 0 for the leaf of a body that is not in the tree; k_above_root for the root; else the
  // index of the parent node plus k_first_parent.
  static constexpr uint32_t k_above_root = 1, k_first_parent = 2;

  // A link refers to a node or a leaf; 0 refers to nothing.
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
