#include "read_points.h"

#include <string.h>

#include "words.h"

namespace detent_cook {
namespace {

uint32_t u32_at(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t k = 0; k < 4; ++k) value |= uint32_t{static_cast<uint8_t>(bytes[at + k])} << (8 * k);
  return value;
}

}  // namespace

std::string read_vertex(std::string_view& line, Point& point) {
  for (double& value : point) {
    const std::string_view word = next_word(line);
    if (word.empty()) return "a vertex needs three numbers";
    if (!number_from(word, value)) return quoted(word) + " is no finite number";
  }
  return {};
}

PointsRead read_obj(std::string_view text) {
  PointsRead result;
  for (size_t number = 1; !text.empty(); ++number) {
    std::string_view line = next_line(text);
    if (next_word(line) != "v") continue;
    Point point{};
    if (const std::string problem = read_vertex(line, point); !problem.empty()) return {{}, at_line(number, problem)};
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
