#include "contact/contact_clip.h"

#include "math/root.h"

// Bit widths: all points lie within 2^30 ulps of the block's origin, so the difference of two points is below 2^31, and
// its product with a Q30 number below 2^61. Cross products in the plane are below 2^62, also for corners that are moved
// outward by the slack.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_no_limit = INT64_MAX / 2;
constexpr int k_slack_power = 6;

/// Returns part / whole in Q30. Range: 0 <= part <= whole, whole > 0.
int64_t fraction(int64_t part, int64_t whole) { return divide_rounded(Int128::product(part, k_one_64), whole); }

/// Returns twice the signed area of the triangle p, q, r in the reference plane; its magnitude is below 2^62.
int64_t twice_area(const AreaPoint& p, const AreaPoint& q, const AreaPoint& r) {
  return (q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u);
}

int64_t distance_squared(const AreaPoint& p, const AreaPoint& q) {
  const int64_t u = p.u - q.u, v = p.v - q.v;
  return u * u + v * v;
}

/// Returns the coordinate of a point along one of four diagonal directions, which are not normalised. The directions
/// are rotated slightly from the diagonals of a square. So even a regular octagon or dodecagon has a single extreme
/// point along each direction.
int64_t extent_along(const AreaPoint& p, int diagonal) {
  const int64_t along = (diagonal & 1) == 0 ? 4 * p.u + 5 * p.v : 4 * p.v - 5 * p.u;
  return diagonal < 2 ? along : -along;
}

}  // namespace

__attribute__((noinline)) void AreaChoice::add(const AreaPoint& point) {
  if (point.w > (filling_ ? margin_ : level_)) return;
  if (filling_) {
    const int64_t gain = gain_of(point);
    if (gain > most_) {
      most_ = gain;
      next_ = point;
      found_ = true;
    }
    return;
  }
  if (count_ < 4) chosen_[chosen_count_++] = point;
  for (int i = 0; i < k_diagonals; ++i) {
    if (count_ == 0 || extent_along(point, i) > extent_along(farthest_[i], i)) farthest_[i] = point;
  }
  if (count_ == 0 || point.w < deepest_.w) deepest_ = point;
  ++count_;
}

int64_t AreaChoice::gain_of(const AreaPoint& point) const {
  const AreaPoint* c = chosen_;
  if (chosen_count_ == 1) return distance_squared(c[0], point);
  const int64_t first = twice_area(c[0], c[1], point);
  if (chosen_count_ == 2) return first < 0 ? -first : first;
  const bool left = twice_area(c[0], c[1], c[2]) > 0;
  const int64_t beyond[3] = {first, twice_area(c[1], c[2], point), twice_area(c[2], c[0], point)};
  int64_t gain = 0;
  for (const int64_t area : beyond) gain = left ? (-area > gain ? -area : gain) : (area > gain ? area : gain);
  return gain;
}

int64_t AreaChoice::least_gain() const {
  const AreaPoint* c = chosen_;
  if (chosen_count_ == 1 || reduction_ == ManifoldReduction::deepest_area) return 0;
  if (chosen_count_ == 2) return distance_squared(c[0], c[1]) >> 6;
  return static_cast<int64_t>(magnitude_64(twice_area(c[0], c[1], c[2]))) >> 3;
}

void AreaChoice::choose_extremes() {
  const auto same = [](const AreaPoint& p, const AreaPoint& q) {
    return p.kind == q.kind && p.incident == q.incident && p.side == q.side;
  };
  int nearest = 0;
  bool deep = false;
  for (const AreaPoint& point : farthest_) {
    bool fresh = true;
    for (int k = 0; k < chosen_count_; ++k) fresh = fresh && !same(chosen_[k], point);
    if (!fresh) continue;
    deep = deep || point.w <= deepest_.w + drop_;
    if (distance(point, deepest_) < distance(chosen_[nearest], deepest_)) nearest = chosen_count_;
    chosen_[chosen_count_++] = point;
  }
  if (deep) return;
  chosen_[chosen_count_ < 4 ? chosen_count_++ : nearest] = deepest_;
}

