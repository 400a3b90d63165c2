#include "shape/height_field.h"
#include "base/cycle.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool in_range(int64_t value) { return value >= -k_terrain_coordinate_max && value <= k_terrain_coordinate_max; }

/// Whether the spacings and the height step are positive, and all samples are in range. The root node contains the
/// least and the greatest height.
bool lengths_are_good(const HeightFieldView& field) {
  if (field.spacing_x <= 0 || field.spacing_z <= 0 || field.step <= 0) return false;
  const uint8_t* root = field.node(field.level_count - 1, 0, 0);
  const auto height_at = [&](int32_t height) { return field.origin.y + int64_t{height} * field.step; };
  return in_range(field.origin.x) && in_range(field.origin.x + int64_t{field.columns} * field.spacing_x) &&
         in_range(field.origin.z) && in_range(field.origin.z + int64_t{field.rows} * field.spacing_z) &&
         in_range(height_at(cooked_i16(root))) && in_range(height_at(cooked_i16(root + 2)));
}

bool node_is_good(const HeightFieldView& field, uint32_t level, uint32_t i, uint32_t j) {
  int32_t low = 0, high = 0;
  height_node(field, level, i, j, low, high);
  const uint8_t* stored = field.node(level, i, j);
  return cooked_i16(stored) == low && cooked_i16(stored + 2) == high;
}

}  // namespace

void height_node(const HeightFieldView& field, uint32_t level, uint32_t i, uint32_t j, int32_t& low, int32_t& high) {
  low = INT32_MAX;
  high = INT32_MIN;
  const auto take = [&](int32_t least, int32_t most) {
    low = least < low ? least : low;
    high = most > high ? most : high;
  };
  if (level > 0) {
    for (uint32_t child = 0; child < 4; ++child) {
      const uint32_t column = 2 * i + (child & 1), row = 2 * j + (child >> 1);
      if (column >= field.level_columns(level - 1) || row >= field.level_rows(level - 1)) continue;
      const uint8_t* ends = field.node(level - 1, column, row);
      take(cooked_i16(ends), cooked_i16(ends + 2));
    }
    return;
  }
  constexpr uint32_t k_size = 1u << k_height_block_bits;
  for (uint32_t row = j * k_size; row <= (j + 1) * k_size && row <= field.rows; ++row) {
    for (uint32_t column = i * k_size; column <= (i + 1) * k_size && column <= field.columns; ++column) {
      const int32_t height = field.height(column, row);
      take(height, height);
    }
  }
}

// Seen from above, the corners are in counter-clockwise order. Edge 2 is the diagonal of the cell; edges 0 and 1 are
// sides of the cell.
void HeightFieldView::corners(uint32_t index, Vec32 (&corner)[3]) const {
  const uint32_t i = index / 2 % columns, j = index / 2 / columns;
  const bool second = index % 2 != 0, turned = (cell(i, j) & k_cell_turned) != 0;
  const uint32_t di = turned ? 1 : 0;
  if (second) {
    corner[0] = vertex(i + 1 - di, j + 1);
    corner[1] = turned ? vertex(i + 1, j + 1) : vertex(i + 1, j);
    corner[2] = vertex(i + di, j);
  } else {
    corner[0] = vertex(i + di, j);
    corner[1] = turned ? vertex(i, j) : vertex(i, j + 1);
    corner[2] = vertex(i + 1 - di, j + 1);
  }
}

TerrainTriangle HeightFieldView::triangle(uint32_t index) const {
  const uint32_t i = index / 2 % columns, j = index / 2 / columns;
  const bool second = index % 2 != 0, turned = (cell(i, j) & k_cell_turned) != 0;
  TerrainTriangle result;
  corners(index, result.corner);
  result.material = cell(i, j) & k_cell_material;
  const uint32_t sides[2] = {second ? (turned ? 1u : 2u) : (turned ? 3u : 0u),
                             second ? (turned ? 2u : 3u) : (turned ? 0u : 1u)};
  for (uint32_t k = 0; k < 3; ++k) {
    uint32_t other = index ^ 1;
    if (k < 2) {
      const uint32_t side = sides[k];
      const uint32_t column = side == 0   ? i - 1
                              : side == 2 ? i + 1
                                          : i,
                     row = side == 3   ? j - 1
                           : side == 1 ? j + 1
                                       : j;
      const bool inside = column < columns && row < rows && (cell(column, row) & k_cell_hole) == 0;
      other = inside ? triangle_at_side(column, row, side ^ 2) : k_no_triangle;
    }
    result.neighbour[k] = other;
    if (other == k_no_triangle) {
      result.kind[k] = EdgeKind::open;
      continue;
    }
    const Vec32 &a = result.corner[k], &b = result.corner[next_of_three(k)], &c = result.corner[previous_of_three(k)];
    Vec32 corner[3];
    corners(other, corner);
    uint32_t opposite = 0;
    while (corner[opposite] == a || corner[opposite] == b) ++opposite;
    result.kind[k] = edge_kind(a, b, c, corner[opposite]);
  }
  return result;
}

