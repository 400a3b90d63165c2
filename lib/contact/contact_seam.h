#pragma once
#include "contact/contact_axis.h"
#include "contact/contact_feature.h"

/// What rests is sunk in by a hair, so that what slides over the seam of two bodies meets the side or the edge of the
/// next one. It is not to be stopped or thrown up there.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether two shapes that meet along an axis do so in no more than a sliver: they are apart along it, or overlap by no
/// more than `room`; and so it is along another axis, along which a face of each lies against the other's. Lengths
/// 2^-46 m.
bool is_sliver(const RestingPair& pair, const ContactAxis& axis, int64_t room);

/// What counts as a sliver: a 32nd of the thinner half thickness, or what they are sunk in, but no more than an eighth.
inline int64_t sliver_room(int64_t thickness, int64_t sunk) {
  const int64_t held = sunk < thickness >> 3 ? sunk : thickness >> 3;
  return held > thickness >> 5 ? held : thickness >> 5;
}

/// Unit vectors, Q30, whose product, Q60, is more than this enclose less than 2^-2 rad; than the second, 2^-4 rad.
inline constexpr int64_t k_alike = (int64_t{1} << 60) - (int64_t{1} << 55);
inline constexpr int64_t k_level_faces = (int64_t{1} << 60) - (int64_t{1} << 51);

/// Whether the shape is round: a ball about a core, 2^-46 m, or the side of a cylinder or cone.
inline bool is_round(const Convex& convex, int64_t radius) {
  return radius > 0 || convex.type == ShapeType::cylinder || convex.type == ShapeType::cone;
}

/// Of shapes of which one is round, the face that an axis leans against by less than 2^-2 rad, if they are level along
/// its normal but for `sunk`, 2^-46 m. False if there is none. `axis` becomes the normal's.
bool find_level_face(const RestingPair& pair, int64_t sunk, ContactAxis& axis);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
