#include "toi/screw_motion.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A's corners at rest and B's corners in a screw motion, in A's frame.
struct ScrewPath {
  FeatureKind kind;
  Vec64 corner[4];  ///< in A's axes, 2^-46 m; B's are relative to B's position at the start
  ScrewMotion screw;
  int64_t bend;  ///< bound on the distance of a corner from its chord over the whole step
  int64_t ball;  ///< error bound of a difference of corners at either end of an interval

  FeatureSpan span(int64_t from, int64_t to) const {
    FeatureSpan span;
    span.count = difference_count(kind);
    set_differences_at(from, span.from);
    set_differences_at(to, span.to);
    span.ball = ball + over_time(over_time(bend, to - from) + 1, to - from) + 1;
    return span;
  }
  OpenPart roots(int64_t from, int64_t to) const { return screw_roots(*this, screw, from, to); }
  void set_differences_at(int64_t time, Vec64 (&difference)[4]) const {
    const int64_t inverse = screw.inverse_weight_at(time);
    Vec64 placed[4];
    for (int i = 0; i < 4; ++i) {
      placed[i] = i < first_of_b(kind) ? corner[i] : screw.at(corner[i], time, inverse);
    }
    set_differences(kind, placed, difference);
  }
};

Status relative_pose_of(const Pose& a, const Pose& b, RelativePose& relative) {
  Quat32 of_a, of_b;
  if (!raw_from_quat(a.rotation, of_a) || !raw_from_quat(b.rotation, of_b)) return Status::not_normalised;
  Vec64 offset;
  if (!raw_difference(b.position, a.position, offset) || !in_range(offset, k_screw_range_bits))
    return Status::out_of_range;
  relative = relative_pose(of_a, of_b, offset);
  return Status::ok;
}

}  // namespace

Status feature_toi_screw(FeatureKind kind, const Vec3<Real> (&corner)[4], const PosePair& a, const PosePair& b,
                         FeatureToi& result) {
  if (!is_kind(kind)) return Status::bad_argument;
  RelativePose start, end;
  if (const Status status = relative_pose_of(a.start, b.start, start); status != Status::ok) return status;
  if (const Status status = relative_pose_of(a.end, b.end, end); status != Status::ok) return status;
  ScrewPath path;
  path.kind = kind;
  if (!raw_corners(corner, k_screw_range_bits, path.corner)) return Status::out_of_range;
  if (const Status status = screw_between(start, end, path.screw); status != Status::ok) return status;
  const int64_t size = size_of(kind, path.corner);
  const int split = first_of_b(kind);
  const Matrix32 rotation = matrix_from(start.rotation);
  for (int i = split; i < 4; ++i) path.corner[i] = rotated(rotation, path.corner[i]);
  const int64_t radius = radius_of(path.corner + split, 4 - split);
  path.bend = path.screw.bend(radius);
  path.ball = screw_ball(radius, start, end);
  search(path, near_gap(size, path.ball), result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