HeightFieldView height_field_view(const uint8_t* bytes) {
  HeightFieldView field;
  field.bytes = bytes;
  field.columns = cooked_u32(bytes + k_height_field_columns_at);
  field.rows = cooked_u32(bytes + k_height_field_rows_at);
  field.origin = {cooked_i32(bytes + k_height_field_origin_at), cooked_i32(bytes + k_height_field_origin_at + 4),
                  cooked_i32(bytes + k_height_field_origin_at + 8)};
  field.spacing_x = cooked_i32(bytes + k_height_field_spacing_at);
  field.spacing_z = cooked_i32(bytes + k_height_field_spacing_at + 4);
  field.step = cooked_i32(bytes + k_height_field_step_at);
  field.heights_at = k_height_field_header_bytes;
  field.cells_at = align_8(field.heights_at + 2 * (field.columns + 1) * (field.rows + 1));
  field.nodes_at = align_8(field.cells_at + field.columns * field.rows);
  uint32_t count = 0;
  do {
    count = field.level_columns(field.level_count) * field.level_rows(field.level_count);
    field.level_start[field.level_count + 1] = field.level_start[field.level_count] + count;
    ++field.level_count;
  } while (count > 1);
  field.end = align_8(field.nodes_at + k_height_node_bytes * field.level_start[field.level_count]);
  return field;
}

Status read_height_field(const Asset& asset, HeightFieldView& field) {
  if (const Status status =
          check_cooked(asset, k_height_field_magic, k_height_field_format_version, k_height_field_header_bytes);
      status != Status::ok) {
    return status;
  }
  const uint8_t* const bytes = asset.bytes;
  const uint32_t columns = cooked_u32(bytes + k_height_field_columns_at);
  const uint32_t rows = cooked_u32(bytes + k_height_field_rows_at);
  if (columns < 1 || columns > k_height_field_cells_max || rows < 1 || rows > k_height_field_cells_max ||
      cooked_u32(bytes + k_height_field_flags_at) > k_height_field_one_sided) {
    return Status::corrupt;
  }
  const HeightFieldView view = height_field_view(bytes);
  if (view.end != asset.byte_count) return Status::corrupt;
  if (view.exponent() < k_terrain_exponent_min || view.exponent() > k_terrain_exponent_max) return Status::out_of_range;
  if (!cooked_is_zero(bytes, k_height_field_step_at + 4, k_height_field_header_bytes) ||
      !cooked_is_zero(bytes, view.heights_at + 2 * (columns + 1) * (rows + 1), view.cells_at) ||
      !cooked_is_zero(bytes, view.cells_at + columns * rows, view.nodes_at) ||
      !cooked_is_zero(bytes, view.nodes_at + k_height_node_bytes * view.level_start[view.level_count], view.end)) {
    return Status::corrupt;
  }
  for (uint32_t level = 0; level < view.level_count; ++level) {
    for (uint32_t j = 0; j < view.level_rows(level); ++j) {
      for (uint32_t i = 0; i < view.level_columns(level); ++i) {
        if (!node_is_good(view, level, i, j)) return Status::corrupt;
      }
    }
  }
  if (!lengths_are_good(view)) return Status::corrupt;
  field = view;
  return Status::ok;
}

Status height_field_info(const Asset& asset, HeightFieldInfo& info) {
  HeightFieldView field;
  if (const Status status = read_height_field(asset, field); status != Status::ok) return status;
  info.columns = field.columns;
  info.rows = field.rows;
  info.exponent = field.exponent();
  info.one_sided = field.one_sided();
  info.origin[0] = field.origin.x;
  info.origin[1] = field.origin.y;
  info.origin[2] = field.origin.z;
  info.spacing_x = field.spacing_x;
  info.spacing_z = field.spacing_z;
  info.height_step = field.step;
  const uint8_t* root = field.node(field.level_count - 1, 0, 0);
  info.low = cooked_i16(root);
  info.high = cooked_i16(root + 2);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
