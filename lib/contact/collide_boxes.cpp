#include "base/cycle.h"
#include "contact/collide_shapes.h"
#include "contact/contact_clip.h"
#include "contact/segments.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Unit k_edge_sine_min = 0x1p-5;  // two edges closer to parallel than 1.8 degrees give no separating axis

struct HalfExtents {
  Unit v[3];
};

/// Input of the separating axis test: the half extents, the components of the vector from A's centre to B's along the
/// six face axes, and the cosines between the axes of A and B.
struct AxisTable {
  HalfExtents half_a, half_b;
  Unit offset_a[3], offset_b[3];
  Unit cosine[3][3];  ///< dot product of A's axis i and B's axis j
};

enum class AxisKind { face_a, face_b, edges };

struct SeparatingAxis {
  AxisKind kind;
  int i, j;
  Unit separation;
};

HalfExtents half_of(const Vec3<Unit>& size) { return {{size.x, size.y, size.z}}; }

AxisTable table_of(const PairFrame& frame) {
  AxisTable table;
  table.half_a = half_of(frame.a.size);
  table.half_b = half_of(frame.b.size);
  for (int i = 0; i < 3; ++i) {
    table.offset_a[i] = dot(frame.a.rotation.column[i], frame.b.centre);
    table.offset_b[i] = dot(frame.b.rotation.column[i], frame.b.centre);
    for (int j = 0; j < 3; ++j) table.cosine[i][j] = dot(frame.a.rotation.column[i], frame.b.rotation.column[j]);
  }
  return table;
}

Unit face_a_separation(const AxisTable& t, int i) {
  Unit support = t.half_a.v[i];
  for (int j = 0; j < 3; ++j) support += t.half_b.v[j] * abs(t.cosine[i][j]);
  return abs(t.offset_a[i]) - support;
}

Unit face_b_separation(const AxisTable& t, int j) {
  Unit support = t.half_b.v[j];
  for (int i = 0; i < 3; ++i) support += t.half_a.v[i] * abs(t.cosine[i][j]);
  return abs(t.offset_b[j]) - support;
}

Unit sine_of(const AxisTable& t, int i, int j) {
  return square_root(max(Unit(1.0) - t.cosine[i][j] * t.cosine[i][j], Unit(0.0)));
}

/// Sets `separation` to the separation along the cross product of A's axis i and B's axis j. Returns false if these
/// edges are too nearly parallel, or if the overlap is too deep to be the least one.
bool edge_separation(const AxisTable& t, int i, int j, Unit& separation) {
  const Unit sine = sine_of(t, i, j);
  if (sine < k_edge_sine_min) return false;
  const int i1 = next_of_three(i), i2 = previous_of_three(i), j1 = next_of_three(j), j2 = previous_of_three(j);
  const Unit offset = abs(t.offset_a[i2] * t.cosine[i1][j] - t.offset_a[i1] * t.cosine[i2][j]);
  const Unit support_a = t.half_a.v[i1] * abs(t.cosine[i2][j]) + t.half_a.v[i2] * abs(t.cosine[i1][j]);
  const Unit support_b = t.half_b.v[j1] * abs(t.cosine[i][j2]) + t.half_b.v[j2] * abs(t.cosine[i][j1]);
  // If the separation is -1 or less, the quotient could leave Unit's range. Such an overlap is never the least overlap,
  // because both shapes lie in the unit ball.
  const Unit scaled = offset - support_a - support_b;
  if (scaled <= -sine) return false;
  separation = divide(scaled, sine);
  return true;
}

/// Returns the argument `preference` of find_face_axis() and find_axis(): 1/64 of the least half extent of the two
/// boxes.
Unit preference_of(const HalfExtents& a, const HalfExtents& b) {
  Unit smallest = a.v[0];
  for (int i = 0; i < 3; ++i) smallest = min(smallest, min(a.v[i], b.v[i]));
  return scale_by_power(smallest, -6);
}

/// The separations along the face axes of A and of B.
struct FaceAxes {
  Unit a[3], b[3];
};

