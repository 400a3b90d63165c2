#pragma once
#include <detent/asset.h>
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/toi.h>

#include "shape/sweep.h"
#include "toi/moving_pair.h"

/// When the bodies of a pair meet in the rest of a tick.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How far within their surfaces the bodies of a pair are tested, m, as rungs of a ladder: at the surface; by the least
/// that parts again what has met in this tick; and farther in where a tick begins in contact, so that what rests or
/// slides isn't stopped, and yet cannot pass. `extent` is the smaller body's smallest diameter.
///
/// From the surface the rungs are a 1024th of the extent, four times that as far as a 16th, and then a 32nd each.
Real next_inset(Real extent, Real inset);
/// The rung of a pair that starts the tick in contact, `depth` deep: an eighth, and so that it cannot sink more than a
/// 32nd where it is deeper.
Real contact_inset(Real extent, Real depth);
/// Beyond it bodies are so deep within each other that nothing is tested: half of the extent.
Real last_inset(Real extent);

/// A body as the stage sees it.
struct SweptBody {
  const BodyTraits& traits;
  const BodyPose& pose;  ///< at sweep.from
  const BodySweep& sweep;
};

/// The sweep of a body from `time` on, and its pose then.
BodyPose pose_at(const SweptBody& body, Fraction time);
Sweep rest_of(const BodySweep& sweep, Fraction time);

/// False for the normal of an impact that has none: of bodies that overlap.
inline bool is_direction(const Vec3<Unit>& normal) { return !(normal == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}); }

/// From A to B, m, world axes.
inline Vec3<Real> offset_of(const BodyPose& a, const BodyPose& b) { return real_difference(b.position, a.position); }

/// True if the point of an impact that is found at once, at `time`, isn't about to come closer. Range: it has a normal.
bool is_parting(const SweptBody& a, const SweptBody& b, Fraction time, const TimeOfImpact& impact);

/// Both, for time_of_impact().
Motion motion_from(const SweptBody& body, Fraction time);

/// A bound of how far a point of the body's surface moves in the rest of the tick, m; false if there is none.
bool motion_bound(const SweptBody& body, Fraction time, Real& bound);

/// A bound of how much nearer the surfaces of two bodies can come in the rest of the tick, m; false if there is none.
bool closing_bound(const SweptBody& a, const SweptBody& b, Fraction time, Real& bound);

/// The body's shape made smaller by `inset`, m, on all sides. False if it is not known.
bool inset_convex(const AssetTable& assets, const BodyTraits& traits, Real inset, Convex& convex);

/// Likewise, of a shape that is ready. A hull or cone is halved `halvings` times.
bool inset_convex(Real inset, int halvings, Convex& convex);
/// How often that is at this inset, of a body of this extent.
int inset_halvings(Real inset, Real extent);

/// Where on the ladder a pair is tested.
struct Ladder {
  Real first;     ///< inset of the lowest rung
  Real extent;    ///< of the pair
  bool climbs;    ///< what touches now is tested on the next rung
  bool resolved;  ///< also if it closes, for an impact has been resolved now
};

/// What of a pair meets first.
struct Meeting {
  TimeOfImpact impact = {};
  uint32_t tests = 0;    ///< times of impact asked for
  bool climbed = false;  ///< beyond the lowest rung
  bool left = false;     ///< something is so deep within the other that nothing of it is tested
  bool stuck = false;    ///< that has met within the tick, and does not part: it would go through

  Meeting() {
    impact.outcome = ToiOutcome::clear;
    impact.time = k_whole_step;
  }
  /// Time: a part of what is left of the tick.
  void take(const TimeOfImpact& found) {
    if (found.outcome == ToiOutcome::clear) return;
    if (impact.outcome == ToiOutcome::clear || found.time < impact.time) impact = found;
  }
};

/// Tests two convex shapes, or one and a surface, by `find`, rung by rung until they do not touch now, or close. False
/// if `find` is: they could not be asked.
template <class Find>
bool climb(const SweptBody& a, const SweptBody& b, Fraction time, const Ladder& ladder, const Find& find,
           Meeting& meeting) {
  TimeOfImpact found;
  bool looked_ahead = false;
  for (Real inset = ladder.first; !(inset > last_inset(ladder.extent)); inset = next_inset(ladder.extent, inset)) {
    ++meeting.tests;
    if (inset > ladder.first) meeting.climbed = true;
    if (!find(inset, found)) return false;
    // Cores that overlap have no normal.
    const bool now =
        found.outcome != ToiOutcome::clear && !(time + fraction_product(k_whole_step - time, found.time) > time);
    const auto closes = [&] {
      return !ladder.resolved &&
             (found.outcome == ToiOutcome::undecided || (is_direction(found.normal) && !is_parting(a, b, time, found)));
    };
    if (now && ladder.climbs && !closes()) {
      // Cores that overlap on the last rung do on all.
      if (looked_ahead || is_direction(found.normal)) continue;
      looked_ahead = meeting.climbed = true;
      ++meeting.tests;
      if (!find(last_inset(ladder.extent), found)) return false;
      if (found.outcome == ToiOutcome::clear || is_direction(found.normal)) continue;
      break;
    }
    meeting.take(found);
    return true;
  }
  meeting.left = true;
  if (ladder.resolved && !(is_direction(found.normal) && is_parting(a, b, time, found))) meeting.stuck = true;
  return true;
}

/// When the bodies of a pair meet from `time` on, on one rung after the other: what the rungs have in common is
/// prepared once. All that it is given must outlive it.
class PairSearch {
 public:
  PairSearch(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
             Fraction time)
      : assets_(assets), features_(features), a_(a), b_(b), time_(time) {}
  PairSearch(const PairSearch&) = delete;
  PairSearch& operator=(const PairSearch&) = delete;

  /// When they meet; the answer's time is a part of the whole tick. `axis`: a direction from A to B that may part them,
  /// or zero: it saves work, and decides nothing. False if it could not be asked: a shape is not known, or lies out of
  /// the query's range.
  bool find(const Ladder& ladder, Vec3<Unit> axis, Meeting& meeting);

 private:
  bool prepare_pair();
  bool find_convex(Real inset, const Vec3<Unit>& axis, TimeOfImpact& impact);

  const AssetTable& assets_;
  const FeatureTable& features_;
  const SweptBody &a_, &b_;
  const Fraction time_;
  bool prepared_ = false;
  Convex convex_a_, convex_b_;
  MovingPair pair_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
