#include "collision/surface_manifolds.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_same_cosine = (int64_t{1} << 60) - (int64_t{1} << 49);     // 2^-5 rad
constexpr int64_t k_similar_cosine = (int64_t{1} << 60) - (int64_t{1} << 55);  // 2^-2 rad
constexpr int k_plane_power = 4;  ///< planes no farther apart than this part of the half thickness are one
constexpr uint32_t k_edge_key = 0x80000000u;

int64_t along(const Vec64& v, const Vec32& direction) { return dot(v, direction).round_shift(30); }

/// An axis in the plane across a normal, the same for equal normals.
Vec32 axis_across(const Vec32& n) {
  const uint32_t x = magnitude_32(n.x), y = magnitude_32(n.y), z = magnitude_32(n.z);
  const Vec32 least = x <= y && x <= z ? Vec32{k_one, 0, 0} : z <= y ? Vec32{0, 0, k_one} : Vec32{0, k_one, 0};
  return unit_vector_raw(scaled_to_30_bits(cross(least, n)));
}

/// Along one of the four diagonals of the plane, turned a little, as in lib/proximity. Range: |u|, |v| < 2^59.
int64_t reach_along(int64_t u, int64_t v, int diagonal) {
  const int64_t reach = (diagonal & 1) == 0 ? 4 * u + 5 * v : 4 * v - 5 * u;
  return diagonal < 2 ? reach : -reach;
}

/// The name of a contact's feature, made independent of the triangle: its face is named as any, what is on it by the
/// shape alone, and its corners and edges by where they are.
uint32_t feature_of(uint32_t feature, const uint32_t (&corner)[3]) {
  const uint32_t kind = feature >> 10 & 3, index = feature & 0x3ff, kept = feature & 0xfffc00u;
  if (kind == static_cast<uint32_t>(FeatureType::face)) return kept;
  // Edge 0 runs between corners 0 and 1, 1 between 0 and 2, 2 between 1 and 2, as lib/proximity names them.
  const uint32_t name = kind == static_cast<uint32_t>(FeatureType::vertex) ? corner[index % 3]
                        : index == 0                                       ? corner[0] + corner[1]
                        : index == 1                                       ? corner[0] + corner[2]
                                                                           : corner[1] + corner[2];
  return kept | (name & 0x3ff) | (name >> 10 & 0xff) << 24;
}

/// What a normal is named: itself, coarsely. Those along the axes lie in the middle of what has one name.
uint32_t normal_name(const Vec32& normal) {
  const auto part = [](int32_t a) { return static_cast<uint32_t>((a + (1 << 24)) >> 25) & 0x7f; };
  return 1u << 29 | part(normal.x) << 22 | part(normal.y) << 15 | part(normal.z) << 8;
}

}  // namespace

SurfaceManifolds::Group* SurfaceManifolds::group_for(const SurfaceTouch& touch, int64_t plane) {
  const Vec32& normal = touch.manifold.normal;
  Group* similar = nullptr;
  int64_t most = k_similar_cosine;
  for (uint32_t i = 0; i < count_; ++i) {
    Group& group = group_[i];
    const int64_t cosine = dot(group.normal, normal), apart = plane - group.plane;
    if (cosine >= k_same_cosine && (apart < 0 ? -apart : apart) <= size_ >> k_plane_power) return &group;
    if (cosine <= most) continue;
    most = cosine;
    similar = &group;
  }
  if (count_ == k_groups_max && similar != nullptr) return similar;
  Group* fresh = &group_[count_];
  if (count_ == k_groups_max) {
    fresh = &group_[0];
    for (Group& group : group_) fresh = group.deepest > fresh->deepest ? &group : fresh;
    if (fresh->deepest <= touch.deepest) {
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
  return fresh;
}

void SurfaceManifolds::add(const SurfaceTouch& touch) {
  const BlockManifold& manifold = touch.manifold;
  capped_ = capped_ || manifold.capped;
  const BlockPoint& first = manifold.point[0];
  const int64_t plane = along(first.from_b, manifold.normal) - first.separation / 2;
  if (Group* group = group_for(touch, plane); group != nullptr) join(touch, plane, *group);
}

void SurfaceManifolds::join(const SurfaceTouch& touch, int64_t plane, Group& group) {
  if (touch.deepest < group.deepest) {
    group.deepest = touch.deepest;
    group.normal = touch.manifold.normal;
    group.plane = plane;
    group.triangle = touch.triangle;
    group.material = touch.material;
  }
  group.first = touch.triangle < group.first ? touch.triangle : group.first;
  group.on_face = group.on_face || touch.on_face;
  group.doubtful = group.doubtful && touch.doubtful;
  ++group.touches;
  for (uint32_t i = 0; i < touch.manifold.count; ++i) {
    const BlockPoint& point = touch.manifold.point[i];
    const uint32_t feature = feature_of(point.feature, touch.corner_name);
    add_point({point.from_b, point.separation, feature}, group);
  }
}

void SurfaceManifolds::add_point(const SurfaceManifold::Point& contact, Group& group) const {
  const Point point = {contact, along(contact.from_shape, group.u), along(contact.from_shape, group.v)};
  for (uint32_t i = 0; i < group.count; ++i) {
    if (group.point[i].contact.feature != contact.feature) continue;
    if (contact.separation < group.point[i].contact.separation) group.point[i] = point;
    return;
  }
  if (group.count == k_points_max) {
    const uint32_t spare = spare_point(group);
    for (uint32_t i = spare; i + 1 < group.count; ++i) group.point[i] = group.point[i + 1];
    --group.count;
  }
  group.point[group.count++] = point;
}

/// One that is neither an extreme nor the deepest: of eight there are three.
uint32_t SurfaceManifolds::spare_point(const Group& group) {
  bool needed[k_points_max] = {};
  for (int diagonal = 0; diagonal < 4; ++diagonal) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < group.count; ++i) {
      const Point &p = group.point[i], &q = group.point[best];
      best = reach_along(p.u, p.v, diagonal) > reach_along(q.u, q.v, diagonal) ? i : best;
    }
    needed[best] = true;
  }
  uint32_t deepest = 0;
  for (uint32_t i = 1; i < group.count; ++i) {
    deepest = group.point[i].contact.separation < group.point[deepest].contact.separation ? i : deepest;
  }
  needed[deepest] = true;
  uint32_t spare = 0;
  while (spare + 1 < group.count && needed[spare]) ++spare;
  return spare;
}

