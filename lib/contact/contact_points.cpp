#include "contact/contact_points.h"

#include "contact/contact_axis.h"
#include "contact/contact_clip.h"
#include "contact/contact_seam.h"
#include "distance/pair.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The contact is made on a face, not on edges or on the contact axis itself, if the face separates the cores nearly as
/// well as the axis does: the separation along the face's normal is smaller than that along the axis by at most 1/64 of
/// the half thickness of the thinner core.
constexpr int k_face_power = 6;
constexpr int k_aside_power = 5;            ///< lateral limit for two edges: 2^-5 of the thinner shape's half thickness
constexpr int64_t k_upright = k_one >> 13;  ///< rad, Q30; the normal of a face replaces an axis this close to it
constexpr int64_t k_level = k_one >> 5;     ///< rad, Q30; edges closer to parallel than this touch along a line

/// Returns the smaller of two lengths. If one length is 0, returns the other length.
int64_t smaller_but_0(int64_t a, int64_t b) { return a == 0 ? b : b == 0 || a < b ? a : b; }
int32_t radius_in_block(const Placed& placed) { return in_block(placed, placed.convex->core_radius); }

/// Whether |a x b| <= limit, for unit vectors a and b. All Q30.
bool is_parallel(const Vec32& a, const Vec32& b, int64_t limit) {
  const Vec32 sine = round_shift(cross(a, b), 30);
  return dot(sine, sine) <= limit * limit;
}

/// Returns a + b, saturated at +-INT64_MAX. Both may have any sign.
int64_t saturated(int64_t a, int64_t b) { return b < 0 ? -saturated_sum(-a, -b) : saturated_sum(a, b); }

/// Returns the index of the chosen point that is nearest to `place` in the reference plane.
int nearest_to(const AreaPoint& place, const AreaChoice& choice) {
  int nearest = 0;
  for (int i = 1; i < choice.count(); ++i)
    nearest = distance(choice[i], place) < distance(choice[nearest], place) ? i : nearest;
  return nearest;
}

/// One of the two shapes, and the direction to the other. Several functions need the face and the edge along `outward`.
/// The name and normal of the face and the name of the edge are therefore stored when they are first found.
struct Half {
  const Placed& placed;
  Vec32 centre;                    ///< from A's centre, ulps of the pair's block
  Vec32 outward;                   ///< the contact axis, towards the other shape, Q30
  int32_t thickness;               ///< core_half_thickness()
  mutable uint32_t face_name = 0;  ///< 0: not yet searched for; k_no_face: there is none
  mutable Vec32 face_normal = {0, 0, 0};
  mutable uint32_t edge_name = 0;  ///< 0: not yet searched for

  static constexpr uint32_t k_no_face = 1;

  /// Sets `face` to supporting_face() along `outward`, and stores its name and normal. Returns false if there is no
  /// face.
  bool find_face(Feature& face) const {
    const bool found = supporting_face(placed, outward, thickness, face);
    face_name = found ? face.name() : k_no_face;
    if (found) face_normal = face.normal;
    return found;
  }
  /// Sets `edge` to supporting_edge() along `outward`, with a slope of at most k_level, and stores its name.
  void find_edge(Feature& edge) const {
    supporting_edge(placed, outward, k_level, edge);
    edge_name = edge.name();
  }
};

/// Returns core_half_thickness() of B, given that of A. For a hull the computation is a loop over the faces. If A and B
/// have the same hull, the result is therefore taken from A.
int32_t thickness_of_b([[maybe_unused]] const RestingPair& pair, [[maybe_unused]] int32_t of_a) {
#if !defined(__OPTIMIZE_SIZE__)
  const uint8_t* hull = pair.a.hull.bytes;
  if (hull != nullptr && hull == pair.b.hull.bytes && pair.a.convex->size[0] == pair.b.convex->size[0]) return of_a;
#endif
  return core_half_thickness(pair.b);
}

