#pragma once
#include <detent/asset.h>
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/toi.h>

#include "ccd/moving_shapes.h"
#include "shape/sweep.h"

/// Computes when the bodies of a pair collide in the rest of a tick.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A pair is tested with shrunken cores: both shapes are made smaller by a shrink depth, m. The first depth is 0 (the
/// surfaces). A pair that has collided in this tick is tested at the smallest depth at which it is separate again. A
/// pair that is in contact at the start of the tick is tested at contact_shrink_depth() or deeper. Therefore a resting
/// or sliding pair is not stopped, but its bodies cannot pass through each other. `extent` is the smaller body's
/// smallest diameter.
///
/// next_shrink_depth() returns the shrink depth that follows `shrink_depth`. The depth after 0 is 1/1024 of the extent.
/// Up to 1/32 of the extent, each depth is twice the previous one. Beyond it, each depth is the previous one plus 1/32
/// of the extent.
Real next_shrink_depth(Real extent, Real shrink_depth);
/// The shrink depth, m, for a pair that overlaps by `depth`, m, at the start of the tick: 1/8 of the extent, or half of
/// `depth` plus 1/64 of the extent, whichever is more. Both bodies are shrunk by it, so in the second case the cores
/// touch when the pair has sunk 1/32 of the extent deeper.
Real contact_shrink_depth(Real extent, Real depth);
/// The largest shrink depth, m: extent / 2. A pair whose cores still overlap at this depth is not tested.
Real last_shrink_depth(Real extent);

/// A body and its sweep, as continuous collision tests them.
struct SweptBody {
  const BodyProperties& properties;
  const BodyPose& pose;  ///< at the time sweep.from
  const BodySweep& sweep;
};

/// pose_at() returns the body's pose at `time`, rest_of() the part of the sweep after `time`.
BodyPose pose_at(const SweptBody& body, Fraction time);
Sweep rest_of(const BodySweep& sweep, Fraction time);

/// True if `normal` is not zero. An impact of cores that overlap has no normal: its `normal` is zero.
inline bool is_direction(const Vec3<Unit>& normal) { return !(normal == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}); }

/// From the position of A to that of B, m, world axes.
inline Vec3<Real> offset_of(const BodyPose& a, const BodyPose& b) { return real_difference(b.position, a.position); }

/// For an impact that was found at `time` itself, returns whether the bodies part at the point of the impact: they do
/// not approach there along the normal, or approach by at most 1/4096 of the extent per tick. Range: the impact has a
/// normal.
bool is_parting(const SweptBody& a, const SweptBody& b, Fraction time, const TimeOfImpact& impact);

/// The body's pose at `time` and the rest of its sweep after `time`, in the form that time_of_impact() takes.
Motion motion_from(const SweptBody& body, Fraction time);

/// An upper bound, m, of how far the rotation by `rotation_vector`, rad, about the body's centre moves any point of its
/// surface. For a half-space that rotates, the result is a quarter of the largest Real.
Real swing_bound(const BodyProperties& properties, const Vec3<Real>& rotation_vector);

/// An upper bound, m, of how far any point of the body's surface moves in the part of the tick after `time`; see
/// swing_bound().
Real motion_bound(const SweptBody& body, Fraction time);

/// Makes the body's shape smaller by `shrink_depth`, m, on all sides. Returns false if the shape is not available.
bool shrink_convex(const AssetTable& assets, const BodyProperties& properties, Real shrink_depth, Convex& convex);

/// Makes a given shape smaller by `shrink_depth`, m. A cone is scaled so that the smaller one of its radius and half
/// length becomes smaller by `shrink_depth`, down to a quarter. A hull is halved in size `halvings` times.
bool shrink_convex(Real shrink_depth, int halvings, Convex& convex);
/// The number of halvings of a hull at shrink depth `shrink_depth`, for a body with this extent.
int shrink_halvings(Real shrink_depth, Real extent);

/// The shrink depths that a pair is tested at.
struct ShrunkenCores {
  Real first;   ///< first shrink depth, m
  Real extent;  ///< extent of the pair, m: the smaller body's smallest diameter
  bool climbs;  ///< continue with the next shrink depth if the cores touch at the start time
  /// An impact of this pair was already resolved at the start time: also continue if the cores touch and approach.
  bool resolved;
};

/// The earliest impact of a pair.
struct Meeting {
  TimeOfImpact impact = {};
  uint32_t tests = 0;  ///< times of impact computed
  /// The largest shrink depth, m, that was tested after the first one; 0 if no other was tested; last_shrink_depth() if
  /// `left`.
  Real depth = 0.0;
  bool left = false;   ///< some parts overlap so deeply that they are not tested
  bool stuck = false;  ///< the pair collided in this tick and does not separate: it would pass through

  Meeting() {
    impact.outcome = ToiOutcome::clear;
    impact.time = k_whole_step;
  }
  /// Replaces `impact` by `found` if `found` is an earlier impact. The time of `found` is a fraction of the rest of the
  /// tick.
  void take(const TimeOfImpact& found) {
    if (found.outcome == ToiOutcome::clear) return;
    if (impact.outcome == ToiOutcome::clear || found.time < impact.time) impact = found;
  }
};

/// Finds the impact of two shapes at a shrink depth, m. Returns false if the shapes could not be tested.
struct FindAtDepth {
  bool (*find)(const void* context, Real shrink_depth, TimeOfImpact& found);
  const void* context;
};

/// Tests two convex shapes, or a convex shape and a terrain. If `cores.climbs`, increases the shrink depth while the
/// cores at `time` overlap, touch without approaching, or touch after a resolved impact (`cores.resolved`). Returns
/// false if `find` returns false.
bool climb_with(const SweptBody& a, const SweptBody& b, Fraction time, const ShrunkenCores& cores,
                const FindAtDepth& find, Meeting& meeting);

/// Does the same as climb_with(). `find`: a function object.
template <class Find>
bool climb(const SweptBody& a, const SweptBody& b, Fraction time, const ShrunkenCores& cores, const Find& find,
           Meeting& meeting) {
  const auto call = [](const void* context, Real shrink_depth, TimeOfImpact& found) {
    return (*static_cast<const Find*>(context))(shrink_depth, found);
  };
  return climb_with(a, b, time, cores, {call, &find}, meeting);
}

/// Finds when the bodies of a pair collide after `time`, at one shrink depth after another. The parts of the test that
/// do not depend on the shrink depth are prepared once. All arguments must outlive the object.
class PairSearch {
 public:
  PairSearch(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
             Fraction time)
      : assets_(assets),
        features_(features),
        a_(a),
        b_(b),
        time_(time),
        motion_a_(motion_from(a, time)),
        motion_b_(motion_from(b, time)),
        shapes_(motion_a_, motion_b_) {}
  PairSearch(const PairSearch&) = delete;
  PairSearch& operator=(const PairSearch&) = delete;

  /// Finds the earliest impact. Its time is a fraction of the whole tick. `axis` is a direction from A to B that may
  /// separate the bodies, or zero: it saves work and does not change the result. Returns false if the test was
  /// impossible: a shape is not available, or is out of the query's range.
  bool find(const ShrunkenCores& cores, Vec3<Unit> axis, Meeting& meeting);

 private:
  bool find_convex(Real shrink_depth, const Vec3<Unit>& axis, TimeOfImpact& impact);

  const AssetTable& assets_;
  const FeatureTable& features_;
  const SweptBody &a_, &b_;
  const Fraction time_;
  const Motion motion_a_, motion_b_;
  Convex convex_a_, convex_b_;
  MovingShapes shapes_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
