#include <detent/distance.h>

#include "distance/pair.h"
#include "toi/conservative_advancement.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

CastHit hit_of(const TimeOfImpact& impact) {
  CastHit hit;
  hit.hit = impact.outcome == ToiOutcome::hit;
  hit.undecided = impact.outcome == ToiOutcome::undecided;
  hit.time = impact.time;
  hit.point = impact.point;
  hit.normal = impact.normal;
  return hit;
}

}  // namespace

Status cast_ray(const Convex& convex, const Pose& pose, const Vec3<Real>& origin, const Vec3<Real>& displacement,
                CastHit& result) {
  Convex point;
  point.type = ShapeType::sphere;  // of radius 0
  Quat32 rotation;
  if (!raw_from_quat(pose.rotation, rotation)) return Status::not_normalised;
  Vec64 from, along;
  if (!raw_from_real(origin, from) || !raw_from_real(displacement, along)) return Status::out_of_range;
  MovingPair pair;
  pair.a = &convex;
  pair.b = &point;
  pair.turning_a = still(rotation);
  pair.turning_b = still({0, 0, 0, 1 << 30});
  if (const Status status = set_block(from, along, pair); status != Status::ok) return status;
  TimeOfImpact impact;
  conservative_advancement(pair, k_toi_method, impact);
  result = hit_of(impact);
  return Status::ok;
}

Status cast_shape(const Convex& moving, const Pose& start, const Vec3<Real>& displacement, const Convex& convex,
                  const Pose& pose, CastHit& result) {
  const Real zero = 0.0;
  const Vec3<Real> still = {zero, zero, zero};
  TimeOfImpact impact;
  const Status status = time_of_impact(convex, {pose, still, still}, moving, {start, displacement, still}, impact);
  if (status == Status::ok) result = hit_of(impact);
  return status;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