/// Sets `best` to the face axis of largest separation, and `face` to the separations along all face axes. A face of B
/// replaces a face of A only if its separation is larger by more than `preference` (preference_of()). So the features
/// of a resting pair stay the same. Returns false if a face axis separates the boxes by more than `margin`.
bool find_face_axis(const AxisTable& table, Unit margin, Unit preference, FaceAxes& face, SeparatingAxis& best) {
  best = {AxisKind::face_a, 0, 0, -1.5};
  for (int i = 0; i < 3; ++i) {
    face.a[i] = face_a_separation(table, i);
    if (face.a[i] > margin) return false;
    if (face.a[i] > best.separation) best = {AxisKind::face_a, i, 0, face.a[i]};
  }
  Unit to_beat = best.separation + preference;
  for (int j = 0; j < 3; ++j) {
    face.b[j] = face_b_separation(table, j);
    if (face.b[j] > margin) return false;
    if (face.b[j] > to_beat) {
      best = {AxisKind::face_b, 0, j, face.b[j]};
      to_beat = face.b[j];
    }
  }
  return true;
}

/// Returns the cosine, up to its sign, of the angle between a separating axis and the axis of A's face i. Range: B's
/// face j is nearly parallel to A's face i.
Unit cosine_with(const AxisTable& table, const SeparatingAxis& axis, int i, int j) {
  if (axis.kind == AxisKind::face_a) return axis.i == i ? Unit(1.0) : table.cosine[axis.i][j];
  if (axis.kind == AxisKind::face_b) return axis.j == j ? Unit(1.0) : table.cosine[i][axis.j];
  if (axis.i == i) return 0.0;
  const Unit across = abs(table.cosine[3 - i - axis.i][axis.j]), sine = sine_of(table, axis.i, axis.j);
  return across < sine ? divide(across, sine) : Unit(1.0);
}

/// As is_sliver() (contact_seam.h), for two boxes.
__attribute__((noinline)) bool is_box_sliver(const AxisTable& table, const FaceAxes& face, const SeparatingAxis& axis,
                                             Unit room) {
  constexpr Unit k_level_cosine = 1.0 - 0x1p-9;
  if (axis.separation < -room) return false;
  for (int i = 0; i < 3; ++i) {
    if (abs(face.a[i]) > room) continue;
    for (int j = 0; j < 3; ++j) {
      if (abs(table.cosine[i][j]) > k_level_cosine && abs(cosine_with(table, axis, i, j)) < k_alike_cosine) return true;
    }
  }
  return false;
}

/// As find_face_axis(), but also tests the cross products of edges. A pair of edges replaces a face only if its
/// separation is larger by more than `preference`. Returns false if any axis separates the boxes by more than `margin`.
__attribute__((noinline)) bool find_axis(const AxisTable& table, Unit margin, Unit preference, FaceAxes& face,
                                         SeparatingAxis& best) {
  if (!find_face_axis(table, margin, preference, face, best)) return false;
  Unit to_beat = best.separation + preference;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Unit separation = 0.0;
      if (!edge_separation(table, i, j, separation)) continue;
      if (separation > margin) return false;
      if (separation > to_beat) {
        best = {AxisKind::edges, i, j, separation};
        to_beat = separation;
      }
    }
  }
  return true;
}

/// A vertex of the clipped face, in the reference face's axes: u and v in the plane of the face, w the height above it.
struct FaceVertex {
  Unit u, v, w;
  /// Name of the vertex. 0..3: an incident vertex; 4..19: 4 + 4 (incident edge) + (reference side); 20..23: a corner of
  /// the reference face.
  uint32_t label;
  uint32_t edge_label;  ///< label of the edge to the next vertex; 0..3: incident edge, 4..7: reference side
};

constexpr uint32_t k_face_vertices_max = 8;

uint32_t crossing_label(uint32_t edge_label, uint32_t side) {
  if (edge_label < 4) return 4 + 4 * edge_label + side;
  // The edge is a side of the reference face and meets `side` in a corner. One of the two sides bounds u (0 or 1), the
  // other bounds v (2 or 3).
  const uint32_t other = edge_label - 4;
  const uint32_t u_side = side < 2 ? side : other, v_side = side < 2 ? other : side;
  return 20 + (u_side & 1) + 2 * (v_side & 1);
}

