#include <string.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/common/queries/gap.h"
#include "tests/common/queries/sets.h"

namespace detent_queries {

namespace {

constexpr size_t k_points_max = 255;
constexpr double k_extreme = 1e-7;  ///< of the hull's length: nearer to the others' hull, a point is not one of its own

bool read_word(const std::vector<char>& bytes, size_t& offset, uint32_t& word) {
  if (bytes.size() - offset < 4) return false;
  word = 0;
  for (size_t i = 4; i-- > 0;) word = word << 8 | static_cast<uint8_t>(bytes[offset + i]);
  offset += 4;
  return true;
}

}  // namespace

bool read_game_hulls(const std::string& path, std::vector<Solid>& hulls) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::vector<Solid> read;
  for (size_t offset = 0; offset < bytes.size();) {
    uint32_t count = 0;
    if (!read_word(bytes, offset, count) || (bytes.size() - offset) / 12 < count) return false;
    std::vector<Triple> points(count);
    Triple low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (Triple& point : points) {
      for (size_t i = 0; i < 3; ++i) {
        uint32_t word = 0;
        float value = 0;
        if (!read_word(bytes, offset, word)) return false;
        memcpy(&value, &word, sizeof value);
        point[i] = static_cast<double>(value);
        low[i] = std::min(low[i], point[i]);
        high[i] = std::max(high[i], point[i]);
      }
    }
    for (Triple& point : points) point = to_float(point - (low + high) * 0.5);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 4 || points.size() > k_points_max) continue;
    keep_extreme(points, k_extreme * length(high - low));
    Solid solid;
    solid.kind = Kind::hull;
    solid.points = std::move(points);
    read.push_back(std::move(solid));
  }
  hulls = std::move(read);
  return true;
}

}  // namespace detent_queries
