#pragma once
#include <detent/numbers.h>

#include "broad_phase/bounds_integer.h"
#include "math/vector_integer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// An axis-aligned box that moves on a straight path, or that grows. It rejects bounds, and is conservative: the narrow
/// phase would find nothing in the bounds that it rejects. For this, it enlarges all bounds by more than the tolerance
/// of the narrow phase, which is proportional to the sizes of both shapes.
///
/// It computes in integers. A *cell* is a power of two of a metre: the path and the box are less than 2^29 cells long.
class SweptBox {
 public:
  /// Bounds relative to the box's centre at the start, enlarged by the half extents of the box; cells.
  struct Place {
    int64_t low[3], high[3];
  };

  /// `half`: half extents of the box. `displacement`: displacement of its centre. `distance_max`: the greatest search
  /// distance that is_near() will be called with. All in 2^-46 m, below 2^61.
  SweptBox(const Position& centre, const Vec64& half, const Vec64& displacement, int64_t distance_max);
  /// Shortens the path to its part up to `end`.
  void shorten(Fraction end);

  Place place_of(const Bounds& bounds) const;
  /// Whether the box may touch these bounds on its path. If false, it does not touch them up to the end of the path.
  bool meets(const Place& place) const;
  /// The fraction of the path up to which the box certainly does not touch these bounds.
  Fraction entry(const Place& place) const;
  /// Whether these bounds may be within `distance_max`, 2^-46 m, of the box at the start. If false, gap() is more than
  /// `distance_max`.
  bool is_near(const Place& place, int64_t distance_max) const;
  /// The greatest distance along an axis between these bounds and the box at the start, 2^-46 m; 0 if they overlap.
  /// Overflow: clamped to 2^29 cells, which is more than any search distance.
  int64_t gap(const Place& place) const;
  /// Whether the box comes to `b` before it comes to `a`. This only orders the search; the result does not depend on
  /// it.
  bool is_ahead(const Bounds& a, const Bounds& b) const {
    return forward_ ? b.lower.*axis_ < a.lower.*axis_ : a.upper.*axis_ < b.upper.*axis_;
  }

 private:
  int64_t centre_[3];        ///< grains, rounded down
  int32_t displacement_[3];  ///< displacement of the centre, cells, rounded down
  int32_t half_[3];          ///< cells, rounded up
  int64_t from_[3], to_[3];  ///< range of the path up to its end, cells
  int grain_shift_;          ///< a cell is 2^grain_shift_ grains
  int cell_bits_;            ///< a cell is 2^(cell_bits_ - 46) m
  Coord Position::*axis_;
  bool forward_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