/// Clips the polygon `in` at one side of the reference face. Sets `out` to the result and returns its number of
/// vertices. Vertices up to `slack` beyond the side are kept. An edge whose outer end is not kept is cut at the side
/// itself or, if its inner end is beyond the side too, at `slack` beyond the side. The side is at u = limit for side 0,
/// -u = limit for side 1, v = limit for side 2, -v = limit for side 3.
uint32_t clip_side(const FaceVertex* in, uint32_t count, uint32_t side, Unit limit, Unit slack, FaceVertex* out) {
  const auto beyond = [&](const FaceVertex& p) {
    const Unit across = side < 2 ? p.u : p.v;
    return ((side & 1) != 0 ? -across : across) - limit;
  };
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const FaceVertex& p = in[i];
    const FaceVertex& q = in[i + 1 == count ? 0 : i + 1];
    const Unit p_beyond = beyond(p), q_beyond = beyond(q);
    const bool p_inside = p_beyond <= slack, q_inside = q_beyond <= slack;
    if (p_inside) out[kept++] = p;
    if (p_inside == q_inside) continue;
    const Unit cut = (p_inside ? p_beyond : q_beyond) < Unit(0.0) ? Unit(0.0) : slack;
    const Unit part = divide(p_beyond - cut, p_beyond - q_beyond);
    FaceVertex crossing = {p.u + (q.u - p.u) * part, p.v + (q.v - p.v) * part, p.w + (q.w - p.w) * part, 0, 0};
    crossing.label = crossing_label(p.edge_label, side);
    crossing.edge_label = p_inside ? 4 + side : p.edge_label;
    out[kept++] = crossing;
  }
  return kept;
}

int64_t raw_from(Unit value) {
#if DETENT_FIXED
  return value.raw;
#else
  bool saturated = false;  // never set: |value| < 2
  return integer_from_float(value, 30, saturated);
#endif
}

/// Chooses at most four vertices of the clipped polygon for the contact, and returns their number. `drop`: as in
/// AreaChoice. Sets `chosen` to the indices of these vertices, ascending.
uint32_t choose_corners(const FaceVertex* polygon, uint32_t count, ManifoldReduction reduction, Unit drop,
                        uint32_t chosen[k_manifold_points_max]) {
  if (count <= k_manifold_points_max) {
    for (uint32_t i = 0; i < count; ++i) chosen[i] = i;
    return count;
  }
  AreaChoice choice(INT64_MAX, raw_from(drop), reduction);
  do {
    for (uint32_t i = 0; i < count; ++i) {
      const FaceVertex& p = polygon[i];
      choice.add({raw_from(p.u), raw_from(p.v), raw_from(p.w), AreaPoint::Kind::vertex, static_cast<uint8_t>(i), 0});
    }
  } while (choice.again());
  uint32_t bits = 0, kept = 0;
  for (int i = 0; i < choice.count(); ++i) bits |= 1u << choice[i].incident;
  for (uint32_t i = 0; i < count; ++i) {
    if ((bits >> i & 1) != 0) chosen[kept++] = i;
  }
  return kept;
}

Unit sign_of(Unit value) { return value < Unit(0.0) ? Unit(-1.0) : Unit(1.0); }