/// Builds the manifold of two cores from their contact axis.
class Builder {
 public:
  Builder(const RestingPair& pair, const ContactAxis& axis, const ContactRules& rules)
      : pair_(pair),
        axis_(axis),
        rules_(rules),
        half_a_{pair.a, {0, 0, 0}, axis.normal, core_half_thickness(pair.a)},
        half_b_{pair.b, pair.offset, negate(axis.normal), thickness_of_b(pair, half_a_.thickness)} {
    preference_ =
        smaller_but_0(in_block(pair.a, half_a_.thickness), in_block(pair.b, half_b_.thickness)) >> k_face_power;
    drop_ = smaller_but_0(radius_in_block(pair.a), radius_in_block(pair.b)) >> k_drop_power;
  }

  void build(BlockManifold& manifold) const;
  /// Finds the contact of A's face with the part of B that lies over this face.
  void build_over_face(const Feature& face, BlockManifold& manifold);

 private:
  bool parts_as_well(const Half& half, const Half& other, const Vec32& normal) const;
  bool find_face(const Half& half, const Half& other, Feature& face) const;
  static uint32_t name_on_axis(const Half& half);
  bool build_on_half_space(BlockManifold& manifold) const;
  bool build_on_face(BlockManifold& manifold) const;
  bool build_on_leaning_face(BlockManifold& manifold) const;
  bool build_on_edge(BlockManifold& manifold) const;
  bool build_level_with_face(BlockManifold& manifold) const;
  void add_on_axis(const Vec32& normal, int64_t separation, BlockManifold& manifold) const;
  /// Half thickness of the thinner shape, 2^-46 m.
  int64_t thickness() const {
    const auto of = [&](const Half& half, int64_t radius) {
      const bool is_line = half.placed.convex->type == ShapeType::capsule;
      return (is_line ? 0 : pair_.metres(in_block(half.placed, half.thickness))) + radius;
    };
    const int64_t a = of(half_a_, pair_.radius_a), b = of(half_b_, pair_.radius_b);
    return a < b ? a : b;
  }
  bool fill(const Reference& reference, bool reference_is_a, const Feature& incident, BlockManifold& manifold) const;
  void add_point(const Vec32& normal, const Vec64& twice_middle, int64_t separation, uint32_t on_a, uint32_t on_b,
                 BlockManifold& manifold) const;
  /// Whether A's feature, not B's, is tried first as the reference. The preferred shape is the one that lies lower
  /// along a fixed direction, which is unlikely to be parallel to an axis of a shape. So the choice does not depend on
  /// which shape is called A.
  bool a_comes_first() const { return dot(axis_.normal, Vec32{493921240, 848256040, 440234144}) > 0; }
  static void find_incident(const Half& half, const Vec32& towards, Feature& incident) {
    if (!supporting_face(half.placed, towards, half.thickness, incident))
      supporting_edge(half.placed, towards, k_one, incident);
  }

  const RestingPair& pair_;
  const ContactAxis& axis_;
  const ContactRules& rules_;
  Half half_a_, half_b_;
  int64_t preference_, drop_;
  bool only_over_ = false;  ///< the contact point on the contact axis is left out if it is not over the reference
};

/// Whether `normal` (outward from `half`) separates the cores about as well as the contact axis: the separation along
/// `normal` is smaller by at most preference_.
bool Builder::parts_as_well(const Half& half, const Half& other, const Vec32& normal) const {
  const Vec32 top = add(half.centre, support(half.placed, normal).point);
  const Vec32 bottom = add(other.centre, support(other.placed, negate(normal)).point);
  return dot(normal, subtract(bottom, top)) >> 30 >= axis_.separation - preference_;
}

/// Sets `face` to the face of `half` on which the contact lies. Returns false if the contact lies on no face of `half`.
bool Builder::find_face(const Half& half, const Half& other, Feature& face) const {
  if (!half.find_face(face)) return false;
  const Vec32& normal = face.normal;
  if (dot(normal, half.outward) <= 0) return false;
  if (!is_parallel(normal, half.outward, k_upright)) {
    if (axis_.separation > preference_) return false;
    if (!parts_as_well(half, other, normal)) return false;
  }
  return true;
}

