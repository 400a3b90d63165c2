#pragma once
#include <detent/query.h>

#include "base/heap.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The order of hits, and of those with the triangles of a surface. Of two that are as near the one that is decided
/// comes first: so what a decided hit is known to beat need not be asked for.
struct HitOrder {
  bool operator()(const QueryHit& a, const QueryHit& b) const;
};

/// Takes the hits of a query in whatever order they are found.
class HitCollector {
 public:
  /// `end`, `reach`: of what is looked for.
  HitCollector(bool all, QueryHits out, Fraction end, Real reach);

  void add(const QueryHit& hit);
  /// Sorts what was found and tells of it.
  void finish(QueryReport& report);

  /// What is later, or farther, cannot be among the hits.
  Fraction end() const { return end_; }
  Real reach() const { return reach_; }
  /// Nor can a body of this slot or a higher one, wherever it is.
  bool rules_out(uint32_t slot) const { return first_slot_ <= slot; }

 private:
  bool all_;
  Fraction end_;
  Real reach_;
  uint32_t first_slot_ = UINT32_MAX;  ///< of a decided hit right at the start
  SmallestOf<QueryHit, HitOrder> kept_;
  QueryHit first_;
  uint32_t count_ = 0;
  uint32_t undecided_ = 0;
  uint64_t digest_ = 0;  ///< the sum of the hits': their order is of no weight
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
