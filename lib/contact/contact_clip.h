#pragma once
#include <detent/reduction.h>

#include "contact/contact_feature.h"

/// The area where a reference feature (a face or an edge) and an incident one face each other.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A corner of the area, in the reference's axes: u and v across its normal, w above it along the normal. Ulps of the
/// block.
struct AreaPoint {
  int64_t u, v, w;
  /// Made of: a vertex of the incident feature and the reference; an incident edge and a side of the reference; a
  /// corner of the reference and the incident face.
  enum class Kind : uint8_t { vertex, crossing, corner } kind;
  uint8_t incident, side;  ///< the incident point, or where the edge starts; the side, or the corner where it starts
};

/// Across the reference, as a sum of magnitudes.
inline int64_t distance(const AreaPoint& p, const AreaPoint& q) {
  return static_cast<int64_t>(magnitude_64(p.u - q.u) + magnitude_64(p.v - q.v));
}

/// Keeps up to four of any number of points: all of four; of more those that the reduction names. Of projected extremes
/// the deepest takes the nearest one's place if all are higher by more than `drop`; where several extremes are one
/// point, those that add most to the area follow. Of equal ones the earlier.
class AreaChoice {
 public:
  /// Points above `reach` are left out.
  AreaChoice(int64_t reach, int64_t drop, ManifoldReduction reduction) : AreaChoice(reach, reach, drop, reduction) {}
  /// Those above `level` only follow where several extremes of the others are one point.
  AreaChoice(int64_t level, int64_t reach, int64_t drop, ManifoldReduction reduction)
      : level_(level), reach_(reach), drop_(drop), reduction_(reduction) {}
  void add(const AreaPoint& point);
  /// True if all points are to be added once more, in the same order: there may be many, and they are not held.
  bool again();
  /// The points chosen, distinct, once all have been added as often as again() asks.
  int count() const { return chosen_count_; }
  const AreaPoint& operator[](int i) const { return chosen_[i]; }

 private:
  static constexpr int k_diagonals = 4;
  /// What another corner must gain to follow the extremes: an area of a 64th of the distance of two, squared; an eighth
  /// of that of three.
  int64_t least_gain() const;
  int64_t gain_of(const AreaPoint& point) const;
  void choose_extremes();
  int64_t level_, reach_, drop_;
  ManifoldReduction reduction_;
  bool filling_ = false, found_ = false;  ///< corners are added one by one; next_ is another
  uint32_t count_ = 0;
  int chosen_count_ = 0;
  int64_t most_ = 0;  ///< gained by next_
  AreaPoint chosen_[4], next_;
  AreaPoint farthest_[k_diagonals], deepest_;
};

/// A reference feature with its sides, and axes: `up` is the normal, from it to the other shape.
class Reference {
 public:
  /// `centre`: of the shape, in the block. `size`: of the incident shape, ulps: the sides are moved out by a 64th of it
  /// or of the face, whichever is smaller, so that what lies flush stays inside. What is farther aside of an edge than
  /// `aside`, ulps, does not face it.
  Reference(const Placed& placed, const Vec32& centre, const Feature& feature, const Vec32& up, int32_t size,
            int64_t aside = 0);
  /// The plane of a half-space; `foot`: any point near the contact.
  Reference(const Placed& half_space, const Vec32& centre, const Vec32& foot);

  /// Offers the corners of the area to `choice`.
  void clip(const Vec32& centre, const Feature& incident, AreaChoice& choice) const;

  /// Whether a point in the block is over the reference, as clip() counts it.
  bool holds(const Vec32& point) const;
  /// A point in the block as one of the area, of no kind.
  AreaPoint over(const Vec32& point) const;
  /// How high a point is above the reference, and beyond an edge's end above that, in the block.
  int64_t height_of(const Vec32& point) const;
  /// Of a point of the area: twice the middle between the two cores, in the block.
  Vec64 twice_middle(const AreaPoint& point) const;
  const Vec32& up() const { return up_; }
  uint32_t name_on_reference(const AreaPoint& point) const;
  uint32_t name_on_incident(const Placed& placed, const Feature& incident, const AreaPoint& point) const;

 private:
  struct Side {
    int32_t u, v;   ///< outward, Q30; 0 for a side of no length
    int64_t limit;  ///< Q30 ulps
  };
  struct Flat {
    int64_t u, v, w;
  };
  Flat flat(const Vec32& point) const;
  void set_axes(const Vec32& along);
  void add_sides(const Vec32& centre, int32_t size, int64_t aside);
  void clip_edge(const Flat& p, const Flat& q, uint8_t from, bool closed, AreaChoice& choice) const;
  void offer_corners(const Flat* points, const Feature& incident, AreaChoice& choice) const;
  int64_t beyond(const Flat& p, int side) const {
    return side_[side].u * p.u + side_[side].v * p.v - side_[side].limit;
  }

  const Placed& placed_;
  const Feature* feature_ = nullptr;  ///< none of a half-space
  uint32_t name_;
  Vec32 origin_, u_, v_, up_;
  int64_t height_ = 0;  ///< of the reference above the origin
  int64_t slope_ = 0;   ///< Q30; of an edge: its rise along u
  int64_t slack_ = 0;
  int side_count_ = 0;
  Side side_[k_feature_points_max];
  Flat corner_[k_feature_points_max];  ///< where each side starts
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