/// Adds a contact point. `normal`: from A to B. `twice_middle`: twice the midpoint between the cores, in ulps from A's
/// centre. `on_a` and `on_b`: names of the touching features.
void Builder::add_point(const Vec32& normal, const Vec64& twice_middle, int64_t separation, uint32_t on_a,
                        uint32_t on_b, BlockManifold& manifold) const {
  const int64_t ahead = (pair_.radius_a - pair_.radius_b) / 2;
  const auto component = [&](int64_t twice, int32_t n) {
    return pair_.metres(twice) / 2 + Int128::product_narrow(ahead, n).round_shift(30);
  };
  const Vec64& m = twice_middle;
  const Vec32& o = pair_.offset;
  Vec64 from_a = {component(m.x, normal.x), component(m.y, normal.y), component(m.z, normal.z)};
  Vec64 from_b = {component(m.x - 2 * int64_t{o.x}, normal.x), component(m.y - 2 * int64_t{o.y}, normal.y),
                  component(m.z - 2 * int64_t{o.z}, normal.z)};
  // A half-space's position may be too far away for 32-bit coordinates in ulps. The vector from this position to the
  // point is therefore computed from the other body's vector and the offset of the positions, in 2^-46 m.
  const Vec64& shift = pair_.offset_metres;
  if (pair_.a.convex->type == ShapeType::half_space)
    from_a = {saturated(from_b.x, shift.x), saturated(from_b.y, shift.y), saturated(from_b.z, shift.z)};
  else if (pair_.b.convex->type == ShapeType::half_space)
    from_b = {saturated(from_a.x, -shift.x), saturated(from_a.y, -shift.y), saturated(from_a.z, -shift.z)};
  manifold.point[manifold.count++] = {from_a, from_b, separation, feature_pair(on_a, on_b)};
}

/// Returns the name of the shape's feature where the axis meets the shape. If a face is perpendicular to the axis, the
/// result is the face, because only rounding would decide between its edges.
uint32_t Builder::name_on_axis(const Half& half) {
  Feature feature;
  if (half.face_name == 0) half.find_face(feature);
  if (half.face_name != Half::k_no_face && is_parallel(half.face_normal, half.outward, k_upright))
    return half.face_name;
  if (half.edge_name == 0) half.find_edge(feature);
  return half.edge_name;
}

/// Adds the contact point on the axis itself: midway between axis_.point_a and point_b.
void Builder::add_on_axis(const Vec32& normal, int64_t separation, BlockManifold& manifold) const {
  const uint32_t on_a = name_on_axis(half_a_), on_b = name_on_axis(half_b_);
  const Vec32 &a = axis_.point_a, &b = axis_.point_b, &offset = pair_.offset;
  const auto twice = [](int32_t on_a_core, int32_t on_b_core, int32_t shift) {
    return int64_t{on_a_core} + on_b_core + shift;
  };
  add_point(normal, {twice(a.x, b.x, offset.x), twice(a.y, b.y, offset.y), twice(a.z, b.z, offset.z)}, separation, on_a,
            on_b, manifold);
}