/// Up to four of the points: extremes, and the deepest if it is deeper than all of them.
void SurfaceManifolds::choose(const Group& group, SurfaceManifold& manifold) const {
  bool taken[k_points_max] = {};
  uint32_t deepest = 0, nearest = 0;
  for (uint32_t i = 1; i < group.count; ++i) {
    deepest = group.point[i].contact.separation < group.point[deepest].contact.separation ? i : deepest;
  }
  const auto distance = [&](uint32_t i) {
    return magnitude_64(group.point[i].u - group.point[deepest].u) +
           magnitude_64(group.point[i].v - group.point[deepest].v);
  };
  bool deep = false;
  uint32_t count = 0;
  for (uint32_t k = 0; k < (group.count > 4 ? 4 : group.count); ++k) {
    uint32_t best = group.count > 4 ? 0 : k;
    for (uint32_t i = 1; group.count > 4 && i < group.count; ++i) {
      const Point &p = group.point[i], &q = group.point[best];
      const int diagonal = static_cast<int>(k);
      best = reach_along(p.u, p.v, diagonal) > reach_along(q.u, q.v, diagonal) ? i : best;
    }
    if (taken[best]) continue;
    taken[best] = true;
    deep = deep ||
           group.point[best].contact.separation <= group.point[deepest].contact.separation + (size_ >> k_drop_power);
    if (count == 0 || distance(best) < distance(nearest)) nearest = best;
    ++count;
  }
  if (!deep) {
    if (count == 4) taken[nearest] = false;
    taken[deepest] = true;
  }
  manifold.count = 0;
  for (uint32_t i = 0; i < group.count; ++i) {
    if (taken[i]) manifold.point[manifold.count++] = group.point[i].contact;
  }
  manifold.normal = group.normal;
  manifold.triangle = group.triangle;
  manifold.material = group.material;
}

/// What lies very deep along a normal that the surface forces on it counts only if nothing else is touched.
void SurfaceManifolds::leave_out_doubtful() {
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

uint32_t SurfaceManifolds::finish(SurfaceManifold (&manifold)[k_surface_manifolds_max]) {
  leave_out_doubtful();
  while (count_ > k_surface_manifolds_max) {
    uint32_t shallowest = 0;
    for (uint32_t i = 1; i < count_; ++i) {
      shallowest = group_[i].deepest >= group_[shallowest].deepest ? i : shallowest;
    }
    dropped_ += group_[shallowest].touches;
    for (uint32_t i = shallowest; i + 1 < count_; ++i) group_[i] = group_[i + 1];
    --count_;
  }
  // By key; planes of one name by their height.
  const auto key_of = [](const Group& group) {
    return group.on_face ? normal_name(group.normal) : k_edge_key | group.first;
  };
  for (uint32_t i = 1; i < count_; ++i) {
    for (uint32_t k = i; k > 0; --k) {
      Group &low = group_[k - 1], &high = group_[k];
      const uint32_t low_key = key_of(low), high_key = key_of(high);
      if (low_key < high_key || (low_key == high_key && low.plane <= high.plane)) break;
      const Group swapped = low;
      low = high;
      high = swapped;
    }
  }
  for (uint32_t i = 0; i < count_; ++i) {
    choose(group_[i], manifold[i]);
    manifold[i].key = key_of(group_[i]);
    if (i > 0 && manifold[i].key <= manifold[i - 1].key) manifold[i].key = manifold[i - 1].key + 1;
  }
  return count_;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
