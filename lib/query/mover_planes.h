#pragma once
#include <detent/body.h>

#include "base/span.h"
#include "math/root.h"

/// The planes around a mover, and the displacement that they allow.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How a mover that slides treats a plane that is steeper than a floor.
enum class MoverGait : uint32_t {
  walk,  ///< as a vertical wall
  fall,  ///< with its real slope
};

/// Whether a mover can stand on a plane.
enum class Footing : uint32_t {
  unknown,  ///< too steep by its normal; not tested for an edge yet
  none,
  floor,  ///< flat enough by its normal
  edge,   ///< the edge of a floor
};

/// A plane that separates a mover from a body.
struct MoverPlane {
  Vec3<Unit> normal;  ///< outward normal of the body
  Real room;          ///< distance by which the mover may approach before only the gap is left, m; negative: too near
  Footing footing;
  BodyId body;
  Position point;   ///< on the body
  bool on_terrain;  ///< the body is a terrain: it may have several planes, and each is reported
};

/// Displacements shorter than this count as no motion, m. In fx32, this is two units of a coordinate.
#if defined(DETENT_FX32)
inline constexpr Real k_mover_still = Real(0x1p-15);
#else
inline constexpr Real k_mover_still = Real(0x1p-20);
#endif

/// Returns the displacement nearest to `wish` that keeps the gap to every plane. A zero displacement always keeps it. A
/// floor changes the displacement only along `up`, so the horizontal part of the displacement stays. In
/// MoverGait::fall, the edge of a floor acts like a floor. Other planes change the displacement according to the gait.
/// Bit i of `touched` is set if plane i changed it. Source: Hildreth, "A quadratic programming procedure", 1957; for
/// corrections that are not along the normal, Cottle, Pang, Stone, "The Linear Complementarity Problem", 5.2.
Vec3<Real> slide_between(Span<const MoverPlane> planes, const Vec3<Real>& wish, const Vec3<Unit>& up, MoverGait gait,
                         uint32_t& touched);

/// Returns a displacement that restores the gap to the planes that are too near. If no position has the gap to all
/// planes, the displacement leads to a position in the middle between opposite planes.
Vec3<Real> push_out_of(Span<const MoverPlane> planes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
