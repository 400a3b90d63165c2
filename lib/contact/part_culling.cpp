#include "contact/part_culling.h"

#include "math/root.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Vec32 absolute_of(const Vec32& v) {
  const auto absolute = [](int32_t c) { return c < 0 ? -c : c; };
  return {absolute(v.x), absolute(v.y), absolute(v.z)};
}

/// Whether two intervals, given by their middles and half lengths, are at most `margin` apart.
bool near(int64_t a, int64_t half_a, int64_t b, int64_t half_b, int64_t margin) {
  // The relative tolerances of 2^-20 and 2^-24 exceed the relative error of the rotation, which is less than 2^-27.
  const int64_t room = saturated_sum(saturated_sum(half_a, half_b), margin + (half_b >> 20) + (half_a >> 20));
  return static_cast<int64_t>(magnitude_64(saturated_sum(b, -a))) <=
         saturated_sum(room, static_cast<int64_t>(magnitude_64(b) >> 24));
}

}  // namespace

PartCulling::PartCulling(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b,
                         Real distance, const Vec3<Real>& displacement) {
  Vec64 raw, moved;
  known_ = !is_half_space(a) && !is_half_space(b) && raw_from_real({distance, Real(0.0), Real(0.0)}, raw) &&
           raw_from_real(displacement, moved) && place_on_terrain(pose_a, pose_b, place_) == Status::ok;
  if (!known_) return;
  margin_ = raw.x + (raw.x >> 10) + 1024;
  const Vec64 along = rotate_back(place_.terrain, moved);
  half_displacement_ = {along.x / 2, along.y / 2, along.z / 2};
}

void PartCulling::bring(Vec64& middle, Vec64& half) const {
  if (!known_) return;
  const Vec64 turned = rotate(place_.rotation, middle);
  const Vec64 &centre = place_.centre, &moved = half_displacement_;
  middle = {saturated_sum(centre.x, turned.x + moved.x), saturated_sum(centre.y, turned.y + moved.y),
            saturated_sum(centre.z, turned.z + moved.z)};
  const Matrix32& m = place_.rotation;
  const Matrix32 size = {{absolute_of(m.column[0]), absolute_of(m.column[1]), absolute_of(m.column[2])}};
  half = rotate(size, half);
  const auto magnitude = [](int64_t v) { return static_cast<int64_t>(magnitude_64(v)); };
  half = {half.x + magnitude(moved.x), half.y + magnitude(moved.y), half.z + magnitude(moved.z)};
}

bool PartCulling::meet(const Vec64& middle_a, const Vec64& half_a, const Vec64& middle_b, const Vec64& half_b) const {
  return !known_ || (near(middle_a.x, half_a.x, middle_b.x, half_b.x, margin_) &&
                     near(middle_a.y, half_a.y, middle_b.y, half_b.y, margin_) &&
                     near(middle_a.z, half_a.z, middle_b.z, half_b.z, margin_));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
