#include "contact/contact_seam.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_normals_max = 8;  ///< the greatest number of faces near a point; further faces are ignored

/// Outward normals of the faces near a point of a shape.
struct NearFaces {
  int count = 0;
  Vec32 normal[k_normals_max];

  void add(const Vec32& outward) {
    if (count < k_normals_max) normal[count++] = outward;
  }
};

/// Returns the outward normals of those flat faces of the core whose planes pass at most `room` outside `point`.
/// `point` is relative to the core's centre. Lengths are in ulps (2^-30 of the pair's unit).
NearFaces faces_about(const Placed& placed, const Vec32& point, int64_t room) {
  NearFaces near;
  const Convex& convex = *placed.convex;
  const Vec32 at = rotate_inverse(placed.rotation, point);
  const auto add_side = [&](int axis, int32_t along) {
    const Vec32& outward = placed.rotation.column[axis];
    near.add(along < 0 ? negate(outward) : outward);
  };
  const auto reaches = [&](int32_t along, int32_t size) {
    return static_cast<int64_t>(magnitude_32(along)) >= in_block(placed, size) - room;
  };
  switch (convex.type) {
    case ShapeType::box: {
      const int32_t along[3] = {at.x, at.y, at.z};
      for (int i = 0; i < 3; ++i) {
        if (reaches(along[i], convex.size[i])) add_side(i, along[i]);
      }
      break;
    }
    case ShapeType::cylinder:
      if (reaches(at.y, convex.size[1])) add_side(1, at.y);
      break;
    case ShapeType::cone:
      if (at.y < 0 && reaches(at.y, convex.size[1] / 2)) add_side(1, at.y);
      break;
    case ShapeType::hull:
      for (uint32_t f = 0; f < placed.hull.face_count; ++f) {
        const HullPlane plane = placed.hull.plane(f);
        const Vec32 normal = {plane.normal[0], plane.normal[1], plane.normal[2]};
        if (dot(normal, at) >> 30 >= in_block(placed, plane.offset) - room)
          near.add(round_shift(multiply(placed.rotation, normal), 30));
      }
      break;
    default:
      break;
  }
  return near;
}

/// Returns the separation of the cores along `normal` (from A to B), in ulps. Sets `axis` to this normal, the
/// separation, and the points of the cores that are farthest along it.
int64_t apart_along(const RestingPair& pair, const Vec32& normal, ContactAxis& axis) {
  axis.normal = normal;
  axis.point_a = support(pair.a, normal).point;
  axis.point_b = support(pair.b, negate(normal)).point;
  axis.separation = dot(normal, subtract(add(pair.offset, axis.point_b), axis.point_a)) >> 30;
  return axis.separation;
}

}  // namespace

__attribute__((noinline)) bool is_sliver(const RestingPair& pair, const ContactAxis& axis, int64_t room) {
  const int64_t radii = pair.radius_a + pair.radius_b, gap = pair.metres(axis.separation) - radii;
  if (gap < -room) return false;
  // While the shapes are apart, their nearest points may be farther from the faces than the points at which the shapes
  // will touch: by up to the gap.
  const int64_t about = pair.block_above(gap > 0 ? room + gap : room);
  const NearFaces of_a = faces_about(pair.a, axis.point_a, about);
  if (of_a.count == 0) return false;
  NearFaces of_b;
  for (int i = 0; i < of_a.count; ++i) {
    const Vec32& normal = of_a.normal[i];
    const int64_t along = dot(normal, axis.normal);
    if (along > k_alike || along < -k_alike) continue;
    if (of_b.count == 0) of_b = faces_about(pair.b, axis.point_b, about);
    bool faced = false;
    for (int k = 0; k < of_b.count; ++k) faced = faced || dot(normal, of_b.normal[k]) < -k_level_faces;
    ContactAxis other;
    if (!faced) continue;
    const int64_t apart = pair.metres(apart_along(pair, normal, other)) - radii;
    if (apart >= -room && apart <= room) return true;
  }
  return false;
}

__attribute__((noinline)) bool find_level_face(const RestingPair& pair, int64_t sunk, ContactAxis& axis) {
  const int64_t radii = pair.radius_a + pair.radius_b;
  const auto is_level = [&](int64_t block) {
    const int64_t apart = pair.metres(block) - radii;
    return apart >= -sunk && apart <= sunk;
  };
  if (!is_round(*pair.a.convex, pair.radius_a) && !is_round(*pair.b.convex, pair.radius_b)) return false;
  if (!is_level(axis.separation)) return false;
  const int64_t about = pair.block_above(sunk);
  for (int side = 0; side < 2; ++side) {
    const NearFaces near =
        side == 0 ? faces_about(pair.a, axis.point_a, about) : faces_about(pair.b, axis.point_b, about);
    for (int i = 0; i < near.count; ++i) {
      const Vec32 normal = side == 0 ? near.normal[i] : negate(near.normal[i]);
      ContactAxis level = axis;
      if (dot(normal, axis.normal) < k_alike || !is_level(apart_along(pair, normal, level))) continue;
      // The contact point is placed on the line along the face normal through the round shape's core point. If it lay
      // beside this line, the contact would exert a torque on a ball.
      const Vec64 offset = {normal.x * level.separation, normal.y * level.separation, normal.z * level.separation};
      const Vec32 across = round_shift(offset, 30);
      if (side == 0)
        axis.point_a = subtract(add(pair.offset, axis.point_b), across);
      else
        axis.point_b = subtract(add(axis.point_a, across), pair.offset);
      axis.normal = normal;
      axis.separation = level.separation;
      return true;
    }
  }
  return false;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
