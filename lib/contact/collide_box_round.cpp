#include "base/cycle.h"
#include "contact/collide_shapes.h"
#include "contact/segments.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

// If the core of the round shape is closer to the box than this (pair's unit), their nearest points give no reliable
// direction.
constexpr Unit k_meeting = 0x1p-24;
// A normal within 2^-13 rad of a face normal is replaced by the face normal. This changes lengths by a factor of at
// most 1 + 2^-27. With the face normal, a capsule that lies across the edge of a face keeps its two contact points when
// it jitters.
constexpr int k_upright_power = -13;

struct Axes {
  Unit v[3];
};
Axes axes_of(const Vec3<Unit>& v) { return {{v.x, v.y, v.z}}; }
Vec3<Unit> vector_of(const Axes& a) { return {a.v[0], a.v[1], a.v[2]}; }

/// A box at the origin and a segment, in the box's axes.
struct BoxAndSegment {
  Axes half, centre, direction;
  Unit half_length;

  Unit at(int axis, Unit along) const { return centre.v[axis] + direction.v[axis] * along; }
  /// For each axis, the signed distance by which the segment's point at `along` lies outside the box; 0 if it is within
  /// the box's extent.
  Axes excess(Unit along) const {
    Axes result;
    for (int i = 0; i < 3; ++i) {
      const Unit p = at(i, along);
      result.v[i] = p - clamp(p, -half.v[i], half.v[i]);
    }
    return result;
  }
  /// Half the derivative of the squared distance to the box with respect to `along`. It never decreases, and it is
  /// linear between the planes of the faces.
  Unit slope(Unit along) const { return dot(vector_of(direction), vector_of(excess(along))); }
};

/// Returns the position along the segment, from its centre, of its point closest to the box. At this point, slope()
/// changes its sign, or the segment ends. The function computes slope() where the segment crosses planes of faces,
/// finds the two neighbouring crossings between which the sign changes, and interpolates once between them. If the
/// slope is zero over an interval, the result is the middle of that interval.
Unit closest_along(const BoxAndSegment& pair) {
  const Unit zero = 0.0;
  const Unit limit = pair.half_length;
  Unit low = -limit, high = limit;
  Unit low_slope = pair.slope(low), high_slope = pair.slope(high);
  if (low_slope >= zero && !(low_slope == zero && high_slope == zero)) {
    if (low_slope > zero) return low;
  }
  if (high_slope < zero) return high;
  Unit zero_low = limit, zero_high = -limit;
  const auto visit = [&](Unit along) {
    const Unit slope = pair.slope(along);
    if (slope < zero && along >= low) {
      low = along;
      low_slope = slope;
    } else if (slope > zero && along <= high) {
      high = along;
      high_slope = slope;
    } else if (slope == zero) {
      zero_low = min(zero_low, along);
      zero_high = max(zero_high, along);
    }
  };
  visit(-limit);
  visit(limit);
  for (int axis = 0; axis < 3; ++axis) {
    const Unit speed = abs(pair.direction.v[axis]);
    for (int side = 0; side < 2; ++side) {
      const Unit face = side == 0 ? pair.half.v[axis] : -pair.half.v[axis];
      const Unit shift = pair.direction.v[axis] < zero ? pair.centre.v[axis] - face : face - pair.centre.v[axis];
      if (abs(shift) < limit * speed) visit(divide(shift, speed));
    }
  }
  if (zero_low <= zero_high) return zero_low + scale_by_power(zero_high - zero_low, -1);
  const Unit span = high_slope - low_slope;
  return span > zero ? low + (high - low) * divide(-low_slope, span) : low;
}

/// The contact of a box and a segment, in the box's axes.
struct BoxContact {
  Axes normal;  ///< outward from the box
  int face;     ///< axis of the face to which the normal belongs; -1: the normal is not that of a face
  Unit along;   ///< position of the contact point along the segment; used if `face` is -1

  /// Moves the contact to the face that is perpendicular to `axis`, on the side to which the normal points. The normal
  /// becomes the normal of that face.
  void set_face(int axis) {
    const Unit side = normal.v[axis] < Unit(0.0) ? Unit(-1.0) : Unit(1.0);
    face = axis;
    normal = {{0.0, 0.0, 0.0}};
    normal.v[axis] = side;
  }
};