__attribute__((noinline)) bool AreaChoice::again() {
  if (filling_) {
    if (!found_) return false;
    chosen_[chosen_count_++] = next_;
  } else {
    if (count_ <= 4 && level_ == margin_) return false;
    filling_ = true;
    chosen_count_ = 0;
    if (reduction_ == ManifoldReduction::deepest_area)
      chosen_[chosen_count_++] = deepest_;
    else
      choose_extremes();
  }
  if (chosen_count_ == 4) return false;
  most_ = least_gain();
  found_ = false;
  return true;
}

Reference::Reference(const Placed& placed, const Vec32& centre, const Feature& feature, const Vec32& up, int32_t size,
                     int64_t aside)
    : placed_(placed), feature_(&feature), name_(feature.name()), up_(up) {
  Vec64 sum = {0, 0, 0};
  for (int i = 0; i < feature.count; ++i)
    sum = add(sum, Vec64{feature.point[i].x, feature.point[i].y, feature.point[i].z});
  origin_ = add(centre, Vec32{static_cast<int32_t>(sum.x / feature.count), static_cast<int32_t>(sum.y / feature.count),
                              static_cast<int32_t>(sum.z / feature.count)});
  if (feature.is_face()) {
    set_axes(feature.along);
    height_ = dot(up, subtract(add(centre, support(placed, up).point), origin_)) >> 30;
  } else {
    // The axes u and v are perpendicular to the contact normal, as for a face, although the edge may slope against the
    // normal. So heights are measured along the normal, however far away the other core is.
    const Vec32 along = unit_vector_raw(scaled_to_30_bits(subtract(feature.point[1], feature.point[0])));
    set_axes(along);
    const int64_t run = dot(u_, along) >> 30;
    slope_ = run > 0 ? dot(up, along) / run : 0;
  }
  add_sides(centre, size, aside);
}

Reference::Reference(const Placed& half_space, const Vec32& centre, const Vec32& foot)
    : placed_(half_space),
      name_(feature_name(FeatureType::face, 0)),
      origin_(foot),
      up_(half_space.rotation.column[1]) {
  set_axes(half_space.rotation.column[0]);
  height_ = dot(up_, subtract(centre, foot)) >> 30;
}

void Reference::set_axes(const Vec32& along) {
  v_ = unit_vector_raw(scaled_to_30_bits(cross(up_, along)));
  u_ = unit_vector_raw(scaled_to_30_bits(cross(v_, up_)));
}

Reference::Flat Reference::flat(const Vec32& point) const {
  const Vec32 p = subtract(point, origin_);
  const int64_t u = dot(u_, p) >> 30;
  return {u, dot(v_, p) >> 30, (dot(up_, p) >> 30) - height_ - ((u * slope_) >> 30)};
}

AreaPoint Reference::over(const Vec32& point) const {
  const Flat p = flat(point);
  return {p.u, p.v, p.w, AreaPoint::Kind::vertex, 0, 0};
}

bool Reference::holds(const Flat& p) const {
  for (int i = 0; i < side_count_; ++i) {
    if (beyond(p, i) > slack_at(i)) return false;
  }
  return true;
}

int64_t Reference::height_of(const Vec32& point) const {
  const Flat p = flat(point);
  if (feature_ == nullptr || feature_->is_face()) return p.w;
  const int64_t first = -(side_[0].limit >> 30), last = side_[1].limit >> 30;
  const int64_t beyond_end = p.u < first ? p.u - first : p.u > last ? p.u - last : 0;
  return p.w + ((beyond_end * slope_) >> 30);
}

void Reference::add_sides(const Vec32& centre, int32_t size, int64_t aside) {
  side_count_ = feature_->count;
  int64_t inner = k_no_limit;
  for (int i = 0; i < side_count_; ++i) {
    const Flat p = flat(add(centre, feature_->point[i]));
    const Flat q = flat(add(centre, feature_->point[i + 1 == side_count_ ? 0 : i + 1]));
    Side& side = side_[i];
    corner_[i] = p;
    if (!feature_->is_face()) {
      side = {static_cast<int32_t>(i == 0 ? -k_one_64 : k_one_64), 0, (i == 0 ? -p.u : p.u) * k_one_64};
    } else if (p.u == q.u && p.v == q.v) {
      side = {0, 0, k_no_limit};
      continue;
    } else {
      const Vec32 out = unit_vector_raw(scaled_to_30_bits(Vec64{q.v - p.v, p.u - q.u, 0}));
      side = {out.x, out.y, out.x * p.u + out.y * p.v};
    }
    inner = side.limit < inner ? side.limit : inner;
  }
  inner = inner >> 30 < size ? inner >> 30 : size;
  slack_ = inner > 0 ? inner >> k_slack_power : 0;
  if (feature_->is_face()) return;
  side_[side_count_++] = {0, k_one, aside * k_one_64};
  side_[side_count_++] = {0, -k_one, aside * k_one_64};
}