/// Clips `incident` against `reference` and adds the chosen corners of the contact area to the manifold. Returns false
/// if no point is within the contact margin.
bool Builder::fill(const Reference& reference, bool reference_is_a, const Feature& incident,
                   BlockManifold& manifold) const {
  const Half& other = reference_is_a ? half_b_ : half_a_;
  const int64_t radii = pair_.radius_a + pair_.radius_b;
  AreaChoice choice(pair_.block_above(saturated_sum(rules_.margin, radii)), drop_, rules_.reduction);
  do reference.clip(other.centre, incident, choice);
  while (choice.again());
  const Vec32 normal = reference_is_a ? reference.up() : negate(reference.up());
  if (choice.count() == 0) return false;
  // A round face is represented by an octagon inscribed in its rim (supporting_face()), so the contact point on the
  // axis can lie outside the polygon. That point is added if it is deeper than all chosen points by more than drop_. If
  // four points are chosen, it replaces the one nearest to it. With only_over_, it must lie over the reference face.
  int deepest = 0;
  for (int i = 1; i < choice.count(); ++i) deepest = choice[i].w < choice[deepest].w ? i : deepest;
  const Vec32 nearest = add(other.centre, reference_is_a ? axis_.point_b : axis_.point_a);
  const int64_t height = reference.height_of(nearest);
  const bool missed = height + drop_ < choice[deepest].w && (!only_over_ || reference.holds(nearest));
  const int left_out = missed && choice.count() == 4 ? nearest_to(reference.over(nearest), choice) : -1;
  if (missed) add_on_axis(normal, pair_.metres(height) - radii, manifold);
  for (int i = 0; i < choice.count(); ++i) {
    const AreaPoint& point = choice[i];
    const int64_t separation = pair_.metres(point.w) - radii;
    if (i == left_out || separation > rules_.margin) continue;
    const uint32_t on_reference = reference.name_on_reference(point);
    const uint32_t on_incident = reference.name_on_incident(other.placed, incident, point);
    const uint32_t on_a = reference_is_a ? on_reference : on_incident;
    const uint32_t on_b = reference_is_a ? on_incident : on_reference;
    // The features of a manifold must be distinct. The point on the axis is deeper, so a point with the same features
    // is left out.
    if (!missed || manifold.point[0].feature != feature_pair(on_a, on_b))
      add_point(normal, reference.twice_middle(point), separation, on_a, on_b, manifold);
  }
  if (manifold.count > 0) manifold.normal = normal;
  return manifold.count > 0;
}

bool Builder::build_on_half_space(BlockManifold& manifold) const {
  const bool plane_is_a = pair_.a.convex->type == ShapeType::half_space;
  const Half &plane = plane_is_a ? half_a_ : half_b_, &other = plane_is_a ? half_b_ : half_a_;
  Feature incident;
  find_incident(other, negate(plane.placed.rotation.column[1]), incident);
  return fill(Reference(plane.placed, plane.centre, other.centre), plane_is_a, incident, manifold);
}

bool Builder::build_on_face(BlockManifold& manifold) const {
  Feature face, incident;
  bool is_a = a_comes_first();
  for (int attempt = 0; attempt < 2; ++attempt, is_a = !is_a) {
    const Half &half = is_a ? half_a_ : half_b_, &other = is_a ? half_b_ : half_a_;
    if (!find_face(half, other, face)) continue;
    find_incident(other, negate(face.normal), incident);
    const Reference reference(half.placed, half.centre, face, face.normal, radius_in_block(other.placed));
    if (fill(reference, is_a, incident, manifold)) return true;
  }
  return false;
}

/// Finds the contact on a face that is slightly tilted against the axis. Crossing edges would instead touch in one
/// point, which can jump from one side of the face to the other between two ticks. Returns false unless all of these
/// conditions hold. The cores are at most preference_ apart. The face normal is within 2^-3 rad of the axis. The face
/// has at least two contact points. The separation of the deepest point is larger than that along the axis by at most
/// drop_, or smaller by at most preference_. How deep an edge lies beyond the sides of the face does not matter.
__attribute__((noinline)) bool Builder::build_on_leaning_face(BlockManifold& manifold) const {
  constexpr int64_t k_leaning = (int64_t{1} << 60) - (int64_t{1} << 53);  // 2^-3 rad
  const int64_t radii = pair_.radius_a + pair_.radius_b;
  const int64_t least = pair_.metres(axis_.separation - preference_) - radii;
  const int64_t most = pair_.metres(axis_.separation + drop_) - radii;
  if (axis_.separation > preference_) return false;
  bool is_a = a_comes_first();
  for (int attempt = 0; attempt < 2; ++attempt, is_a = !is_a) {
    const Half &half = is_a ? half_a_ : half_b_, &other = is_a ? half_b_ : half_a_;
    Feature face, incident;
    // build_on_face() has already searched for the face and stored its name and normal.
    if (half.face_name >> 10 != static_cast<uint32_t>(FeatureType::face)) continue;
    if (dot(half.face_normal, half.outward) < k_leaning || !half.find_face(face)) continue;
    find_incident(other, negate(face.normal), incident);
    const Reference reference(half.placed, half.centre, face, face.normal, radius_in_block(other.placed));
    BlockManifold found = {};
    if (!fill(reference, is_a, incident, found) || found.count < 2) continue;
    const int64_t deepest = least_separation(found);
    if (deepest < least || deepest > most) continue;
    found.capped = manifold.capped;
    found.leans = true;
    manifold = found;
    return true;
  }
  return false;
}

