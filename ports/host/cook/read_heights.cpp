#include "read_heights.h"

#include <algorithm>

#include "words.h"

namespace detent_cook {
namespace {

constexpr uint32_t k_samples_max = 4097;  ///< along one side

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Takes the next number of the header, or of a text picture, off the front. Comments extend from # to the line's end.
bool take_number(std::string_view& bytes, uint32_t most, uint32_t& number) {
  size_t at = 0;
  for (bool comment = false; at < bytes.size() && (comment || is_space(bytes[at]) || bytes[at] == '#'); ++at) {
    comment = bytes[at] == '#' || (comment && bytes[at] != '\n');
  }
  bytes.remove_prefix(at);
  number = 0;
  for (at = 0; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at) {
    number = 10 * number + static_cast<uint32_t>(bytes[at] - '0');
    if (number > most) return false;
  }
  bytes.remove_prefix(at);
  return at != 0;
}

/// Takes the next pixel of a binary picture off the front.
bool take_pixel(std::string_view& bytes, uint32_t byte_count, uint32_t& number) {
  if (bytes.size() < byte_count) return false;
  number = 0;
  for (uint32_t k = 0; k < byte_count; ++k) number = number << 8 | static_cast<uint8_t>(bytes[k]);
  bytes.remove_prefix(byte_count);
  return true;
}

}  // namespace

HeightsRead read_pgm(std::string_view bytes, double spacing, double height) {
  const bool text = bytes.substr(0, 2) == "P2";
  if (!text && bytes.substr(0, 2) != "P5") return {{}, "is no PGM: it starts with neither P2 nor P5"};
  bytes.remove_prefix(2);
  uint32_t width = 0, rows = 0, brightest = 0;
  if (!take_number(bytes, k_samples_max, width) || !take_number(bytes, k_samples_max, rows) || width < 2 || rows < 2)
    return {{}, "a height field has 2 to 4097 samples along each side"};
  if (!take_number(bytes, 65535, brightest) || brightest == 0) return {{}, "the brightest value is 1 to 65535"};
  if (!text) {
    if (bytes.empty() || !is_space(bytes[0])) return {{}, "the header does not end"};
    bytes.remove_prefix(1);
  }
  HeightsRead result;
  HeightFieldSource& field = result.field;
  field.columns = width - 1;
  field.rows = rows - 1;
  field.spacing_x = field.spacing_z = spacing;
  field.origin = {-0.5 * spacing * field.columns, 0, -0.5 * spacing * field.rows};
  field.heights.reserve(std::min(size_t{width} * rows, bytes.size()));  // a pixel takes at least one byte
  for (size_t i = 0; i < size_t{width} * rows; ++i) {
    uint32_t value = 0;
    const bool taken = text ? take_number(bytes, brightest, value) : take_pixel(bytes, brightest > 255 ? 2 : 1, value);
    if (!taken || value > brightest)
      return {{}, "pixel " + std::to_string(i) + " is missing, or brighter than the brightest"};
    field.heights.push_back(height * value / brightest);
  }
  return result;
}

}  // namespace detent_cook
