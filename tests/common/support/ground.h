#pragma once
#include <stdint.h>

#include <string>
#include <vector>

/// The ground of a scene. Scenes are measured on grounds of more than one shape, because an engine may treat one of
/// them as a special case.
namespace detent_test {

enum class Ground : uint32_t {
  own,         ///< as the scene gives it, or none
  half_space,  ///< of the same height
  box,         ///< of the same height, at least 200 m wide
};

inline constexpr double k_ground_half_width = 100;  ///< m, of Ground::box
inline constexpr double k_ground_half_height = 1;   ///< m, of Ground::box

inline const char* ground_name(Ground ground) {
  return ground == Ground::half_space ? "half-space" : ground == Ground::box ? "box" : "own";
}

/// Whether a level box with these half extents, m, counts as ground: not as a platform, a plate or a wall.
constexpr bool is_wide_as_ground(double x, double y, double z) { return x >= 3 && y >= 1 && z >= 3; }

/// The grounds that "half-space", "box" or "both" stands for, for a scene that has a ground; the own of one without.
inline std::vector<Ground> grounds_of(const std::string& names, bool has_ground) {
  if (!has_ground) return {Ground::own};
  std::vector<Ground> grounds;
  for (const Ground ground : {Ground::half_space, Ground::box}) {
    if (names == "both" || names == ground_name(ground)) grounds.push_back(ground);
  }
  return grounds;
}

}  // namespace detent_test