void Reference::clip_edge(const Flat& p, const Flat& q, uint8_t from, bool closed, AreaChoice& choice) const {
  int64_t enters = -1, leaves = k_one_64 + 1;  // fractions of the edge's length, Q30
  int entered = -1, left = -1;
  for (int i = 0; i < side_count_; ++i) {
    const int64_t at_p = beyond(p, i), at_q = beyond(q, i), slack = slack_at(i);
    const bool enters_here = at_p > slack;
    if (enters_here && at_q > slack) return;
    if (!enters_here && at_q <= slack) continue;
    const int64_t inner = enters_here ? at_q : at_p, outer = enters_here ? at_p : at_q;
    const int64_t from_inner = inner >= 0 ? 0 : fraction(-inner, outer - inner);
    if (enters_here && k_one_64 - from_inner > enters) {
      enters = k_one_64 - from_inner;
      entered = i;
    } else if (!enters_here && from_inner < leaves) {
      leaves = from_inner;
      left = i;
    }
  }
  if (enters > leaves) return;
  const int only = left < 0 ? entered : entered < 0 ? left : -1;  // the only side that cuts the edge, or -1
  // If the end that is kept lies within the slack of the side `only`, the end is used in place of the crossing point.
  const bool near = only >= 0 && beyond(left < 0 ? q : p, only) >= -slack_at(only);
  const auto crossing = [&](int64_t t, int side, uint8_t end) {
    if (near) return;
    const auto between = [t](int64_t a, int64_t b) { return a + (((b - a) * t) >> 30); };
    AreaPoint point = {between(p.u, q.u),         between(p.v, q.v), between(p.w, q.w), AreaPoint::Kind::crossing, from,
                       static_cast<uint8_t>(side)};
    // The sides with an index of feature_->count or more limit the lateral distance from a reference edge. A point
    // where the incident edge is cut at such a side still counts as the end of the incident edge.
    if (side >= feature_->count) {
      point.kind = AreaPoint::Kind::vertex;
      point.incident = end;
    }
    choice.add(point);
  };
  if (entered < 0)
    choice.add({p.u, p.v, p.w, AreaPoint::Kind::vertex, from, 0});
  else
    crossing(enters, entered, from);
  if (left >= 0)
    crossing(leaves, left, static_cast<uint8_t>(from + 1));
  else if (!closed)
    choice.add({q.u, q.v, q.w, AreaPoint::Kind::vertex, static_cast<uint8_t>(from + 1), 0});
}

