#include "contact/terrain_manifolds.h"

#include "contact/contact_arm.h"
#include "contact/contact_clip.h"
#include "math/root.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_plane_power = 4;  ///< planes at most 2^-4 of the half thickness apart count as one plane
/// Two normals count as equal if their dot product (Q28) is at least this: at most 2^-12 rad apart.
constexpr int32_t k_equal_cosine = (1 << 28) - (1 << 3);
/// If there is no room for another manifold, a touch joins a manifold of another plane only if the dot product of their
/// normals (Q28) is above this: less than 2^-1 rad apart.
constexpr int32_t k_near_cosine = (1 << 28) - (1 << 25);
constexpr uint32_t k_edge_key = 0x80000000u;

/// Whether a group (all touches in one plane) with the first two values is kept rather than a group with the other two.
/// A group that is not doubtful (TerrainTouch::doubtful) comes before a doubtful group. Otherwise the deeper group
/// comes first.
bool comes_before(bool doubtful, int64_t deepest, bool other_doubtful, int64_t other_deepest) {
  return doubtful != other_doubtful ? other_doubtful : deepest < other_deepest;
}

int64_t along(const Vec64& v, const Vec32& direction) { return dot(v, direction).round_shift(30); }

/// Returns the name of a normal: its components, coarsely rounded. Similar normals have the same name. The normals that
/// share their name with an axis lie around that axis.
uint32_t normal_name(const Vec32& normal) {
  const auto part = [](int32_t a) { return static_cast<uint32_t>((a + (1 << 24)) >> 25) & 0x7f; };
  return 1u << 29 | part(normal.x) << 22 | part(normal.y) << 15 | part(normal.z) << 8;
}

}  // namespace

TerrainManifolds::Group* TerrainManifolds::group_for(const TerrainTouch& touch, int64_t plane) {
  const Vec32& normal = touch.manifold.normal;
  Group* nearest = nullptr;
  int32_t most = k_near_cosine;
  for (uint32_t i = 0; i < count_; ++i) {
    Group& group = group_[i];
    const int32_t cosine = static_cast<int32_t>(dot(group.normal, normal) >> 32);
    const int64_t apart = plane - group.plane;
    if (cosine >= (touch.on_face == group.on_face ? same_cosine_ : k_equal_cosine) &&
        (apart < 0 ? -apart : apart) <= size_ >> k_plane_power) {
      return &group;
    }
    if (cosine <= most || group.doubtful != touch.doubtful) continue;
    most = cosine;
    nearest = &group;
  }
  Group* fresh = &group_[count_];
  if (count_ == k_terrain_manifolds_max) {
    if (nearest != nullptr) return nearest;
    fresh = &group_[0];
    for (Group& group : group_)
      fresh = comes_before(fresh->doubtful, fresh->deepest, group.doubtful, group.deepest) ? &group : fresh;
    if (!comes_before(touch.doubtful, touch.deepest, fresh->doubtful, fresh->deepest)) {
      ++dropped_;
      return nullptr;
    }
    dropped_ += fresh->touches;
  } else {
    ++count_;
  }
  *fresh = {};
  fresh->normal = normal;
  fresh->u = axis_across(normal);
  fresh->v = round_shift(cross(normal, fresh->u), 30);
  fresh->plane = plane;
  fresh->deepest = INT64_MAX;
  fresh->first = touch.triangle;
  fresh->doubtful = true;
  fresh->on_face = touch.on_face;
  return fresh;
}

void TerrainManifolds::add(const TerrainTouch& touch) {
  const BlockManifold& manifold = touch.manifold;
  capped_ = capped_ || manifold.capped;
  const BlockPoint& point = manifold.point[deepest_point(manifold)];
  const int64_t plane = along(point.from_b, manifold.normal) - point.separation / 2;
  if (Group* group = group_for(touch, plane); group != nullptr) join(touch, plane, *group);
}

void TerrainManifolds::join(const TerrainTouch& touch, int64_t plane, Group& group) {
  if (touch.deepest < group.deepest) {
    group.deepest = touch.deepest;
    group.normal = touch.manifold.normal;
    group.plane = plane;
    group.triangle = touch.triangle;
    group.material = touch.material;
    group.turns = touch.manifold.turns;
  }
  group.first = touch.triangle < group.first ? touch.triangle : group.first;
  group.on_face = group.on_face || touch.on_face;
  group.doubtful = group.doubtful && touch.doubtful;
  ++group.touches;
  for (uint32_t i = 0; i < touch.manifold.count; ++i) {
    const BlockPoint& point = touch.manifold.point[i];
    add_point({point.from_b, point.separation, point.feature, touch.part}, group);
  }
}

void TerrainManifolds::add_point(const TerrainManifold::Point& point, Group& group) const {
  for (uint32_t i = 0; i < group.count; ++i) {
    if (group.point[i].feature != point.feature) continue;
    if (point.separation < group.point[i].separation) group.point[i] = point;
    return;
  }
  if (group.count == k_points_max) {
    const uint32_t spare = spare_point(group);
    for (uint32_t i = spare; i + 1 < group.count; ++i) group.point[i] = group.point[i + 1];
    --group.count;
  }
  group.point[group.count++] = point;
}

uint32_t TerrainManifolds::deepest_of(const Group& group) {
  uint32_t deepest = 0;
  for (uint32_t i = 1; i < group.count; ++i) {
    deepest = group.point[i].separation < group.point[deepest].separation ? i : deepest;
  }
  return deepest;
}

