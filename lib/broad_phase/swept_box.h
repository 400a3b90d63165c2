#pragma once
#include <detent/fraction.h>

#include "broad_phase/bounds_integer.h"
#include "math/vector_integer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A box along the axes on a straight way, or one that grows, for ruling out bounds: what it rules out the narrow phase
/// would not find either. For that all bounds are taken larger by more than the narrow phase's tolerance, which is a
/// part of the sizes of both.
///
/// In integers. A *cell* is a power of two of a metre: the way and the box are less than 2^29 of them long.
class SweptBox {
 public:
  /// Bounds as the box's centre sees them at the start, grown by the box: cells.
  struct Place {
    int64_t low[3], high[3];
  };

  /// `half`: of the box, `way`: of its centre, `reach`: up to which it will be asked for what is near; 2^-46 m, below
  /// 2^61.
  SweptBox(const Position& centre, const Vec64& half, const Vec64& way, int64_t reach);
  /// From now on only the part of the way up to `end` counts.
  void shorten(Fraction end);

  Place place_of(const Bounds& bounds) const;
  /// Whether the box may meet them on its way. Of what is ruled out entry() is later than the end.
  bool meets(const Place& place) const;
  /// Up to here the box does not meet them.
  Fraction entry(const Place& place) const;
  /// Whether they may be within `reach`, 2^-46 m, of the box at the start. Of what is ruled out gap() is more than
  /// that.
  bool is_near(const Place& place, int64_t reach) const;
  /// Of what is near: along the axis in which they are farthest apart, 2^-46 m; 0 if they overlap.
  int64_t gap(const Place& place) const;
  /// Whether the box comes to `b` before it comes to `a`; of no weight.
  bool is_ahead(const Bounds& a, const Bounds& b) const {
    return forward_ ? b.lower.*axis_ < a.lower.*axis_ : a.upper.*axis_ < b.upper.*axis_;
  }

 private:
  int64_t centre_[3];        ///< grains, rounded down
  int32_t way_[3];           ///< cells, rounded down
  int32_t half_[3];          ///< cells, rounded up
  int64_t from_[3], to_[3];  ///< of the part of the way that counts, cells
  int grain_shift_;          ///< a cell is 2^grain_shift_ grains
  int cell_bits_;            ///< a cell is 2^cell_bits_ 2^-46 m
  Coord Position::*axis_;
  bool forward_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