/// Adds the corners of the reference face that lie over the incident face, given by its vertices `points`. For this
/// test only, the corners are moved outward by the slack.
void Reference::offer_corners(const Flat* points, const Feature& incident, AreaChoice& choice) const {
  // rad; an incident face that is seen edge-on within this angle is over no corner
  constexpr int64_t k_edge_on = k_one_64 >> 6;
  const int64_t nu = dot(incident.normal, u_) >> 30, nv = dot(incident.normal, v_) >> 30,
                nw = dot(incident.normal, up_) >> 30;
  if (nw > -k_edge_on) return;
  int64_t lowest = points[0].w;
  for (int k = 1; k < incident.count; ++k) lowest = points[k].w < lowest ? points[k].w : lowest;
  for (int i = 0; i < side_count_; ++i) {
    const Side &side = side_[i], &last = side_[i == 0 ? side_count_ - 1 : i - 1];
    const int64_t cross_product = k_one_64 + ((int64_t{side.u} * last.u + int64_t{side.v} * last.v) >> 30);
    if (cross_product < k_one_64 >> 18) continue;  // the interior angle is less than 0.16 degrees
    // The intersection of the previous side and this side, both moved outward.
    const Flat& corner = corner_[i];
    const int64_t u = corner.u + slack_ * (int64_t{side.u} + last.u) / cross_product;
    const int64_t v = corner.v + slack_ * (int64_t{side.v} + last.v) / cross_product;
    bool inside = true;
    for (int k = 0; k < incident.count && inside; ++k) {
      const Flat &p = points[k], &q = points[k + 1 == incident.count ? 0 : k + 1];
      // The incident face is clockwise as seen from the reference.
      inside = (q.u - p.u) * (v - p.v) - (q.v - p.v) * (u - p.u) <= 0;
    }
    if (!inside) continue;
    // The height of the incident plane is taken over the corner itself, not over the moved corner. The corner may lie
    // beside a steep incident face, where the plane of that face is lower than all of its vertices. The height is
    // therefore raised to at least that of the lowest vertex.
    const int64_t plane = (nu * (points[0].u - corner.u) + nv * (points[0].v - corner.v)) / nw + points[0].w;
    choice.add(
        {corner.u, corner.v, plane < lowest ? lowest : plane, AreaPoint::Kind::corner, 0, static_cast<uint8_t>(i)});
  }
}

void Reference::clip(const Vec32& centre, const Feature& incident, AreaChoice& choice) const {
  Flat points[k_feature_points_max] = {};
  for (int i = 0; i < incident.count; ++i) points[i] = flat(add(centre, incident.point[i]));
  if (incident.count == 1) {
    if (holds(points[0])) choice.add({points[0].u, points[0].v, points[0].w, AreaPoint::Kind::vertex, 0, 0});
    return;
  }
  const bool closed = incident.is_face();
  for (int i = 0; i < (closed ? incident.count : 1); ++i) {
    clip_edge(points[i], points[i + 1 == incident.count ? 0 : i + 1], static_cast<uint8_t>(i), closed, choice);
  }
  if (closed && feature_ != nullptr && feature_->is_face()) offer_corners(points, incident, choice);
}

Vec64 Reference::twice_middle(const AreaPoint& point) const {
  const bool is_edge = feature_ != nullptr && !feature_->is_face();
  // A point of a reference edge has v = 0, and the point of the other shape has the coordinate point.v. The midpoint is
  // therefore at point.v / 2.
  const int64_t u = 2 * point.u, v = is_edge ? point.v : 2 * point.v;
  const int64_t w = 2 * (height_ + ((point.u * slope_) >> 30)) + point.w;
  const auto component = [&](int32_t o, int32_t a, int32_t b, int32_t c) {
    return 2 * int64_t{o} + round_shift_64(u * a, 30) + round_shift_64(v * b, 30) + round_shift_64(w * c, 30);
  };
  return {component(origin_.x, u_.x, v_.x, up_.x), component(origin_.y, u_.y, v_.y, up_.y),
          component(origin_.z, u_.z, v_.z, up_.z)};
}

uint32_t Reference::name_on_reference(const AreaPoint& point) const {
  if (point.kind == AreaPoint::Kind::vertex) return name_;
  const uint32_t from = feature_->vertex[point.side];
  if (point.kind == AreaPoint::Kind::corner || !feature_->is_face()) return feature_name(FeatureType::vertex, from);
  const uint32_t to = feature_->vertex[point.side + 1 == feature_->count ? 0 : point.side + 1];
  return feature_name(FeatureType::edge, edge_index(placed_, from, to));
}

uint32_t Reference::name_on_incident(const Placed& placed, const Feature& incident, const AreaPoint& point) const {
  if (point.kind == AreaPoint::Kind::corner) return incident.name();
  const uint32_t from = incident.vertex[point.incident];
  if (point.kind == AreaPoint::Kind::vertex) return feature_name(FeatureType::vertex, from);
  if (!incident.is_face()) return incident.name();
  const uint32_t to = incident.vertex[point.incident + 1 == incident.count ? 0 : point.incident + 1];
  return feature_name(FeatureType::edge, edge_index(placed, from, to));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