bool Builder::build_on_edge(BlockManifold& manifold) const {
  Feature edge_a, edge_b;
  half_a_.find_edge(edge_a);
  half_b_.find_edge(edge_b);
  if (edge_a.count != 2 || edge_b.count != 2) return false;
  const auto direction = [](const Feature& edge) {
    const Vec32 shift = subtract(edge.point[1], edge.point[0]);
    return is_zero(shift) ? shift : unit_vector_raw(scaled_to_30_bits(shift));
  };
  const Vec32 along_a = direction(edge_a), along_b = direction(edge_b);
  if (is_zero(along_a) || is_zero(along_b) || !is_parallel(along_a, along_b, k_level)) return false;
  const bool is_a = a_comes_first();
  const Half &half = is_a ? half_a_ : half_b_, &other = is_a ? half_b_ : half_a_;
  // `aside` allows for two effects. Edges that cross at a small angle are offset sideways away from their crossing. And
  // the normal is not exact enough for long edges to lie exactly over each other.
  const int64_t aside = (pair_.block_above(thickness()) >> k_aside_power) + drop_;
  const Reference reference(half.placed, half.centre, is_a ? edge_a : edge_b, half.outward,
                            radius_in_block(other.placed), aside);
  return fill(reference, is_a, is_a ? edge_b : edge_a, manifold);
}

/// If find_level_face() (contact_seam.h) finds a face that is level with the contact of a round shape, adds the contact
/// point with the normal of this face, and returns true. Otherwise returns false.
bool Builder::build_level_with_face(BlockManifold& manifold) const {
  ContactAxis level = axis_;
  const int64_t room = thickness() >> 5;  // small shapes penetrate less
  if (!find_level_face(pair_, room < rules_.sunk ? room : rules_.sunk, level)) return false;
  const int64_t separation = pair_.metres(level.separation) - pair_.radius_a - pair_.radius_b;
  Builder(pair_, level, rules_).add_on_axis(level.normal, separation, manifold);
  manifold.normal = level.normal;
  manifold.seam = true;
  return true;
}

void Builder::build(BlockManifold& manifold) const {
  const int64_t separation = pair_.metres(axis_.separation) - pair_.radius_a - pair_.radius_b;
  if (separation > rules_.margin) return;
  if (rules_.smooth_seams) {
    const int64_t thin_a = in_block(pair_.a, half_a_.thickness), thin_b = in_block(pair_.b, half_b_.thickness);
    if (is_sliver(pair_, axis_, sliver_room(pair_.metres(thin_a < thin_b ? thin_a : thin_b), rules_.sunk))) {
      manifold.seam = true;
      return;
    }
  }
  manifold.capped = axis_.capped;
  if (pair_.planar() ? build_on_half_space(manifold) : build_on_face(manifold)) return;
  if (rules_.smooth_seams && build_level_with_face(manifold)) return;
  if (!pair_.planar()) {
    manifold.turns = build_on_edge(manifold);
    if (manifold.turns || (rules_.leans && build_on_leaning_face(manifold))) return;
  }
  add_on_axis(axis_.normal, separation, manifold);
  manifold.normal = axis_.normal;
  // If two edges cross, the normal of the contact does not rotate.
  const uint32_t feature = manifold.point[0].feature;
  constexpr uint32_t k_edge = static_cast<uint32_t>(FeatureType::edge);
  manifold.turns = !pair_.planar() && ((feature >> 10 & 3) != k_edge || (feature >> 22 & 3) != k_edge);
}