/// Finds the contact on a face of the reference box, which is A if `reference_is_a`, else B. The face is perpendicular
/// to axis `face` of this box and lies on the side of the other box.
__attribute__((noinline)) void collide_face(const PairFrame& frame, bool reference_is_a, int face,
                                            PairManifold& manifold) {
  const PairShape &reference = reference_is_a ? frame.a : frame.b, &incident = reference_is_a ? frame.b : frame.a;
  const HalfExtents half = half_of(reference.size), other = half_of(incident.size);
  const Vec3<Unit> between = incident.centre - reference.centre;
  const Vec3<Unit>& axis = reference.rotation.column[face];
  const bool flipped = dot(axis, between) < Unit(0.0);
  const Vec3<Unit> normal = flipped ? -axis : axis;
  const Vec3<Unit>& axis_u = reference.rotation.column[next_of_three(face)];
  const Vec3<Unit>& axis_v = reference.rotation.column[previous_of_three(face)];

  int opposed = 0;
  Unit opposition = -1.0;
  for (int i = 0; i < 3; ++i) {
    const Unit along = abs(dot(normal, incident.rotation.column[i]));
    if (along > opposition) {
      opposition = along;
      opposed = i;
    }
  }
  // A vertex at most `slack` beyond a side of the face is not clipped. Otherwise the contact points of equal boxes that
  // are stacked flush would change their features, and lose their impulses, at the slightest jitter.
  Unit smallest = half.v[0];
  for (int i = 0; i < 3; ++i) smallest = min(smallest, min(half.v[i], other.v[i]));
  const Unit slack = scale_by_power(smallest, -6);
  const Vec3<Unit>& incident_axis = incident.rotation.column[opposed];
  const Unit side = -sign_of(dot(normal, incident_axis));
  const Vec3<Unit> middle = between + incident_axis * (other.v[opposed] * side);
  const Vec3<Unit> first = incident.rotation.column[next_of_three(opposed)] * other.v[next_of_three(opposed)];
  const Vec3<Unit> second = incident.rotation.column[previous_of_three(opposed)] * other.v[previous_of_three(opposed)];
  const Vec3<Unit> corner[4] = {middle + first + second, middle - first + second, middle - first - second,
                                middle + first - second};
  FaceVertex polygon[k_face_vertices_max], clipped[k_face_vertices_max];
  uint32_t count = 0;
  for (Unit moved = 0.0;; moved = slack) {
    for (uint32_t i = 0; i < 4; ++i) {
      polygon[i] = {dot(axis_u, corner[i]), dot(axis_v, corner[i]), dot(normal, corner[i]) - half.v[face], i, i};
    }
    const Unit limit_u = half.v[next_of_three(face)] + moved, limit_v = half.v[previous_of_three(face)] + moved;
    const Unit beyond = slack - moved;
    count = clip_side(polygon, 4, 0, limit_u, beyond, clipped);
    count = clip_side(clipped, count, 1, limit_u, beyond, polygon);
    count = clip_side(polygon, count, 2, limit_v, beyond, clipped);
    count = clip_side(clipped, count, 3, limit_v, beyond, polygon);
    // If nothing is left, the faces may overlap only beyond a corner of the reference face, within the slack. The
    // polygon is then clipped once more, with the sides moved outward by the slack.
    if (count != 0 || beyond == Unit(0.0)) break;
  }

  manifold.normal = reference_is_a ? normal : -normal;
  const uint32_t faces = (reference_is_a ? 0u : 1u) + 2 * (2 * static_cast<uint32_t>(face) + (flipped ? 1u : 0u)) +
                         12 * (2 * static_cast<uint32_t>(opposed) + (side < Unit(0.0) ? 1u : 0u));
  uint32_t near = 0;
  for (uint32_t i = 0; i < count; ++i) {
    if (polygon[i].w <= frame.margin) polygon[near++] = polygon[i];
  }
  uint32_t chosen[k_manifold_points_max];
  const Unit drop = scale_by_power(smallest, -10);
  const uint32_t chosen_count = choose_corners(polygon, near, frame.reduction, drop, chosen);
  for (uint32_t i = 0; i < chosen_count; ++i) {
    const FaceVertex& p = polygon[chosen[i]];
    const Vec3<Unit> local = axis_u * p.u + axis_v * p.v + normal * (half.v[face] + scale_by_power(p.w, -1));
    manifold.add({reference.centre + local, p.w, 1 + 32 * faces + p.label});
  }
}

/// Returns the edge of the box that is parallel to axis `edge` and lies farthest along `direction`. Sets `which` to the
/// number of this edge, 0 to 11.
Segment support_edge(const PairShape& box, int edge, const Vec3<Unit>& direction, uint32_t& which) {
  const HalfExtents half = half_of(box.size);
  Segment segment = {box.centre, box.rotation.column[edge], half.v[edge]};
  which = 4 * static_cast<uint32_t>(edge);
  for (int k = 1; k < 3; ++k) {
    const int axis = k == 1 ? next_of_three(edge) : previous_of_three(edge);
    const Unit sign = sign_of(dot(direction, box.rotation.column[axis]));
    segment.centre = segment.centre + box.rotation.column[axis] * (half.v[axis] * sign);
    if (sign < Unit(0.0)) which += static_cast<uint32_t>(k);
  }
  return segment;
}

