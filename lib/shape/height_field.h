#pragma once
#include <detent/asset.h>

#include "base/check.h"
#include "shape/cooked.h"
#include "shape/terrain_triangle.h"

/// Offsets and readers of a cooked height field in flash or in a file; docs/height_field.md describes the format.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint8_t k_height_field_magic[8] = {0x89, 'D', 'T', 'F', '\r', '\n', 0x1a, '\n'};
inline constexpr uint32_t k_height_field_format_version = 1;

/// Byte offsets of the header's fields after the fields that all formats have.
inline constexpr uint32_t k_height_field_exponent_at = 20;
inline constexpr uint32_t k_height_field_columns_at = 24;
inline constexpr uint32_t k_height_field_rows_at = 28;
inline constexpr uint32_t k_height_field_flags_at = 32;
inline constexpr uint32_t k_height_field_origin_at = 36;     ///< three int32
inline constexpr uint32_t k_height_field_spacing_at = 48;    ///< two int32: along x, along z
inline constexpr uint32_t k_height_field_step_at = 56;       ///< int32
inline constexpr uint32_t k_height_field_header_bytes = 64;  ///< zero from 60 on

inline constexpr uint32_t k_height_field_one_sided = 1;     ///< a bit of the flags
inline constexpr uint32_t k_height_field_cells_max = 4096;  ///< largest number of cells along a side
inline constexpr uint8_t k_cell_hole = 0x80;                ///< a bit of a cell's byte: the cell has no triangles
/// A bit of cell (i, j): its diagonal runs from (i + 1, j) to (i, j + 1), not from (i, j) to (i + 1, j + 1).
inline constexpr uint8_t k_cell_turned = 0x40;
inline constexpr uint8_t k_cell_material = 0x3f;

inline constexpr uint32_t k_height_block_bits = 3;  ///< a leaf of the tree contains 8 x 8 cells
inline constexpr uint32_t k_height_levels_max = 10;
inline constexpr uint32_t k_height_node_bytes = 4;  ///< two int16: the least and the greatest height

/// A view of a cooked height field; it copies nothing. Node (i, j) of a level contains the nodes (2 i, 2 j) to
/// (2 i + 1, 2 j + 1) of the level below, as far as they exist.
struct HeightFieldView {
  const uint8_t* bytes = nullptr;
  uint32_t columns = 0, rows = 0;
  uint32_t heights_at = 0, cells_at = 0, nodes_at = 0, end = 0;
  uint32_t level_count = 0;
  uint32_t level_start[k_height_levels_max + 1] = {};  ///< the first node of each level
  Vec32 origin = {};
  int32_t spacing_x = 0, spacing_z = 0, step = 0;

  int32_t exponent() const { return cooked_i32(bytes + k_height_field_exponent_at); }
  bool one_sided() const { return (cooked_u32(bytes + k_height_field_flags_at) & k_height_field_one_sided) != 0; }
  uint32_t triangle_count() const { return 2 * columns * rows; }
  int32_t height(uint32_t i, uint32_t j) const {
    DETENT_VERIFY_RANGE(i <= columns && j <= rows);
    return cooked_i16(bytes + heights_at + 2 * (j * (columns + 1) + i));
  }
  uint8_t cell(uint32_t i, uint32_t j) const {
    DETENT_VERIFY_RANGE(i < columns && j < rows);
    return bytes[cells_at + j * columns + i];
  }
  Vec32 vertex(uint32_t i, uint32_t j) const { return {x(i), origin.y + height(i, j) * step, z(j)}; }
  int32_t x(uint32_t i) const { return origin.x + static_cast<int32_t>(i) * spacing_x; }
  int32_t z(uint32_t j) const { return origin.z + static_cast<int32_t>(j) * spacing_z; }

