#include "contact/compound_ops.h"

#include "contact/body_convex.h"
#include "contact/collide_convex.h"
#include "contact/part_culling.h"
#include "contact/terrain_manifolds.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Sets the core of a child that is a ball or a capsule to a degenerate triangle: all three corners coincide for a
/// ball, and two for a capsule. Unlike a sphere or capsule, a triangle need not be centred at the body's centre.
void set_round_core(const CompoundChild& child, int32_t exponent, Convex& convex) {
  const Vec32 ends[2] = {child.low, child.high};
  int64_t bound = 0;
  for (const Vec32& end : ends) {
    const int64_t far = length_bound({end.x, end.y, end.z});
    bound = far > bound ? far : bound;
  }
  ++bound;
  int lift = 30 - bit_length_64(static_cast<uint64_t>(bound));
  if (lift > exponent - k_size_exponent_min) lift = exponent - k_size_exponent_min;
  const auto shifted = [lift](int64_t value) {
    return static_cast<int32_t>(lift < 0 ? (value >> -lift) + 1 : value * (int64_t{1} << lift));
  };
  convex.type = ShapeType::triangle;
  convex.exponent = exponent - lift;
  convex.core_radius = shifted(bound);
  for (int k = 0; k < 3; ++k) {
    const Vec32& end = ends[k == 0 ? 0 : 1];
    convex.corner[k][0] = shifted(end.x);
    convex.corner[k][1] = shifted(end.y);
    convex.corner[k][2] = shifted(end.z);
  }
}

void set_hull_core(const uint8_t* bytes, const CompoundChild& child, int32_t exponent, Convex& convex) {
  convex.type = ShapeType::hull;
  convex.hull = bytes;
  convex.exponent = cooked_i32(bytes + k_hull_exponent_at);
  convex.core_radius = cooked_i32(bytes + k_hull_core_radius_at);
  convex.vertex_count = cooked_u32(bytes + k_hull_vertex_count_at);
  const int64_t thickness = int64_t{child.half_thickness - child.radius} << (exponent - convex.exponent);
  convex.size[0] = static_cast<int32_t>(thickness < INT32_MAX ? thickness : INT32_MAX);
}

int64_t raw_size(Unit value, int32_t exponent) {
  Vec64 raw = {0, 0, 0};
  return raw_from_real({real_from_unit(value, exponent), Real(0.0), Real(0.0)}, raw) ? raw.x : 0;
}

/// Returns a hash of `name` (the key of a feature or a contact) and of `part` (the part or pair of parts to which it
/// belongs). The result is never 0.
uint32_t name_of_part(uint32_t part, uint32_t name) {
  uint32_t mixed = (name ^ part * 0x9e3779b1u) * 0x85ebca77u;
  mixed ^= mixed >> 15;
  return mixed == 0 ? 1 : mixed;
}

Vec64 raw_offset(const Vec3<Unit>& arm, int32_t exponent, bool& known) {
  Vec64 raw = {0, 0, 0};
  known = raw_from_real(real_from_unit(arm, exponent), raw) && known;
  return raw;
}

/// Returns the least half thickness of all children of the two bodies, 2^-46 m. A body that is not a compound has no
/// children.
int64_t half_thickness_of(const BodyProperties& a, const BodyProperties& b) {
  const auto own = [](const BodyProperties& properties) {
    return is_compound(properties) ? raw_size(properties.rounding, properties.size_exponent) : INT64_MAX;
  };
  const int64_t of_a = own(a), of_b = own(b);
  return of_a < of_b ? of_a : of_b;
}

constexpr int k_same_power = 5;  ///< contact normals of parts at most 2^-5 rad apart count as one normal

/// Collects the contacts of pairs of parts. Contact points in one plane form one contact, whichever parts they belong
/// to.
class PartContacts {
 public:
  PartContacts(const CollisionBody& a, const CollisionBody& b)
      : swapped_(is_half_space(b.properties)),
        ground_(swapped_ ? b : a),
        body_(swapped_ ? a : b),
        found_(half_thickness_of(a.properties, b.properties), k_same_power) {}

  /// Adds the contact of one pair of parts. `part`: as ContactGeometryPoint::part. `contact.key` must be distinct among
  /// the contacts of the same `part`.
  void add(const TerrainContact& contact, uint32_t part) {
    ContactGeometry geometry = contact.geometry;
    if (geometry.count == 0) return;
    if (swapped_) swap_bodies(geometry);
    bool known = true;
    TerrainTouch touch = {};
    touch.triangle = contact.triangle;
    touch.material = contact.material;
    touch.part = part;
    touch.on_face = true;
    touch.manifold.turns = geometry.turns;
    touch.manifold.normal = round_shift(raw_offset(geometry.normal, 0, known), k_metre_bits - 30);
    touch.manifold.count = geometry.count;
    for (uint32_t i = 0; i < geometry.count; ++i) {
      const ContactGeometryPoint& point = geometry.point[i];
      Vec64 separation = {0, 0, 0};
      known = raw_from_real({point.separation, Real(0.0), Real(0.0)}, separation) && known;
      touch.manifold.point[i] = {{0, 0, 0},
                                 raw_offset(point.arm_b, body_.properties.size_exponent, known),
                                 separation.x,
                                 name_of_part(part ^ contact.key, point.feature)};
    }
    touch.deepest = least_separation(touch.manifold);
    touch.manifold.capped = !known;
    found_.add(touch);
  }