/// Replaces the contact of two crossing edges by the contact on the face whose normal is nearest to the edges'
/// `normal`. Crossing edges touch in one point, and this point can jump from one side of the face to the other between
/// two ticks. Returns false, with `manifold` unchanged, in these cases, where p is `preference` and `separation` is
/// that of the edges: no face normal is within 2^-3 rad of `normal`; the edges are more than p apart; the face has
/// fewer than two contact points; the separation of its deepest point is more than p smaller, or more than p / 16
/// larger, than that of the edges. How deep an edge lies beyond the sides of the face does not matter.
__attribute__((noinline)) bool collide_leaning_face(const PairFrame& frame, const Vec3<Unit>& normal, Unit separation,
                                                    Unit preference, PairManifold& manifold) {
  constexpr Unit k_leaning = 1.0 - 0x1p-7;
  Unit most = k_leaning;
  int face = -1;
  for (int i = 0; i < 6; ++i) {
    const Unit along = abs(dot(normal, i < 3 ? frame.a.rotation.column[i] : frame.b.rotation.column[i - 3]));
    if (!(along > most)) continue;
    most = along;
    face = i;
  }
  if (face < 0 || separation > preference) return false;
  PairManifold found;
  collide_face(frame, face < 3, face < 3 ? face : face - 3, found);
  Unit deepest = 1.0;
  for (uint32_t i = 0; i < found.count; ++i) deepest = min(deepest, found.point[i].separation);
  const bool sound = found.count > 1 && !(deepest < separation - preference) &&
                     !(deepest > separation + scale_by_power(preference, -4));
  if (sound) manifold = found;
  return sound;
}

void collide_edges(const PairFrame& frame, const SeparatingAxis& axis, Unit preference, PairManifold& manifold) {
  Unit size = 0.0;
  if (!normalise(cross(frame.a.rotation.column[axis.i], frame.b.rotation.column[axis.j]), manifold.normal, size))
    return;
  if (dot(manifold.normal, frame.b.centre) < Unit(0.0)) manifold.normal = -manifold.normal;
  if (collide_leaning_face(frame, manifold.normal, axis.separation, preference, manifold)) return;
  uint32_t which_a = 0, which_b = 0;
  const Segment edge_a = support_edge(frame.a, axis.i, manifold.normal, which_a);
  const Segment edge_b = support_edge(frame.b, axis.j, -manifold.normal, which_b);
  Unit along_a = 0.0, along_b = 0.0;
  closest_points(edge_a, edge_b, along_a, along_b);
  const Vec3<Unit> on_a = point_at(edge_a, along_a), on_b = point_at(edge_b, along_b);
  const Vec3<Unit> half_gap = {scale_by_power(on_b.x - on_a.x, -1), scale_by_power(on_b.y - on_a.y, -1),
                               scale_by_power(on_b.z - on_a.z, -1)};
  const Unit separation = dot(on_b - on_a, manifold.normal);
  if (separation > frame.margin) return;
  manifold.add({on_a + half_gap, separation, 0x10000 + 16 * which_a + which_b});
}

}  // namespace

void collide_boxes(const PairFrame& frame, PairManifold& manifold) {
  const AxisTable table = table_of(frame);
  const Unit preference = preference_of(table.half_a, table.half_b);
  FaceAxes face;
  SeparatingAxis axis;
  if (!find_axis(table, frame.margin, preference, face, axis)) return;
  const Unit room = max(scale_by_power(preference, 1), min(frame.sunk, scale_by_power(preference, 3)));
  manifold.seam = frame.smooth_seams && is_box_sliver(table, face, axis, room);
  if (manifold.seam) return;
  const bool is_a = axis.kind == AxisKind::face_a;
  if (axis.kind == AxisKind::edges)
    collide_edges(frame, axis, preference, manifold);
  else
    collide_face(frame, is_a, is_a ? axis.i : axis.j, manifold);
  // No axis separates the boxes by more than the margin. Still, the nearest vertices may be farther apart than the
  // margin. So if no point was found, it is not known whether the boxes are within the margin.
  manifold.near = manifold.count == 0;
}

const PairOps k_box_pair_ops = {collide_boxes};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
