#include "toi/known_axis.h"

#include "math/root.h"
#include "toi/advance.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool has_rim(const Convex& convex) { return convex.type == ShapeType::cylinder || convex.type == ShapeType::cone; }

/// Sets `window` to the whole window as one horizon. Returns false for a half-space, if the bodies rotate too far, or
/// if the window is empty. Also returns false for two shapes with rims: near contact, gjk() may reach its iteration
/// cap, so that the full search ends undecided, and a test by a known axis must not change that result.
bool window_of(const MovingPair& pair, Horizon& window) {
  if (pair.planar || pair.from > pair.to || (has_rim(*pair.a) && has_rim(*pair.b))) return false;
  window = horizon_from(pair, pair.from, pair.to - pair.from, k_horizon_quarters);
  return window.length == pair.to - pair.from;
}

}  // namespace

bool stays_clear(const MovingPair& pair, const Vec32& normal) {
  Horizon window;
  if (!window_of(pair, window)) return false;
  const Frames frames = pair.at(pair.from);
  const int32_t floor = pair.radius + pair.tolerance + k_certain;
  uint32_t passes = 0;
  const int32_t part = advance(pair, frames, window, normal, window.angular_velocity_a, floor, passes);
  if (part == k_one) return true;
  return part != 0 && advance(pair, frames, window, normal, window.angular_velocity_b, floor, passes) == k_one;
}

int32_t enough_apart(const MovingPair& pair) {
  Horizon window;
  if (!window_of(pair, window)) return INT32_MAX;
  const auto turning = [](const Vec32& angular_velocity, int64_t core) {
    return ((length_bound_32(angular_velocity) * core) >> 29) + 1;
  };
  const int64_t closing = 2 * length_bound_32(window.displacement) + turning(window.angular_velocity_a, pair.core_a) +
                          turning(window.angular_velocity_b, pair.core_b);
  const int64_t enough = pair.radius + pair.tolerance + k_certain + closing;
  return enough < INT32_MAX ? static_cast<int32_t>(enough) : INT32_MAX;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