  /// Triangle `index`, with its neighbours. The cell (i, j) has the triangles t and t + 1 with t = 2 (j columns + i). A
  /// cell that is a hole has no triangles.
  TerrainTriangle triangle(uint32_t index) const;
  uint32_t level_columns(uint32_t level) const { return blocks(columns, level); }
  uint32_t level_rows(uint32_t level) const { return blocks(rows, level); }
  static uint32_t blocks(uint32_t cells, uint32_t level) {
    const uint32_t bits = k_height_block_bits + level;
    return (cells + (1u << bits) - 1) >> bits;
  }
  const uint8_t* node(uint32_t level, uint32_t i, uint32_t j) const {
    return bytes + nodes_at + k_height_node_bytes * (level_start[level] + j * level_columns(level) + i);
  }
  GridBox node_bounds(uint32_t level, uint32_t i, uint32_t j) const {
    const uint32_t bits = k_height_block_bits + level;
    const auto last = [bits](uint32_t at, uint32_t cells) {
      const uint32_t beyond = (at + 1) << bits;
      return beyond < cells ? beyond : cells;
    };
    const uint8_t* ends = node(level, i, j);
    return {{x(i << bits), origin.y + cooked_i16(ends) * step, z(j << bits)},
            {x(last(i, columns)), origin.y + cooked_i16(ends + 2) * step, z(last(j, rows))}};
  }
  GridBox bounds() const { return node_bounds(level_count - 1, 0, 0); }

  /// Calls visit(index) for each triangle whose bounds, a GridBox, satisfy `meets`; always in the same order.
  template <class Meets, class Visit>
  void walk(Meets&& meets, Visit&& visit) const;

 private:
  void corners(uint32_t index, Vec32 (&corner)[3]) const;
  /// The index of the triangle at a side of cell (i, j). Sides 0 to 3 are those at the lower x, upper z, upper x and
  /// lower z.
  uint32_t triangle_at_side(uint32_t i, uint32_t j, uint32_t side) const {
    const bool turned = (cell(i, j) & k_cell_turned) != 0;
    const bool second = side == 2 || (side == 1 && turned) || (side == 3 && !turned);
    return 2 * (j * columns + i) + (second ? 1 : 0);
  }
  template <class Meets, class Visit>
  void walk_cells(uint32_t i, uint32_t j, Meets&& meets, Visit&& visit) const;
};

/// The height field at `bytes`. read_height_field() must have accepted them; this function checks nothing.
HeightFieldView height_field_view(const uint8_t* bytes);

/// Computes the values that the file stores for a node: the least and the greatest height of its samples (level 0) or
/// of its child nodes.
void height_node(const HeightFieldView& field, uint32_t level, uint32_t i, uint32_t j, int32_t& low, int32_t& high);

/// Checks untrusted bytes. Errors: buffer_misaligned (8), not_detent, format_unknown, truncated, corrupt,
/// out_of_range (the exponent).
Status read_height_field(const Asset& asset, HeightFieldView& field);

template <class Meets, class Visit>
void HeightFieldView::walk_cells(uint32_t i, uint32_t j, Meets&& meets, Visit&& visit) const {
  constexpr uint32_t k_size = 1u << k_height_block_bits;
  const uint32_t i_end = (i + 1) * k_size < columns ? (i + 1) * k_size : columns;
  const uint32_t j_end = (j + 1) * k_size < rows ? (j + 1) * k_size : rows;
  for (uint32_t row = j * k_size; row < j_end; ++row) {
    for (uint32_t column = i * k_size; column < i_end; ++column) {
      if ((cell(column, row) & k_cell_hole) != 0) continue;
      for (uint32_t k = 0; k < 2; ++k) {
        const uint32_t index = 2 * (row * columns + column) + k;
        Vec32 corner[3];
        corners(index, corner);
        if (meets(bounds_of(corner[0], corner[1], corner[2]))) visit(index);
      }
    }
  }
}

template <class Meets, class Visit>
void HeightFieldView::walk(Meets&& meets, Visit&& visit) const {
  struct Entry {
    uint32_t level, i, j;
  };
  Entry stack[3 * k_height_levels_max + 1];  // at most three nodes of each level wait
  uint32_t count = 0;
  stack[count++] = {level_count - 1, 0, 0};
  while (count > 0) {
    const Entry entry = stack[--count];
    if (!meets(node_bounds(entry.level, entry.i, entry.j))) continue;
    if (entry.level == 0) {
      walk_cells(entry.i, entry.j, meets, visit);
      continue;
    }
    for (uint32_t child = 4; child-- > 0;) {
      const Entry next = {entry.level - 1, 2 * entry.i + (child & 1), 2 * entry.j + (child >> 1)};
      if (next.i < level_columns(next.level) && next.j < level_rows(next.level)) stack[count++] = next;
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
