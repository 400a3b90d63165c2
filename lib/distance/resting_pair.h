#pragma once
#include <detent/distance.h>

#include "distance/gjk.h"
#include "distance/pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A pair of shapes at rest in integer coordinates, its block (support.h): world axes, origin at A's centre, in ulps of
/// 2^-30 of the pair's unit of length.
struct RestingPair {
  int exponent;  ///< 2^exponent m is the pair's unit of length
  /// From A's centre to B's, ulps. If one shape is a half-space: only the component along its normal.
  Vec32 offset;
  Placed a, b;
  int64_t radius_a, radius_b;  ///< rounding radii, 2^-46 m
  Vec64 offset_metres;         ///< from A's position to B's, 2^-46 m

  bool planar() const { return a.convex->type == ShapeType::half_space || b.convex->type == ShapeType::half_space; }
  /// Converts a length from ulps (2^-30 of the pair's unit) to 2^-46 m. Overflow: saturates.
  int64_t metres(int64_t block) const { return raw_from_block(block, exponent); }
  /// Converts a length from 2^-46 m to the next greater whole number of ulps; at most INT32_MAX. Range: raw >= 0.
  int32_t block_above(int64_t raw) const;
};

/// Sets `pair` from two shapes and their poses. Errors: bad_argument for two half-spaces; not_normalised; out_of_range
/// for NaN and infinity and, if one shape is a half-space, for positions 2^16 m or more apart in a component.
Status rest(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, RestingPair& pair);

/// load_cache() sets `simplex` to the cached vertices, from which gjk() then starts. save_cache() stores the last
/// simplex of gjk() for the next query of the pair.
void load_cache(const DistanceCache& cache, const RestingPair& pair, Simplex& simplex);
void save_cache(const Simplex& simplex, DistanceCache& cache);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
