#include "toi/features.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_tries_max = 3;
constexpr int k_tracking_quarters = 4;  ///< quarter radians; limit of horizon_from() for predicted axes: 1 rad
/// Limit of the difference between the rotation vector of a predicted axis and base_angular_velocity(): 1.5 rad, Q29.
/// Within this limit, all values fit the number formats of advance().
constexpr int32_t k_relative_angular_velocity_max = 3 << 28;

/// The axis between two features, and the separation of the features along it.
struct FeatureAxis {
  Vec32 normal;  ///< Q30
  int64_t gap;   ///< ulps of the pair's block
};

/// Converts a core point from its shape's axes to ulps of the block, relative to the shape's centre, world axes.
Vec32 placed_point(const MovingPair& pair, const Convex& convex, const Matrix32& rotation, const Vec32& local) {
  return round_shift(multiply(rotation, local), 30 + pair.exponent - convex.exponent);
}

/// The features of a pair at a time, in world axes and in ulps of the pair's block.
struct PlacedFeatures {
  Vec32 displacement;    ///< from A's first point to B's
  Vec32 edge_a, edge_b;  ///< zero for a vertex

  PlacedFeatures(const MovingPair& pair, const NearFeatures& features, const Frames& frames) {
    const Vec32 from = placed_point(pair, *pair.a, frames.a, features.a[0]);
    const Vec32 to = placed_point(pair, *pair.b, frames.b, features.b[0]);
    displacement = subtract(add(frames.offset, to), from);
    edge_a = edge_b = {0, 0, 0};
    if (features.count_a == 2) edge_a = subtract(placed_point(pair, *pair.a, frames.a, features.a[1]), from);
    if (features.count_b == 2) edge_b = subtract(placed_point(pair, *pair.b, frames.b, features.b[1]), to);
  }

  /// Sets `axis` to the axis between the features. Returns false if the features touch or their edges are parallel. For
  /// two edges, `side` is the sign of the cross product; if it is 0, the function sets it so that the axis points to
  /// the side of `towards`.
  bool axis(const Vec32& towards, int& side, FeatureAxis& axis) const {
    Vec64 across;
    if (!is_zero(edge_a) && !is_zero(edge_b)) {
      across = cross(edge_a, edge_b);
      if (is_zero(across)) return false;
      if (side == 0) side = dot(scaled_to_30_bits(across), towards) < 0 ? -1 : 1;
      if (side < 0) across = negate(across);
    } else if (is_zero(edge_a) && is_zero(edge_b)) {
      across = {displacement.x, displacement.y, displacement.z};
    } else {
      const Vec32& edge = is_zero(edge_a) ? edge_b : edge_a;
      const Vec64 moment = cross(edge, displacement);
      if (is_zero(moment)) return false;
      across = cross(scaled_to_30_bits(moment), edge);
    }
    if (is_zero(across)) return false;
    axis.normal = unit_vector_raw(scaled_to_30_bits(across));
    axis.gap = dot(axis.normal, displacement) >> 30;
    return true;
  }
};

/// The current speed at which the gap between the features closes, in ulps of the pair's block over the horizon.
int64_t closing_speed(const MovingPair& pair, const NearFeatures& features, const Frames& frames,
                      const Horizon& horizon, const Vec32& normal) {
  const auto rim_speed = [&](const Convex& convex, const Matrix32& rotation, const Vec32& angular_velocity,
                             const Vec32& local) {
    if (is_zero(angular_velocity)) return int64_t{0};
    return dot(round_shift(cross(normal, angular_velocity), 30), placed_point(pair, convex, rotation, local)) >> 29;
  };
  return -(dot(normal, horizon.displacement) >> 29) +
         rim_speed(*pair.a, frames.a, horizon.angular_velocity_a, features.nearest_a) -
         rim_speed(*pair.b, frames.b, horizon.angular_velocity_b, features.nearest_b);
}

/// numerator / denominator as Q30, at most 1. Range: denominator > 0.
int64_t ratio(int64_t numerator, int64_t denominator) {
  return numerator >= denominator ? k_one_64 : (numerator << 30) / denominator;
}

/// Returns sqrt(a b). Range: a, b >= 0.
int64_t geometric_mean(int64_t a, int64_t b) {
  const Int128 square = Int128::product(a, b);
  return static_cast<int64_t>(
      square_root_nearest(Words128{static_cast<uint64_t>(square.high_word()), square.low_word()}));
}

int64_t part_rounded(int64_t duration, int64_t part) {
  return static_cast<int64_t>(Int128::product(duration, part).round_shift(30));
}

}  // namespace

NearFeatures::NearFeatures(const Simplex& simplex) {
  const auto count_distinct = [&](CorePoint SimplexVertex::*of, Vec32(&points)[2]) {
    int count = 0;
    for (int i = 0; i < simplex.count(); ++i) {
      const Vec32& point = (simplex.vertex(i).*of).local;
      curved = curved || (simplex.vertex(i).*of).feature == k_no_feature;
      bool fresh = true;
      for (int j = 0; j < i; ++j) fresh = fresh && !(point == (simplex.vertex(j).*of).local);
      if (!fresh) continue;
      if (count < 2) points[count] = point;
      ++count;
    }
    return count;
  };
  int32_t weight[4];
  simplex.weights(weight);
  const auto nearest = [&](CorePoint SimplexVertex::*of) {
    Vec64 sum = {0, 0, 0};
    for (int i = 0; i < simplex.count(); ++i) {
      const Vec32& p = (simplex.vertex(i).*of).local;
      sum = add(sum, Vec64{int64_t{p.x} * weight[i], int64_t{p.y} * weight[i], int64_t{p.z} * weight[i]});
    }
    return round_shift(sum, 30);
  };
  nearest_a = nearest(&SimplexVertex::a);
  nearest_b = nearest(&SimplexVertex::b);
  count_a = count_distinct(&SimplexVertex::a, a);
  count_b = count_distinct(&SimplexVertex::b, b);
}