/// Returns the contact in the direction of least overlap, for a box and a segment that intersect.
BoxContact least_overlap(const BoxAndSegment& pair) {
  const Unit zero = 0.0;
  BoxContact best{};
  Unit best_separation = -1.5;
  for (int axis = 0; axis < 3; ++axis) {
    const Unit separation =
        abs(pair.centre.v[axis]) - pair.half_length * abs(pair.direction.v[axis]) - pair.half.v[axis];
    if (separation > best_separation) {
      best_separation = separation;
      best = {{{zero, zero, zero}}, axis, zero};
      best.normal.v[axis] = pair.centre.v[axis] < zero ? Unit(-1.0) : Unit(1.0);
    }
  }
  if (pair.half_length == zero) return best;
  for (int axis = 0; axis < 3; ++axis) {
    Axes edge = {{zero, zero, zero}};
    edge.v[axis] = 1.0;
    Vec3<Unit> normal;
    Unit size = zero;
    if (!normalise(cross(vector_of(edge), vector_of(pair.direction)), normal, size) || size < Unit(0x1p-5)) continue;
    if (dot(normal, vector_of(pair.centre)) < zero) normal = -normal;
    const Axes n = axes_of(normal);
    Unit support = zero;
    for (int i = 0; i < 3; ++i) support += pair.half.v[i] * abs(n.v[i]);
    const Unit separation = dot(normal, vector_of(pair.centre)) - support;
    // An edge replaces a face only if the separation along its normal is clearly larger. So a resting pair does not
    // alternate between face and edge.
    if (separation > best_separation + scale_by_power(pair.half.v[axis], -6)) {
      best_separation = separation;
      Segment box_edge = {vector_of({{zero, zero, zero}}), vector_of(edge), pair.half.v[axis]};
      Axes middle;
      for (int i = 0; i < 3; ++i) middle.v[i] = i == axis ? zero : (n.v[i] < zero ? -pair.half.v[i] : pair.half.v[i]);
      box_edge.centre = vector_of(middle);
      const Segment segment = {vector_of(pair.centre), vector_of(pair.direction), pair.half_length};
      Unit on_edge = zero;
      best = {n, -1, zero};
      closest_points(box_edge, segment, on_edge, best.along);
    }
  }
  return best;
}

/// Sets [low, high] to the part of the segment between the sides of the face. Returns false if there is none.
bool clip_to_face(const BoxAndSegment& pair, int face, Unit& low, Unit& high) {
  low = -pair.half_length;
  high = pair.half_length;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == face) continue;
    const Unit speed = abs(pair.direction.v[axis]);
    const Unit centre = pair.direction.v[axis] < Unit(0.0) ? -pair.centre.v[axis] : pair.centre.v[axis];
    const Unit until = pair.half.v[axis] - centre;
    const Unit since = -pair.half.v[axis] - centre;
    if (until < low * speed || since > high * speed) return false;
    if (until < high * speed) high = divide(until, speed);
    if (since > low * speed) low = divide(since, speed);
  }
  return low <= high;
}

/// Returns the axis of the box to which the normal is perpendicular (the axis of the touched edge), or -1 if there is
/// none.
int edge_of(const BoxContact& contact) {
  int edge = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (abs(contact.normal.v[axis]) < Unit(0x1p-12)) edge = axis;
  }
  return edge;
}

/// Whether the segment is within 2^-5 rad of the direction of the edge. The limit for two edges of hulls is the same
/// (k_level in contact_points.cpp).
bool is_along(const BoxAndSegment& pair, int edge) { return abs(pair.direction.v[edge]) > Unit(1.0 - 0x1p-11); }

/// Whether the normal of a contact at an edge rotates as the shapes slide past each other. It does not rotate if the
/// segment crosses the edge at a point between the segment's ends.
__attribute__((noinline)) bool turns_at_edge(const BoxAndSegment& pair, const BoxContact& contact) {
  if (contact.along >= pair.half_length || contact.along <= -pair.half_length) return true;
  const int edge = edge_of(contact);
  return edge < 0 || is_along(pair, edge);
}

/// Sets [low, high] to the part of the segment that is at most thickness / 32 beside the touched edge. Returns false if
/// there is none, or if the segment does not lie along the edge.
__attribute__((noinline)) bool clip_to_edge(const BoxAndSegment& pair, const BoxContact& contact, Unit thickness,
                                            Unit& low, Unit& high) {
  const int edge = pair.half_length > Unit(0.0) ? edge_of(contact) : -1;
  if (edge < 0 || !is_along(pair, edge)) return false;
  const bool backwards = pair.direction.v[edge] < Unit(0.0);
  const Unit speed = abs(pair.direction.v[edge]);
  const Unit centre = backwards ? -pair.centre.v[edge] : pair.centre.v[edge];
  const Unit limit = pair.half_length;
  low = divide_clamped(-pair.half.v[edge] - centre, speed, limit);
  high = divide_clamped(pair.half.v[edge] - centre, speed, limit);
  const int u = next_of_three(edge), v = previous_of_three(edge);
  const Unit rate = contact.normal.v[u] * pair.direction.v[v] - contact.normal.v[v] * pair.direction.v[u];
  stay_beside(rate, scale_by_power(thickness, -5), contact.along, low, high);
  return low < high;
}