/// Returns the points of a group that AreaChoice chooses with `level` and `drop`, as a set of bits: bit i stands for
/// point i. If `fill` is false, only the extremes are chosen.
uint32_t TerrainManifolds::chosen_of(const Group& group, int64_t level, int64_t drop, bool fill) {
  int64_t u[k_points_max], v[k_points_max];  // coordinates in the plane, from the first point, 2^-46 m
  uint64_t spread = 0;
  for (uint32_t i = 0; i < group.count; ++i) {
    u[i] = along(group.point[i].from_shape, group.u) - (i == 0 ? 0 : u[0]);
    v[i] = along(group.point[i].from_shape, group.v) - (i == 0 ? 0 : v[0]);
    spread |= i == 0 ? 0 : magnitude_64(u[i]) | magnitude_64(v[i]);
  }
  u[0] = v[0] = 0;
  const int bits = bit_length_64(spread), shift = bits > 28 ? bits - 28 : 0;  // makes areas of triangles fit 64 bits
  AreaChoice choice(level, INT64_MAX, drop, ManifoldReduction::projected_extremes);
  do {
    for (uint32_t i = 0; i < group.count; ++i) {
      choice.add({u[i] >> shift, v[i] >> shift, group.point[i].separation, AreaPoint::Kind::vertex,
                  static_cast<uint8_t>(i), 0});
    }
  } while (choice.again() && fill);
  uint32_t chosen = 0;
  for (int i = 0; i < choice.count(); ++i) chosen |= 1u << choice[i].incident;
  return chosen;
}

/// Returns the index of the point that is removed to make room for another point: the highest of those points of the
/// group that are neither an extreme nor the deepest point. A full group has eight points, so at least three of them
/// are neither. Among points of about the same height, the result is the first.
uint32_t TerrainManifolds::spare_point(const Group& group) const {
  const uint32_t needed = chosen_of(group, INT64_MAX, INT64_MAX / 2, false) | 1u << deepest_of(group);
  uint32_t spare = k_points_max;
  int64_t higher = INT64_MIN;
  for (uint32_t i = 0; i < group.count; ++i) {
    const int64_t separation = group.point[i].separation;
    if ((needed >> i & 1) != 0 || separation <= higher) continue;
    spare = i;
    higher = separation + (size_ >> k_drop_power);
  }
  return spare;
}

/// Makes the manifold of a group from up to four of its points. Points about as deep as the deepest are preferred.
TerrainManifold TerrainManifolds::manifold(uint32_t place) const {
  const Group& group = group_[place];
  TerrainManifold manifold;
  uint32_t chosen = ~0u;
  if (group.count > k_contact_points_max) {
    const int64_t deepest = group.point[deepest_of(group)].separation;
    chosen = chosen_of(group, deepest + (size_ >> k_plane_power), size_ >> k_drop_power, true);
  }
  manifold.count = 0;
  for (uint32_t i = 0; i < group.count; ++i) {
    if ((chosen >> i & 1) != 0) manifold.point[manifold.count++] = group.point[i];
  }
  manifold.key = group.key;
  manifold.normal = group.normal;
  manifold.triangle = group.triangle;
  manifold.material = group.material;
  manifold.turns = group.turns;
  return manifold;
}

/// Removes the doubtful groups (TerrainTouch::doubtful), unless all groups are doubtful. A doubtful contact is very
/// deep, and the terrain does not allow its direction of least overlap as the normal.
void TerrainManifolds::leave_out_doubtful() {
  bool certain = false;
  for (uint32_t i = 0; i < count_; ++i) certain = certain || !group_[i].doubtful;
  if (!certain) return;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    if (group_[i].doubtful) continue;
    if (kept != i) group_[kept] = group_[i];
    ++kept;
  }
  count_ = kept;
}

uint32_t TerrainManifolds::finish() {
  leave_out_doubtful();
  for (uint32_t i = 0; i < count_; ++i) {
    group_[i].key = group_[i].on_face ? normal_name(group_[i].normal) : k_edge_key | group_[i].first;
  }
  // Sorts by key. Planes of the same name are sorted by their height.
  for (uint32_t i = 1; i < count_; ++i) {
    for (uint32_t k = i; k > 0; --k) {
      Group &low = group_[k - 1], &high = group_[k];
      if (low.key < high.key || (low.key == high.key && low.plane <= high.plane)) break;
      const Group swapped = low;
      low = high;
      high = swapped;
    }
  }
  for (uint32_t i = 1; i < count_; ++i) {
    if (group_[i].key <= group_[i - 1].key) group_[i].key = group_[i - 1].key + 1;
  }
  return count_;
}

void put_contact(const TerrainManifold& manifold, const Matrix32& rotation, const CollisionBody& ground,
                 const CollisionBody& body, TerrainContact& contact) {
  const bool is_plane = is_half_space(ground.properties);  // the arm of a half-space has no effect
  const Position &from = ground.pose.position, &to = body.pose.position;
  const Vec3<Real> offset = {real_difference(to.x, from.x), real_difference(to.y, from.y),
                             real_difference(to.z, from.z)};
  contact.key = manifold.key;
  contact.triangle = manifold.triangle;
  contact.material = manifold.material;
  contact.geometry = {};
  contact.geometry.turns = manifold.turns;
  contact.geometry.normal = units_from_raw(round_shift(multiply(rotation, manifold.normal), 30));
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const TerrainManifold::Point& point = manifold.point[i];
    const Vec64 arm = rotate(rotation, point.from_shape);
    const Vec3<Real> from_body = {real_from_raw(arm.x), real_from_raw(arm.y), real_from_raw(arm.z)};
    contact.geometry.point[contact.geometry.count++] = {
        is_plane ? Vec3<Unit>{0.0, 0.0, 0.0} : arm_of_offset(offset + from_body, ground.properties.size_exponent),
        arm_of_offset(from_body, body.properties.size_exponent), real_from_raw(point.separation), point.feature,
        point.part};
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