Vec32 NearFeatures::base_angular_velocity(const Horizon& horizon) const {
  if (count_a >= 3) return horizon.angular_velocity_a;
  if (count_b >= 3) return horizon.angular_velocity_b;
  if (count_a == 2) return horizon.angular_velocity_a;
  if (count_b == 2) return horizon.angular_velocity_b;
  return {0, 0, 0};
}

bool axis_between(const MovingPair& pair, const NearFeatures& features, const Frames& frames, const Vec32& towards,
                  int& side, Vec32& normal) {
  FeatureAxis axis;
  if (!PlacedFeatures(pair, features, frames).axis(towards, side, axis)) return false;
  normal = axis.normal;
  return true;
}

int64_t advance_tracking(const MovingPair& pair, const Frames& frames, const Simplex& simplex,
                         const NearFeatures& features, const GjkResult& nearest, int32_t floor, int64_t& progress,
                         TimeOfImpact& result) {
  const int64_t time = frames.time;
  const Vec32& normal = nearest.normal;
  const int64_t distance = nearest.upper;
  const Horizon widest = horizon_from(pair, time, pair.to - time, k_tracking_quarters);
  int64_t length = widest.length;
  const bool edges = features.count_a == 2 && features.count_b == 2;
  const int64_t kept = !edges && distance * 3 / 10 > floor ? distance * 3 / 10 : floor;
  const int64_t speed = closing_speed(pair, features, frames, widest, normal);
  if (speed > 0) length = part_rounded(widest.length, ratio(distance - kept, speed));
  // After a close approach, the closing speed does not tell how long an axis is valid. The time that the previous axis
  // gained then limits the length.
  if (progress < widest.length / 4) {
    const int64_t hope = 4 * progress + (int64_t{1} << 20);
    if (length > hope) length = hope;
  }
  int side = 0;
  FeatureAxis then = {normal, 0};
  bool foreseen = features.curved || PlacedFeatures(pair, features, frames).axis(normal, side, then);
  const auto foresee = [&] {
    if (!foreseen) return;
    const Frames ahead = pair.at(time + length);
    if (!features.curved) {
      foreseen = PlacedFeatures(pair, features, ahead).axis(normal, side, then);
      return;
    }
    // The nearest point of a rim moves along the rim; only GJK can find it.
    Simplex warm = simplex;
    const GjkResult there =
        gjk(place(*pair.a, ahead.a, pair.exponent), place(*pair.b, ahead.b, pair.exponent), ahead.offset, warm, {});
    ++result.gjk_calls;
    if (there.outcome == GjkOutcome::overlap)
      then = {{0, 0, 0}, 0};
    else
      then = {there.normal, there.upper};
  };
  foresee();
  for (int round = 0; round < 2 && foreseen; ++round) {
    if (dot(then.normal, normal) >> 30 < k_one_64 * 3 / 10) {
      length /= 2;
    } else if (then.gap > kept && then.gap < distance) {
      const int64_t covered = distance - then.gap, wanted = distance - kept;  // wanted > covered
      if (length == widest.length) break;
      const int64_t more = wanted < 2 * covered ? part_rounded(length, ratio(wanted - covered, covered)) : length;
      length = more < widest.length - length ? length + more : widest.length;
    } else {
      break;
    }
    foresee();
  }
  int64_t best = time;
  for (int attempt = 0; attempt < k_tries_max; ++attempt) {
    const bool last = attempt == k_tries_max - 1 || !foreseen;
    Horizon horizon = horizon_from(pair, time, last ? pair.to - time : length, last ? 8 : k_tracking_quarters);
    Vec32 angular_velocity = features.base_angular_velocity(horizon);
    if (attempt > 0 && !last) foresee();
    if (!last && foreseen) {
      const Vec32 base = angular_velocity;
      for (int round = 0; round < 3; ++round) {
        angular_velocity = add(
            angular_velocity, round_shift(cross(RotatingAxis(normal, angular_velocity).at(k_one_64), then.normal), 31));
      }
      const Vec32 more = subtract(angular_velocity, base);
      if (dot(more, more) > int64_t{k_relative_angular_velocity_max} * k_relative_angular_velocity_max)
        angular_velocity = base;
    }
    const int64_t reached = advance_on(pair, frames, horizon, normal, angular_velocity, floor, result.passes);
    if (reached > best) best = reached;
    if (last || best >= pair.to || best - time >= part_rounded(length, k_one_64 * 3 / 5)) break;
    const int64_t distance_max = best - time > length / 100 ? best - time : length / 100;
    length = 2 * distance_max > length ? length / 2 : geometric_mean(distance_max, length);
  }
  progress = best - time;
  return best;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
