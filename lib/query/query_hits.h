#pragma once
#include <detent/query.h>

#include "base/heap.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The order of the hits on bodies, and of the hits on the triangles of one terrain. Of two equally near hits, a
/// decided hit comes before an undecided one (QueryHit::undecided). Therefore a body need not be tested if it is
/// certainly not nearer than a decided hit, and would come after that hit at equal distance.
struct HitOrder {
  bool operator()(const QueryHit& a, const QueryHit& b) const;
};

/// Collects the hits of a query, in any order.
class HitCollector {
 public:
  /// `all`: whether the result has all hits, not only the first. `end`, `distance_max`: the limits of the query, as a
  /// fraction of the motion and as a distance, m.
  HitCollector(bool all, QueryHits out, Fraction end, Real distance_max);

  void add(const QueryHit& hit);
  /// Sorts the hits and fills the report.
  void finish(QueryReport& report);

  /// The current limits, as a fraction of the motion and as a distance, m: a later or farther hit cannot be in the
  /// result.
  Fraction end() const { return end_; }
  Real distance_max() const { return distance_max_; }
  /// Whether a body with this slot or a higher slot cannot be in the result, at any distance.
  bool rules_out(uint32_t slot) const { return first_slot_ <= slot; }

 private:
  bool all_;
  Fraction end_;
  Real distance_max_;
  uint32_t first_slot_ = UINT32_MAX;  ///< slot of a decided hit at fraction 0 and distance 0
  SmallestOf<QueryHit, HitOrder> kept_;
  QueryHit first_;
  uint32_t count_ = 0;
  uint32_t undecided_ = 0;
  uint64_t digest_ = 0;  ///< the sum of the hits' digests, so that their order does not matter
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
