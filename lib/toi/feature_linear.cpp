#include "toi/feature_linear.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Features whose corners move in straight lines. The differences of the corners then move in straight lines too, so
/// their paths are equal to their chords.
struct LinearPath {
  int count;
  Vec64 start[4], displacement[4];
  int64_t ball;

  FeatureSpan span(int64_t from, int64_t to) const {
    FeatureSpan span;
    span.count = count;
    span.ball = ball + 1;  // positions at both ends are rounded down
    for (int i = 0; i < count; ++i) {
      span.from[i] = add(start[i], over_time(displacement[i], from));
      span.to[i] = add(start[i], over_time(displacement[i], to));
    }
    return span;
  }
};

}  // namespace

void LinearFeatures::first_contact(FeatureToi& result) const {
  LinearPath path;
  path.count = difference_count(kind);
  path.ball = ball;
  Vec64 last[4];
  set_differences(kind, start, path.start);
  set_differences(kind, end, last);
  for (int i = 0; i < path.count; ++i) path.displacement[i] = add(last[i], negate(path.start[i]));
  const int64_t first_size = size_of(kind, start), last_size = size_of(kind, end);
  search(path, near_gap(larger(first_size, last_size), ball + 1), result);
}

Status feature_toi_linear(FeatureKind kind, const Vec3<Real> (&start)[4], const Vec3<Real> (&end)[4],
                          FeatureToi& result) {
  if (!is_kind(kind)) return Status::bad_argument;
  LinearFeatures features;
  features.kind = kind;
  features.ball = 1;  // the rounding of a corner is at most 1/2
  if (!raw_corners(start, k_range_bits, features.start) || !raw_corners(end, k_range_bits, features.end))
    return Status::out_of_range;
  features.first_contact(result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