  void finish(TerrainContacts& contacts) {
    constexpr Matrix32 k_world = {{{k_one, 0, 0}, {0, k_one, 0}, {0, 0, k_one}}};
    contacts.count = found_.finish();
    contacts.dropped += found_.dropped();
    contacts.capped = contacts.capped || found_.capped();
    for (uint32_t i = 0; i < contacts.count; ++i)
      put_contact(found_.manifold(i), k_world, ground_, body_, contacts.contact[i]);
    for (uint32_t i = 0; swapped_ && i < contacts.count; ++i) swap_bodies(contacts.contact[i].geometry);
  }

 private:
  bool swapped_;
  const CollisionBody &ground_, &body_;
  TerrainManifolds found_;
};

void collide_with_terrain(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                          const AssetTable& assets, const FeatureTable& features, TerrainContacts& contacts) {
  PartContacts collected(a, b);
  const ConvexParts parts((is_terrain(a.properties) ? b : a).properties, assets);
  for (uint32_t i = 0; i < parts.count(); ++i) {
    Convex convex;
    Vec64 middle, half;
    parts.place(i, middle, half);
    if (!parts.convex(i, false, convex)) {
      contacts.capped = true;
      return;
    }
    TerrainContacts found;
    features.terrain->collide_part(a, b, convex, middle, margin, assets, found);
    contacts.capped = contacts.capped || found.capped;
    contacts.seam = contacts.seam || found.seam;
    contacts.dropped += found.dropped;
    for (uint32_t k = 0; k < found.count; ++k)
      collected.add(found.contact[k], is_terrain(a.properties) ? parts.name(i) : parts.name(i) << 16);
  }
  collected.finish(contacts);
}

}  // namespace

ConvexParts::ConvexParts(const BodyProperties& properties, const AssetTable& assets)
    : properties_(properties), assets_(assets), count_(1) {
  if (!is_compound(properties)) return;
  count_ = 0;
  if (!is_in(assets, properties.asset)) return;
  compound_ = compound_view(assets.assets[properties.asset].bytes);
  count_ = compound_.child_count;
}

bool ConvexParts::convex(uint32_t i, bool inner, Convex& convex) const {
  if (whole()) return body_convex(properties_, assets_, convex);
  const CompoundChild child = compound_.child(i);
  const int32_t exponent = compound_.exponent();
  Convex made;
  made.radius = child.radius;
  made.radius_exponent = exponent;
  if (child.kind == ChildKind::hull)
    set_hull_core(compound_.bytes + (inner ? child.inner_at : child.hull_at), child, exponent, made);
  else
    set_round_core(child, exponent, made);
  convex = made;
  return true;
}

void ConvexParts::place(uint32_t i, Vec64& middle, Vec64& half) const {
  if (whole()) {
    middle = {0, 0, 0};
    const int64_t ball = raw_size(properties_.bounding_radius, properties_.size_exponent);
    half = {ball, ball, ball};
    return;
  }
  const ChildBox box = child_box(compound_.child(i));
  // The shift from twice a coordinate to 2^-46 m, between 1 and 30.
  const int shift = k_metre_bits - 31 + compound_.exponent();
  const auto raw = [shift](int64_t twice) { return twice * (int64_t{1} << shift); };
  const Vec32 &low = box.low, &high = box.high;
  middle = {raw(int64_t{low.x} + high.x), raw(int64_t{low.y} + high.y), raw(int64_t{low.z} + high.z)};
  half = {raw(int64_t{high.x} - low.x), raw(int64_t{high.y} - low.y), raw(int64_t{high.z} - low.z)};
}

void collide_compound(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                      const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features,
                      TerrainContacts& contacts) {
  contacts.count = contacts.dropped = 0;
  contacts.seam = contacts.capped = false;
  if (is_terrain(a.properties) || is_terrain(b.properties)) {
    collide_with_terrain(a, b, margin, assets, features, contacts);
    return;
  }
  const ConvexParts parts_a(a.properties, assets), parts_b(b.properties, assets);
  contacts.capped = parts_a.count() == 0 || parts_b.count() == 0;
  const PartCulling culling(a.properties, {a.pose.position, a.pose.rotation}, b.properties,
                            {b.pose.position, b.pose.rotation}, margin.distance, {Real(0.0), Real(0.0), Real(0.0)});
  PartContacts collected(a, b);
  for (uint32_t j = 0; j < parts_b.count(); ++j) {
    Convex convex_b;
    Vec64 middle_b, half_b;
    parts_b.place(j, middle_b, half_b);
    culling.bring(middle_b, half_b);
    const bool known = parts_b.convex(j, false, convex_b);
    contacts.capped = contacts.capped || !known;
    for (uint32_t i = 0; known && i < parts_a.count(); ++i) {
      Vec64 middle_a, half_a;
      parts_a.place(i, middle_a, half_a);
      if (!culling.meet(middle_a, half_a, middle_b, half_b)) continue;
      Convex convex_a;
      TerrainContact contact = {};
      if (parts_a.convex(i, false, convex_a))
        collide_convexes(a, convex_a, b, convex_b, margin, reduction, contact.geometry);
      else
        contact.geometry.capped = true;
      contacts.capped = contacts.capped || contact.geometry.capped;
      contacts.seam = contacts.seam || contact.geometry.seam;
      collected.add(contact, parts_a.name(i) << 16 | parts_b.name(j));
    }
  }
  collected.finish(contacts);
}

const CompoundOps k_compound_ops = {read_compound, collide_compound};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