void Builder::build_over_face(const Feature& face, BlockManifold& manifold) {
  only_over_ = true;
  Feature incident;
  find_incident(half_b_, negate(face.normal), incident);
  // The slack at the sides is proportional to the shape's radius, including the ball that rounds it. Otherwise a
  // sphere, whose core is a point, would have no slack and might fall between two faces.
  const int64_t size = int64_t{radius_in_block(pair_.b)} + pair_.block_above(pair_.radius_b);
  const int32_t held = size > k_one ? k_one : static_cast<int32_t>(size);
  fill(Reference(pair_.a, half_a_.centre, face, face.normal, held), true, incident, manifold);
}

}  // namespace

__attribute__((noinline)) uint32_t deepest_point(const BlockManifold& manifold) {
  uint32_t deepest = 0;
  for (uint32_t i = 1; i < manifold.count; ++i)
    deepest = manifold.point[i].separation < manifold.point[deepest].separation ? i : deepest;
  return deepest;
}

__attribute__((noinline)) int64_t least_separation(const BlockManifold& manifold) {
  return manifold.count == 0 ? INT64_MAX : manifold.point[deepest_point(manifold)].separation;
}

__attribute__((noinline)) void find_contact_points(const RestingPair& pair, const ContactRules& rules,
                                                   DistanceCache* cache, BlockManifold& manifold) {
  manifold = {};
  const int32_t needed = pair.block_above(saturated_sum(rules.margin, pair.radius_a + pair.radius_b));
  ContactAxis axis;
  if (find_contact_axis(pair, needed >= INT32_MAX - k_gjk_slack ? INT32_MAX : needed + k_gjk_slack, cache, axis))
    Builder(pair, axis, rules).build(manifold);
}

__attribute__((noinline)) void contact_points_over_face(const RestingPair& pair, const Feature& face, int64_t margin,
                                                        ManifoldReduction reduction, BlockManifold& manifold) {
  manifold = {};
  const Vec32 nearest = support(pair.b, negate(face.normal)).point;
  const int64_t height = dot(face.normal, subtract(add(pair.offset, nearest), face.point[0])) >> 30;
  const Vec32 foot = subtract(add(pair.offset, nearest), scaled_vector(face.normal, height));
  const ContactAxis axis = {face.normal, height, foot, nearest, false};
  Builder(pair, axis, rules_of(margin, reduction)).build_over_face(face, manifold);
}

__attribute__((noinline)) Status contact_points_by(const ContactRules& rules, const Convex& a, const Pose& pose_a,
                                                   const Convex& b, const Pose& pose_b, DistanceCache* cache,
                                                   ContactManifold& manifold, ContactKind& kind) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  if (rules.margin < 0) return Status::out_of_range;
  BlockManifold found;
  find_contact_points(pair, rules, cache, found);
  ContactManifold made;
  made.count = found.count;
  made.capped = found.capped;
  if (found.count > 0) made.normal = units_from_raw(found.normal);
  const auto real = [](const Vec64& v) {
    return Vec3<Real>{real_from_raw(v.x), real_from_raw(v.y), real_from_raw(v.z)};
  };
  for (uint32_t i = 0; i < found.count; ++i) {
    const BlockPoint& point = found.point[i];
    made.point[i] = {real(point.from_a), real(point.from_b), real_from_raw(point.separation), point.feature};
  }
  manifold = made;
  kind = {found.seam, found.turns};
  return Status::ok;
}

Status contact_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real margin,
                      ContactManifold& manifold, DistanceCache* cache, ManifoldReduction reduction) {
  Vec64 raw;
  ContactKind kind;
  const bool known = raw_from_real({margin, Real(0.0), Real(0.0)}, raw);
  return contact_points_by(rules_of(known ? raw.x : -1, reduction), a, pose_a, b, pose_b, cache, manifold, kind);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
