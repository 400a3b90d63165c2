#include "query/mover_planes.h"

#include "query/mover_motion.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_plane_sweeps = 32;

/// A plane, and the correction of the displacement by it: `pushed` (m) in the direction `along`.
struct PlanePush {
  Vec3<Unit> normal;
  Vec3<Unit> along;
  Real share;  ///< 1 / (normal . along)
  Real room;   ///< distance to the plane along `normal` until only the gap is left, m, at least 0
  Real pushed = k_zero;
};

PlanePush push_of(const MoverPlane& plane, const Vec3<Unit>& up, MoverGait gait) {
  PlanePush push = {plane.normal, plane.normal, Real(1.0), max(plane.room, k_zero)};
  const Unit rise = dot(plane.normal, up);
  if (plane.footing == Footing::floor || (plane.footing == Footing::edge && gait == MoverGait::fall)) {
    push.along = up;
    push.share = reciprocal(real_from_unit(rise, 0));
    return push;
  }
  if (gait == MoverGait::fall || rise < Unit(0.0)) return push;
  Vec3<Unit> level;
  Unit size;
  // Does not occur: a plane with a normal along `up` is a floor.
  if (!normalise(plane.normal - up * rise, level, size)) return push;
  push.normal = push.along = level;
  push.room = divide(push.room, real_from_unit(size, 0));
  return push;
}

}  // namespace

Vec3<Real> slide_between(Span<const MoverPlane> planes, const Vec3<Real>& wish, const Vec3<Unit>& up, MoverGait gait,
                         uint32_t& touched) {
  PlanePush pushes[k_mover_planes_max];
  for (uint32_t i = 0; i < planes.count; ++i) pushes[i] = push_of(planes[i], up, gait);
  Vec3<Real> displacement = wish;
  for (uint32_t sweep = 0; sweep < k_plane_sweeps; ++sweep) {
    Real most = k_zero;
    for (uint32_t i = 0; i < planes.count; ++i) {
      PlanePush& push = pushes[i];
      const Real lacking = (-push.room - dot(displacement, push.normal)) * push.share;
      const Real pushed = max(push.pushed + lacking, k_zero);
      const Real change = pushed - push.pushed;
      push.pushed = pushed;
      displacement += push.along * change;
      most = max(most, abs(change));
    }
    if (most < k_mover_still) break;
  }
  touched = 0;
  for (uint32_t i = 0; i < planes.count; ++i) {
    if (pushes[i].pushed > k_mover_still) touched |= 1u << i;
  }
  // In a narrow wedge the sweeps may end before they converge. The displacement is then scaled down so that the gap is
  // kept.
  for (const MoverPlane& plane : planes) {
    const Real closing = -dot(displacement, plane.normal), room = max(plane.room, k_zero);
    if (closing > room + k_mover_still) displacement = displacement * divide(room, closing);
  }
  return displacement;
}

Vec3<Real> push_out_of(Span<const MoverPlane> planes) {
  Vec3<Real> displacement = {k_zero, k_zero, k_zero};
  for (uint32_t sweep = 0; sweep < k_plane_sweeps; ++sweep) {
    for (const MoverPlane& plane : planes) {
      const Real lacking = -plane.room - dot(displacement, plane.normal);
      // Correct by half, so that opposite planes converge to a place between them.
      if (lacking > k_zero) displacement += plane.normal * scale_by_power(lacking, -1);
    }
  }
  return displacement;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
