#include "broad_phase/resting_tree.h"

#include "broad_phase/bounds_integer.h"
#include "math/bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The key of a body in the tree, 96 bits: the size and the cell of its bounds (`place`), then its slot.
struct TreeKey {
  uint64_t place;
  uint32_t slot;

  /// Returns the bit `index`; index 0 is the highest bit.
  uint32_t bit(uint32_t index) const {
    return index < 64 ? static_cast<uint32_t>(place >> (63 - index)) & 1 : slot >> (95 - index) & 1;
  }
};

uint32_t first_difference(const TreeKey& a, const TreeKey& b) {
  if (a.place != b.place) return static_cast<uint32_t>(64 - bit_length_64(a.place ^ b.place));
  return static_cast<uint32_t>(96 - bit_length_32(a.slot ^ b.slot));
}

/// Inserts two zero bits after each of the low 20 bits, for Morton order.
uint64_t spread(uint64_t value) {
  value &= 0xfffff;
  value = (value | value << 32) & 0x001f00000000ffff;
  value = (value | value << 16) & 0x001f0000ff0000ff;
  value = (value | value << 8) & 0x100f00f00f00f00f;
  value = (value | value << 4) & 0x10c30c30c30c30c3;
  return (value | value << 2) & 0x1249249249249249;
}

/// The key of a body. Along each axis, cell numbers repeat after 2^20 cells. This may cost time, but changes no result.
TreeKey key_of(const Bounds& bounds, uint32_t slot) {
  uint64_t longest = 0, place = 0;
  int64_t centre[3];
  for (int i = 0; i < 3; ++i) {
    const int64_t low = integer_from(bounds.lower.*k_axes[i]), high = integer_from(bounds.upper.*k_axes[i]);
    const uint64_t length = static_cast<uint64_t>(high) - static_cast<uint64_t>(low);
    longest = length > longest ? length : longest;
    centre[i] = (low >> 1) + (high >> 1);
  }
  const int size = bit_length_64(longest) < 64 ? bit_length_64(longest) / 4 : 15;
  for (int i = 0; i < 3; ++i) place |= spread(static_cast<uint64_t>(centre[i] >> (4 * size))) << (2 - i);
  return {static_cast<uint64_t>(size) << 60 | place, slot};
}

Position least(const Position& a, const Position& b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
Position greatest(const Position& a, const Position& b) {
  return {b.x < a.x ? a.x : b.x, b.y < a.y ? a.y : b.y, b.z < a.z ? a.z : b.z};
}
Bounds bounds_of_both(const Bounds& a, const Bounds& b) {
  return {least(a.lower, b.lower), greatest(a.upper, b.upper)};
}
bool are_equal(const Bounds& a, const Bounds& b) {
  return a.lower.x == b.lower.x && a.lower.y == b.lower.y && a.lower.z == b.lower.z && a.upper.x == b.upper.x &&
         a.upper.y == b.upper.y && a.upper.z == b.upper.z;
}

}  // namespace

void RestingTree::make_empty() const {
  root = {};
  for (uint32_t& parent : parents) parent = 0;
}

/// Replaces the child link `before` of a node by `after`. `parent`: the node, as a parent field encodes it
/// (k_above_root: replaces the link to the root).
void RestingTree::set_child(uint32_t parent, uint32_t before, uint32_t after) const {
  if (parent == k_above_root) {
    root.link = after;
    return;
  }
  TreeNode& node = nodes[parent - k_first_parent];
  node.child[node.child[0] == before ? 0 : 1] = after;
}

uint32_t RestingTree::take_node() const {
  if (root.free == 0) return root.nodes_used++;
  const uint32_t index = root.free - 1;
  root.free = nodes[index].parent;
  return index;
}

void RestingTree::insert(uint32_t slot) const {
  const Bounds& box = bounds[slot];
  if (root.link == 0) {
    root.link = leaf_link(slot);
    parents[slot] = k_above_root;
    return;
  }
  const TreeKey key = key_of(box, slot);
  uint32_t link = root.link;
  while (!is_leaf(link)) {
    const TreeNode& node = nodes[index_of(link)];
    link = node.child[key.bit(node.bit)];
  }
  const uint32_t bit = first_difference(key, key_of(bounds[index_of(link)], index_of(link)));
  uint32_t parent = k_above_root;
  link = root.link;
  while (!is_leaf(link) && nodes[index_of(link)].bit < bit) {
    TreeNode& node = nodes[index_of(link)];
    node.bounds = bounds_of_both(node.bounds, box);
    parent = index_of(link) + k_first_parent;
    link = node.child[key.bit(node.bit)];
  }
  const uint32_t index = take_node(), side = key.bit(bit);
  TreeNode& node = nodes[index];
  node.bounds = bounds_of_both(bounds_of(link), box);
  node.child[side] = leaf_link(slot);
  node.child[1 - side] = link;
  node.parent = parent;
  node.bit = bit;
  set_child(parent, link, node_link(index));
  parents[slot] = parent_of(link) = index + k_first_parent;
}

void RestingTree::remove(uint32_t slot) const {
  const uint32_t parent = parents[slot];
  parents[slot] = 0;
  if (parent == k_above_root) {
    root.link = 0;
    return;
  }
  const uint32_t index = parent - k_first_parent;
  TreeNode& node = nodes[index];
  const uint32_t sibling = node.child[node.child[0] == leaf_link(slot) ? 1 : 0];
  uint32_t above = node.parent;
  set_child(above, node_link(index), sibling);
  parent_of(sibling) = above;
  node.parent = root.free;
  root.free = index + 1;
  while (above != k_above_root) {
    TreeNode& wider = nodes[above - k_first_parent];
    const Bounds now = bounds_of_both(bounds_of(wider.child[0]), bounds_of(wider.child[1]));
    if (are_equal(now, wider.bounds)) break;
    wider.bounds = now;
    above = wider.parent;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
