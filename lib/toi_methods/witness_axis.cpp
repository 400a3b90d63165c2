#include "toi_methods/witness_axis.h"

#include "toi/axis_by_axis.h"
#include "toi/features.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The value that separation() returns, Q56, for a witness that has no normal.
constexpr int64_t k_no_witness = -(int64_t{1} << 56);

enum class MovesWith {
  nothing,
  a,      ///< a face of A, or an edge of A towards a vertex
  b,      ///< a face of B, or an edge of B towards a vertex
  edges,  ///< an edge of A and an edge of B
};

MovesWith moves_with(const MovingPair& pair, const NearFeatures& features) {
  if (pair.planar) return pair.a->type == ShapeType::half_space ? MovesWith::a : MovesWith::b;
  if (features.count_a >= 3) return MovesWith::a;
  if (features.count_b >= 3) return MovesWith::b;
  if (features.curved) return MovesWith::nothing;  // the nearest points move along a rim
  if (features.count_a == 2) return features.count_b == 2 ? MovesWith::edges : MovesWith::a;
  return features.count_b == 2 ? MovesWith::b : MovesWith::nothing;
}

class Witness {
 public:
  /// `normal`: the plane's normal at `frames`, world axes.
  Witness(const MovingPair& pair, const NearFeatures& features, MovesWith with, const Frames& frames,
          const Vec32& normal)
      : pair_(pair), features_(features), with_(with), normal_(normal) {
    if (with == MovesWith::a) normal_ = rotate_inverse(frames.a, normal);
    if (with == MovesWith::b) normal_ = rotate_inverse(frames.b, normal);
    Vec32 between;  // for edges: finds the side of the normal
    if (with == MovesWith::edges) axis_between(pair, features, frames, normal_, side_, between);
  }

  /// Finds a time, from that of `frames` on, after which the cores are less than `floor` (ulps of the pair's block)
  /// apart along the witness. Returns the end of the window if the cores are at least `floor` apart at that end.
  /// Returns the time of `frames` if their separation at that time is at most `floor` plus half the tolerance.
  int64_t leads_to(const Frames& frames, int32_t floor, uint32_t& passes) const {
    // Any separation within [0, 2 aim] is good enough: together with the floor it is within the tolerance.
    const int64_t aim = int64_t{pair_.tolerance} << 24;
    int64_t from = frames.time, to = pair_.to;
    int64_t above = separation(frames, floor, passes) - aim;
    if (above <= aim) return from;
    int64_t below = separation(pair_.at(to), floor, passes) - aim;
    if (below >= -aim) return to;
    int last = 0;  // the end that moved last
    for (int step = 0; step < k_root_steps_max && to - from > 1; ++step) {
      const int64_t part = step % 3 == 2 ? k_time_end / 2 : time_quotient(above, above - below);
      const int64_t inner = over_time(to - from, part), time = from + (inner > 0 ? inner : 1);
      const int64_t value = separation(pair_.at(time), floor, passes) - aim;
      if (value >= -aim) {
        from = time;
        if (value <= aim) break;
        above = value;
        if (last > 0) below /= 2;
        last = 1;
      } else {
        to = time;
        below = value;
        if (last < 0) above = above / 2 + 1;
        last = -1;
      }
    }
    return from;
  }

 private:
  /// The separation along the witness minus `floor` ulps, Q56.
  int64_t separation(const Frames& frames, int32_t floor, uint32_t& passes) const {
    ++passes;
    Vec32 normal = normal_;
    int side = side_;
    switch (with_) {
      case MovesWith::a:
        normal = round_shift(multiply(frames.a, normal_), 30);
        break;
      case MovesWith::b:
        normal = round_shift(multiply(frames.b, normal_), 30);
        break;
      case MovesWith::edges:
        if (side == 0 || !axis_between(pair_, features_, frames, normal_, side, normal)) return k_no_witness;
        break;
      case MovesWith::nothing:
      default:
        break;
    }
    return separation_along(pair_, frames, normal, floor);
  }

  const MovingPair& pair_;
  const NearFeatures& features_;
  MovesWith with_;
  Vec32 normal_;  ///< in the axes of the body that it rotates with
  int side_ = 0;
};

}  // namespace

void witness_axes(const MovingPair& pair, TimeOfImpact& result) {
  advance_by_axes(pair, k_witnesses_max, INT32_MAX, result,
                  [&](const Frames& frames, const Simplex& simplex, const GjkResult& nearest, int, int32_t floor) {
                    const NearFeatures features(simplex);
                    const MovesWith with = moves_with(pair, features);
                    const Witness witness(pair, features, with, frames, nearest.normal);
                    const int64_t time = witness.leads_to(frames, floor, result.passes);
                    if (time > frames.time || with == MovesWith::nothing) return time;
                    const Witness fixed(pair, features, MovesWith::nothing, frames, nearest.normal);
                    return fixed.leads_to(frames, floor, result.passes);
                  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
