#pragma once
#include <detent/query.h>

#include "base/heap.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The order of hits, also of hits with the triangles of one terrain. Of two equally near hits the decided one comes
/// before the undecided one. A candidate that cannot come before a decided hit therefore need not be tested.
struct HitOrder {
  bool operator()(const QueryHit& a, const QueryHit& b) const;
};

/// Collects the hits of a query, in any order.
class HitCollector {
 public:
  /// `end`, `distance_max`: the limits of the query, in time and in distance, m.
  HitCollector(bool all, QueryHits out, Fraction end, Real distance_max);

  void add(const QueryHit& hit);
  /// Sorts the hits and fills the report.
  void finish(QueryReport& report);

  /// The current limits in time and distance: a later or farther hit cannot be in the result.
  Fraction end() const { return end_; }
  Real distance_max() const { return distance_max_; }
  /// Whether no body with this slot or a higher one can be in the result, at any distance.
  bool rules_out(uint32_t slot) const { return first_slot_ <= slot; }

 private:
  bool all_;
  Fraction end_;
  Real distance_max_;
  uint32_t first_slot_ = UINT32_MAX;  ///< slot of a decided hit at time and distance 0
  SmallestOf<QueryHit, HitOrder> kept_;
  QueryHit first_;
  uint32_t count_ = 0;
  uint32_t undecided_ = 0;
  uint64_t digest_ = 0;  ///< the sum of the hits' digests, so that their order does not matter
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