/// Applies the test of find_level_face() (contact_seam.h) to a contact at an edge of the box. If the test succeeds,
/// moves the contact to the face whose normal is nearest, and returns true.
__attribute__((noinline)) bool find_level_box_face(const BoxAndSegment& pair, Unit radius, Unit sunk,
                                                   BoxContact& contact) {
  for (int axis = 0; axis < 3; ++axis) {
    if (abs(contact.normal.v[axis]) < k_alike_cosine) continue;
    Unit apart = -radius, level = abs(pair.at(axis, contact.along)) - pair.half.v[axis] - radius;
    for (int i = 0; i < 3; ++i) apart += (abs(pair.at(i, contact.along)) - pair.half.v[i]) * abs(contact.normal.v[i]);
    if (abs(apart) > sunk || abs(level) > sunk) return false;
    contact.set_face(axis);
    return true;
  }
  return false;
}

/// Handles a capsule that crosses an edge of the box. If the normal of a face is within 2^-3 rad of the contact normal,
/// and a part of the capsule's segment lies over this face, the contact is moved to the face. Without this, the capsule
/// could touch at one end in one tick and at the other end in the next tick. Returns false if there is no such face.
__attribute__((noinline)) bool find_leaning_box_face(const BoxAndSegment& pair, BoxContact& contact) {
  constexpr Unit k_leaning_cosine = 1.0 - 0x1p-7;  // 2^-3 rad, as for faces of hulls
  for (int axis = 0; axis < 3; ++axis) {
    if (abs(contact.normal.v[axis]) < k_leaning_cosine) continue;
    Unit low, high;
    if (!clip_to_face(pair, axis, low, high) || !(low < high)) return false;
    contact.set_face(axis);
    return true;
  }
  return false;
}

}  // namespace

void collide_box_round(const PairFrame& frame, PairManifold& manifold) {
  const Unit zero = 0.0;
  const Matrix3& rotation = frame.a.rotation;
  const Unit radius = frame.b.size.x;
  BoxAndSegment pair;
  pair.half = axes_of(frame.a.size);
  pair.centre = axes_of(multiply_transposed(rotation, frame.b.centre));
  pair.direction = axes_of(multiply_transposed(rotation, frame.b.rotation.column[1]));
  pair.half_length = frame.b.type == ShapeType::capsule ? frame.b.size.y : zero;

  const Unit along = pair.half_length == zero ? zero : closest_along(pair);
  const Axes excess = pair.excess(along);
  Vec3<Unit> normal;
  Unit distance = zero;
  BoxContact contact;
  if (normalise(vector_of(excess), normal, distance) && distance > k_meeting) {
    if (distance - radius > frame.margin) return;
    contact = {axes_of(normal), -1, along};
    const Unit aside = scale_by_power(distance, k_upright_power);
    for (int axis = 0; axis < 3; ++axis) {
      if (abs(excess.v[next_of_three(axis)]) > aside || abs(excess.v[previous_of_three(axis)]) > aside) continue;
      contact.set_face(axis);
    }
  } else {
    contact = least_overlap(pair);
  }
  const Unit thickness = min(radius, min(pair.half.v[0], min(pair.half.v[1], pair.half.v[2])));
  if (contact.face < 0) {
    const Unit sunk = min(frame.sunk, scale_by_power(thickness, -5));  // small shapes penetrate less
    manifold.seam = frame.smooth_seams && find_level_box_face(pair, radius, sunk, contact);
    manifold.turns = !manifold.seam && turns_at_edge(pair, contact);
    if (!manifold.seam && !manifold.turns) find_leaning_box_face(pair, contact);
  }
  manifold.normal = multiply(rotation, vector_of(contact.normal));

  const auto add = [&](Unit at, Unit terrain, uint32_t feature) {
    Axes point;
    for (int i = 0; i < 3; ++i) point.v[i] = pair.at(i, at);
    const Unit separation = dot(vector_of(point), vector_of(contact.normal)) - terrain - radius;
    if (separation > frame.margin) return;
    const Unit inward = radius + scale_by_power(separation, -1);
    manifold.add({multiply(rotation, vector_of(point) - vector_of(contact.normal) * inward), separation, feature});
  };
  if (contact.face >= 0) {
    const int face = contact.face;
    const uint32_t base = 1 + 4 * static_cast<uint32_t>(2 * face + (contact.normal.v[face] < zero ? 1 : 0));
    const Unit terrain = pair.half.v[face];
    Unit low = zero, high = zero;
    if (pair.half_length > zero && clip_to_face(pair, face, low, high) && low < high) {
      add(low, terrain, base);
      add(high, terrain, base + 1);
    } else {
      add(along, terrain, base + 2);
    }
    return;
  }
  Unit terrain = zero;
  for (int i = 0; i < 3; ++i) terrain += pair.half.v[i] * abs(contact.normal.v[i]);
  Unit low = zero, high = zero;
  if (clip_to_edge(pair, contact, thickness, low, high)) {
    add(low, terrain, 65);
    add(high, terrain, 66);
  } else {
    add(contact.along, terrain, 64);
  }
}

const PairOps k_box_round_pair_ops = {collide_box_round};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
