#include "read_points.h"

#include <math.h>
#include <string.h>

#include <charconv>

namespace detent_cook {
namespace {

constexpr std::string_view k_blanks = " \t\r\f\v";

/// Takes the next word off the line; empty if there is none.
std::string_view next_word(std::string_view& line) {
  const size_t from = line.find_first_not_of(k_blanks);
  if (from == std::string_view::npos) return {};
  const size_t to = line.find_first_of(k_blanks, from);
  const std::string_view word = line.substr(from, to == std::string_view::npos ? to : to - from);
  line.remove_prefix(to == std::string_view::npos ? line.size() : to);
  return word;
}

/// The whole word as a finite number; whatever the locale.
bool number_from(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && isfinite(value);
}

std::string at_line(size_t number, const std::string& problem) {
  return "line " + std::to_string(number) + ": " + problem;
}

/// A word of the file for a message: without what would not print.
std::string quoted(std::string_view word) {
  std::string text = "'";
  for (const char letter : word.substr(0, 40)) text += letter >= ' ' && letter <= '~' ? letter : '?';
  return text + "'";
}

uint32_t u32_at(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t k = 0; k < 4; ++k) value |= uint32_t{static_cast<uint8_t>(bytes[at + k])} << (8 * k);
  return value;
}

}  // namespace

PointsRead read_obj(std::string_view text) {
  PointsRead result;
  for (size_t number = 1; !text.empty(); ++number) {
    const size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (next_word(line) != "v") continue;
    Point point{};
    for (double& value : point) {
      const std::string_view word = next_word(line);
      if (word.empty()) return {{}, at_line(number, "a vertex needs three numbers")};
      if (!number_from(word, value)) return {{}, at_line(number, quoted(word) + " is no finite number")};
    }
    result.points.push_back(point);
  }
  if (result.points.empty()) result.problem = "no line starts with 'v': this is no OBJ with vertices";
  return result;
}

PointsRead read_clouds(std::string_view bytes, uint32_t index) {
  PointsRead result;
  size_t at = 0;
  for (uint32_t cloud = 0;; ++cloud) {
    if (at == bytes.size()) {
      return {{}, "there is no cloud " + std::to_string(index) + ": the file holds " + std::to_string(cloud)};
    }
    if (bytes.size() - at < 4) return {{}, "the file ends within cloud " + std::to_string(cloud)};
    const uint32_t count = u32_at(bytes, at);
    at += 4;
    if ((bytes.size() - at) / 12 < count) return {{}, "the file ends within cloud " + std::to_string(cloud)};
    if (cloud == index) {
      for (uint32_t i = 0; i < count; ++i) {
        Point point{};
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t bits = u32_at(bytes, at + 12 * size_t{i} + 4 * k);
          float value;
          memcpy(&value, &bits, sizeof value);
          point[k] = static_cast<double>(value);
        }
        result.points.push_back(point);
      }
      return result;
    }
    at += 12 * size_t{count};
  }
}

PointsRead read_points(const std::string& path, std::string_view bytes, uint32_t index) {
  const bool clouds = path.size() >= 4 && path.compare(path.size() - 4, 4, ".bin") == 0;
  return clouds ? read_clouds(bytes, index) : read_obj(bytes);
}

}  // namespace detent_cook
