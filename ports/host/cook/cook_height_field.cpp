#include "cook_height_field.h"

#include <math.h>

#include <algorithm>

#include "shape/height_field.h"
#include "writer.h"

namespace detent_cook {
namespace {

constexpr double k_extent_max = 16384;  // m
constexpr double k_height_steps = 32767;

std::string reason_against(const HeightFieldSource& source) {
  constexpr uint32_t k_cells_max = detent::k_height_field_cells_max;
  if (source.columns < 1 || source.columns > k_cells_max || source.rows < 1 || source.rows > k_cells_max) {
    return "a height field has 1 to 4096 cells along a side";
  }
  if (source.heights.size() != (size_t{source.columns} + 1) * (source.rows + 1)) {
    return "there must be one height more along a side than there are cells";
  }
  if (!source.cells.empty() && source.cells.size() != size_t{source.columns} * source.rows) {
    return "the number of cells is not that of the sides";
  }
  if (!(source.spacing_x > 0) || !(source.spacing_z > 0)) return "the spacing is not above 0";
  const auto far = [](double value) { return !(fabs(value) < k_extent_max); };
  if (far(source.origin[0]) || far(source.origin[1]) || far(source.origin[2]) ||
      far(source.origin[0] + source.columns * source.spacing_x) ||
      far(source.origin[2] + source.rows * source.spacing_z)) {
    return "the height field reaches 16 km or more from the origin";
  }
  for (size_t i = 0; i < source.heights.size(); ++i) {
    if (far(source.origin[1] + source.heights[i])) {
      return "height " + std::to_string(i + 1) + " lies 16 km or more from the origin";
    }
  }
  return {};
}

void put_nodes(const detent::HeightFieldView& view, Writer& writer) {
  for (uint32_t level = 0; level < view.level_count; ++level) {
    for (uint32_t j = 0; j < view.level_rows(level); ++j) {
      for (uint32_t i = 0; i < view.level_columns(level); ++i) {
        int32_t low = 0, high = 0;
        detent::height_node(view, level, i, j, low, high);
        const uint32_t at = static_cast<uint32_t>(view.node(level, i, j) - view.bytes);
        writer.put(at, static_cast<int16_t>(low));
        writer.put(at + 2, static_cast<int16_t>(high));
      }
    }
  }
}

}  // namespace

HeightFieldResult cook_height_field(const HeightFieldSource& source) {
  HeightFieldResult result;
  result.reason = reason_against(source);
  if (!result.reason.empty()) return result;
  double greatest = 0, highest = 0;
  const Point& o = source.origin;
  for (const double value :
       {o[0], o[1], o[2], o[0] + source.columns * source.spacing_x, o[2] + source.rows * source.spacing_z}) {
    greatest = std::max(greatest, fabs(value));
  }
  for (const double height : source.heights) {
    greatest = std::max(greatest, fabs(o[1] + height));
    highest = std::max(highest, fabs(height));
  }
  int exponent = 0;
  // One percent more, for the rounding of spacings and heights.
  frexp(greatest * 1.01, &exponent);
  exponent = std::min(std::max(exponent, int{detent::k_terrain_exponent_min}), int{detent::k_terrain_exponent_max});
  const auto steps = [&](double metres) { return static_cast<int32_t>(floor(ldexp(metres, 30 - exponent) + 0.5)); };
  const int32_t height_step = static_cast<int32_t>(ceil(ldexp(highest, 30 - exponent) / k_height_steps)) + 1;
  const int32_t spacing_x = steps(source.spacing_x), spacing_z = steps(source.spacing_z);
  result.step = ldexp(1.0, exponent - 30);
  result.height_step = height_step * result.step;
  if (spacing_x < 1 || spacing_z < 1) {
    result.reason = "the spacing is less than 2^-30 of the extent";
    return result;
  }

  const auto put_header = [&](Writer& writer) {
    writer.put_magic(detent::k_height_field_magic, detent::k_height_field_format_version);
    writer.put(detent::k_height_field_exponent_at, int32_t{exponent});
    writer.put(detent::k_height_field_columns_at, source.columns);
    writer.put(detent::k_height_field_rows_at, source.rows);
    writer.put(detent::k_height_field_flags_at, source.one_sided ? detent::k_height_field_one_sided : 0u);
    for (uint32_t k = 0; k < 3; ++k) writer.put(detent::k_height_field_origin_at + 4 * k, steps(o[k]));
    writer.put(detent::k_height_field_spacing_at, spacing_x);
    writer.put(detent::k_height_field_spacing_at + 4, spacing_z);
    writer.put(detent::k_height_field_step_at, height_step);
  };
  Writer header(detent::k_height_field_header_bytes);
  put_header(header);
  Writer writer(detent::height_field_view(header.data()).end);
  put_header(writer);
  const detent::HeightFieldView view = detent::height_field_view(writer.data());
  for (uint32_t i = 0; i < source.heights.size(); ++i) {
    const double height = floor(ldexp(source.heights[i], 30 - exponent) / height_step + 0.5);
    writer.put(view.heights_at + 2 * i, static_cast<int16_t>(height));
  }
  for (uint32_t i = 0; i < source.cells.size(); ++i) writer.put(view.cells_at + i, source.cells[i]);
  put_nodes(view, writer);
  result.bytes = writer.sealed();
  if (detent::HeightFieldInfo info;
      detent::height_field_info({result.bytes.data(), static_cast<uint32_t>(result.bytes.size())}, info) !=
      detent::Status::ok) {
    result.bytes.clear();
    result.reason = "the height field reaches 16 km or more from the origin";
  }
  return result;
}

}  // namespace detent_cook
