#pragma once
#include <detent/contact.h>

#include "contact/contact_feature.h"

/// Clips an incident feature of one shape against a reference feature (a face or an edge) of the other shape. The
/// result is the contact area: the polygon in the reference plane where the two features face each other.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A corner of the contact area, in the axes of the reference: u and v are coordinates in the reference plane, and w is
/// the height above this plane along its normal. All are in ulps (2^-30 of the pair's unit of length).
struct AreaPoint {
  int64_t u, v, w;
  /// vertex: a vertex of the incident feature, over the reference. crossing: the point where an incident edge crosses a
  /// side of the reference. corner: a corner of the reference, over the incident face.
  enum class Kind : uint8_t { vertex, crossing, corner } kind;
  /// `incident`: the incident vertex, or the vertex where the incident edge starts. `side`: the side of the reference,
  /// or the corner where that side starts.
  uint8_t incident, side;
};

/// Distance between two points within the reference plane: |difference in u| + |difference in v|.
inline int64_t distance(const AreaPoint& p, const AreaPoint& q) {
  return static_cast<int64_t>(magnitude_64(p.u - q.u) + magnitude_64(p.v - q.v));
}

/// Chooses up to four of any number of points. If there are at most four points, and the first constructor is used, all
/// of them are chosen. Otherwise the reduction decides. projected_extremes takes the extreme points along four
/// directions. If the deepest point is deeper than all extremes by more than `drop`, it is added; if there are already
/// four extremes, the deepest point replaces the extreme that is nearest to it. deepest_area begins with the deepest
/// point. With both reductions, the places that are then free go, one by one, to the points that add most to the area.
/// Ties: the earlier point.
class AreaChoice {
 public:
  /// Leaves out points with a height w above `margin`.
  AreaChoice(int64_t margin, int64_t drop, ManifoldReduction reduction) : AreaChoice(margin, margin, drop, reduction) {}
  /// As the first constructor, but takes the extremes and the deepest point only from the points with a height of at
  /// most `level`. The free places go to points of any height up to `margin`.
  AreaChoice(int64_t level, int64_t margin, int64_t drop, ManifoldReduction reduction)
      : level_(level), margin_(margin), drop_(drop), reduction_(reduction) {}
  void add(const AreaPoint& point);
  /// Ends a pass in which the caller added all points. Returns true if the caller must add all points once more, in the
  /// same order. The points are not stored because there may be many.
  bool again();
  /// The number of chosen points, all distinct. Valid once again() has returned false.
  int count() const { return chosen_count_; }
  const AreaPoint& operator[](int i) const { return chosen_[i]; }

 private:
  static constexpr int k_diagonals = 4;
  /// Returns the gain that a further point must exceed to be chosen. The gain of a point (gain_of()) is its squared
  /// distance from the only chosen point, or twice the area that it adds to two or three chosen points. With two chosen
  /// points the result is 1/64 of their squared distance. With three, it is 1/8 of twice the area of their triangle.
  /// With one chosen point, and for deepest_area, it is 0.
  int64_t least_gain() const;
  int64_t gain_of(const AreaPoint& point) const;
  void choose_extremes();
  int64_t level_, margin_, drop_;
  ManifoldReduction reduction_;
  /// filling_: the first pass is over, and each further pass chooses one point for a free place. found_: next_ is the
  /// best point of this pass so far.
  bool filling_ = false, found_ = false;
  uint32_t count_ = 0;
  int chosen_count_ = 0;
  int64_t most_ = 0;  ///< gain of next_
  AreaPoint chosen_[4], next_;
  AreaPoint farthest_[k_diagonals], deepest_;
};

/// A reference feature (a face or an edge) with its sides and axes. `up` is its normal, towards the other shape.
class Reference {
 public:
  /// `centre`: the centre of the reference's shape, from A's centre, in ulps of the pair's block. `size`: the bounding
  /// radius of the incident core or shape, ulps. A vertex counts as inside a side if it is at most the *slack* beyond
  /// this side, so that vertices flush with the side stay inside. The slack is 1/64 of the smaller of two lengths:
  /// `size`, and the least distance of a side from the feature's middle. Incident edges are cut at the side itself. If
  /// the end of the edge that is kept is within the slack of the side, this end is used in place of the cut. `aside`:
  /// for a reference edge, the lateral distance, ulps, up to which a point counts as over the edge.
  Reference(const Placed& placed, const Vec32& centre, const Feature& feature, const Vec32& up, int32_t size,
            int64_t aside = 0);
  /// The plane of a half-space as the reference. `foot`: any point near the contact. `centre` and `foot` are relative
  /// to A's centre, in ulps of the pair's block.
  Reference(const Placed& half_space, const Vec32& centre, const Vec32& foot);

  /// Clips `incident` against the sides of the reference. `centre`: the centre of the shape to which `incident`
  /// belongs, in ulps from A's centre. Adds the corners of the contact area to `choice`.
  void clip(const Vec32& centre, const Feature& incident, AreaChoice& choice) const;

  /// Whether `point` (in ulps from A's centre) is over the reference: inside all of its sides, by the same test as in
  /// clip().
  bool holds(const Vec32& point) const { return holds(flat(point)); }
  /// Converts `point`, in ulps from A's centre, to the reference's axes. `kind` of the result has no meaning.
  AreaPoint over(const Vec32& point) const;
  /// The height of `point` above the reference, in ulps. `point` is given in ulps from A's centre. For a point beyond
  /// an end of a reference edge: the height above this end.
  int64_t height_of(const Vec32& point) const;
  /// Returns twice the midpoint between the two cores at a point of the contact area, in ulps from A's centre.
  Vec64 twice_middle(const AreaPoint& point) const;
  const Vec32& up() const { return up_; }
  uint32_t name_on_reference(const AreaPoint& point) const;
  uint32_t name_on_incident(const Placed& placed, const Feature& incident, const AreaPoint& point) const;

 private:
  struct Side {
    int32_t u, v;   ///< outward normal, Q30; 0 for a side of zero length
    int64_t limit;  ///< the points (x, y) with u x + v y <= limit lie inside the side; in 2^-30 ulps
  };
  struct Flat {
    int64_t u, v, w;
  };
  Flat flat(const Vec32& point) const;
  bool holds(const Flat& p) const;
  void set_axes(const Vec32& along);
  void add_sides(const Vec32& centre, int32_t size, int64_t aside);
  void clip_edge(const Flat& p, const Flat& q, uint8_t from, bool closed, AreaChoice& choice) const;
  void offer_corners(const Flat* points, const Feature& incident, AreaChoice& choice) const;
  /// The slack beyond a side (see the constructor), in 2^-30 ulps. The lateral limits of a reference edge have no
  /// slack.
  int64_t slack_at(int side) const { return side < feature_->count ? slack_ * k_one_64 : 0; }
  int64_t beyond(const Flat& p, int side) const {
    return side_[side].u * p.u + side_[side].v * p.v - side_[side].limit;
  }

  const Placed& placed_;
  const Feature* feature_ = nullptr;  ///< null for a half-space
  uint32_t name_;
  Vec32 origin_, u_, v_, up_;
  int64_t height_ = 0;  ///< height of the reference plane above origin_
  int64_t slope_ = 0;   ///< Q30; rise of a reference edge per unit of u; 0 for a face
  int64_t slack_ = 0;
  int side_count_ = 0;
  Side side_[k_feature_points_max];
  Flat corner_[k_feature_points_max];  ///< the start of each side
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
