#pragma once
#include <detent/numbers.h>

#include "broad_phase/bounds_integer.h"
#include "math/vector_integer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// An axis-aligned box that moves on a straight path, or that grows by a search distance. It tests bounds
/// conservatively: if it rejects the bounds of a body, the narrow phase would not find a hit with the body. To ensure
/// this, it enlarges all bounds by more than the tolerance of the narrow phase. This tolerance is proportional to the
/// sizes of both shapes.
///
/// The class computes in integers. Its unit of length is a *cell*: a power of two, m, so large that the path and the
/// box are less than 2^29 cells long.
class SweptBox {
 public:
  /// A body's bounds relative to the box's centre at the start, enlarged by the half extents of the box, in cells.
  struct Place {
    int64_t low[3], high[3];
  };

  /// `half`: half extents of the box. `displacement`: displacement of its centre. `distance_max`: the greatest search
  /// distance that is_near() will be called with. All in units of 2^-46 m, below 2^61 in magnitude.
  SweptBox(const Position& centre, const Vec64& half, const Vec64& displacement, int64_t distance_max);
  /// Shortens the path, so that it ends at the fraction `end` of the whole path.
  void shorten(Fraction end);

  Place place_of(const Bounds& bounds) const;
  /// Whether the box may touch the bounds of `place` on its path. If false, the box certainly does not touch them.
  bool meets(const Place& place) const;
  /// A fraction of the path up to which the box certainly does not touch the bounds of `place`; at most 1.
  Fraction entry(const Place& place) const;
  /// Whether the distance between the bounds of `place` and the box at the start of its path may be at most
  /// `distance_max`, in units of 2^-46 m. If false, gap() exceeds `distance_max`.
  bool is_near(const Place& place, int64_t distance_max) const;
  /// The greatest distance along a coordinate axis between the bounds of `place` and the box at the start of its path,
  /// in units of 2^-46 m; 0 if they overlap. Overflow: clamped to 2^29 cells, which is more than any search distance.
  int64_t gap(const Place& place) const;
  /// Whether the box reaches the bounds `b` before the bounds `a`. This only determines the order of the search, not
  /// its result.
  bool is_ahead(const Bounds& a, const Bounds& b) const {
    return forward_ ? b.lower.*axis_ < a.lower.*axis_ : a.upper.*axis_ < b.upper.*axis_;
  }

 private:
  int64_t centre_[3];        ///< centre at the start, in grains (4 units of integer_from()), rounded down
  int32_t displacement_[3];  ///< displacement of the centre, cells, rounded down
  int32_t half_[3];          ///< half extents of the box and its tolerance, cells, rounded up
  int64_t from_[3], to_[3];  ///< range of the centre's displacement on the (shortened) path, cells
  int grain_shift_;          ///< a cell is 2^grain_shift_ grains (4 units of integer_from())
  int cell_bits_;            ///< a cell is 2^(cell_bits_ - 46) m
  Coord Position::*axis_;
  bool forward_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
