#pragma once
#include <detent/id.h>

#include "base/span.h"
#include "math/root.h"

/// The planes around a mover, and the way that they leave it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How a motion takes what is steeper than a floor.
enum class MoverGait : uint32_t {
  walk,  ///< as an upright wall
  fall,  ///< as it is
};

/// What a mover can stand on.
enum class Footing : uint32_t {
  unknown,  ///< no floor by its normal
  none,
  floor,  ///< by its normal
  edge,   ///< of a floor
};

/// A plane between a mover and a body. It parts the two wherever the mover goes on its side of it.
struct MoverPlane {
  Vec3<Unit> normal;  ///< of the body, outward
  Real room;          ///< along the normal, to where the mover keeps its gap; negative: it is too near
  Footing footing;
  BodyId body;
  Position point;   ///< on the body
  bool on_surface;  ///< the body has more planes, each in the report
};

/// What is shorter is no motion, m: two steps of a position where these are coarse.
#if defined(DETENT_FX32)
inline constexpr Real k_mover_still = Real(0x1p-15);
#else
inline constexpr Real k_mover_still = Real(0x1p-20);
#endif

/// The way nearest to `wish` that leaves no plane's gap; 0 always does. Floors move it along `up`, which keeps its
/// level part; other planes as the gait says. Bit i of `met` is set for a plane that turned it. Source: Hildreth, "A
/// quadratic programming procedure", 1957; Cottle, Pang, Stone, "The Linear Complementarity Problem", 5.2, for pushes
/// that are not along the normal.
Vec3<Real> way_between(Span<const MoverPlane> planes, const Vec3<Real>& wish, const Vec3<Unit>& up, MoverGait gait,
                       uint32_t& met);

/// A way out of the planes whose gap is not kept; of planes that leave no room, to somewhere in the middle.
Vec3<Real> way_out_of(Span<const MoverPlane> planes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
