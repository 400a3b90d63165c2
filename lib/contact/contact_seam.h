#pragma once
#include "contact/contact_axis.h"
#include "contact/contact_feature.h"

/// Contacts at seams. A resting body penetrates its support slightly. When it slides over the seam between two
/// supporting bodies, it therefore hits the side or the edge of the second body. These functions detect such contacts,
/// so that the caller can prevent them from stopping the sliding body or throwing it upward.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether the contact along `axis` is a *sliver*: a shallow contact beside a face contact of the same shapes. Two
/// conditions must hold. Along `axis`, the shapes are apart or overlap by at most `room` (2^-46 m). Along some other
/// axis, more than 2^-2 rad from `axis`, a face of A lies against a face of B with a separation within +-`room`.
bool is_sliver(const RestingPair& pair, const ContactAxis& axis, int64_t room);

/// Returns the argument `room` of is_sliver(): the greater of thickness / 32 and `sunk`, where `sunk`
/// (ContactMargins::sunk) is limited to thickness / 8. `thickness`: the half thickness of the thinner shape. All three
/// lengths are in the same unit.
inline int64_t sliver_room(int64_t thickness, int64_t sunk) {
  const int64_t held = sunk < thickness >> 3 ? sunk : thickness >> 3;
  return held > thickness >> 5 ? held : thickness >> 5;
}

/// Cosines, Q60, of 2^-2 rad (k_alike) and 2^-4 rad (k_level_faces). If the dot product of two unit vectors (Q30)
/// exceeds one of these cosines, the angle between the vectors is smaller than the angle of that cosine.
inline constexpr int64_t k_alike = (int64_t{1} << 60) - (int64_t{1} << 55);
inline constexpr int64_t k_level_faces = (int64_t{1} << 60) - (int64_t{1} << 51);

/// Whether the shape is round: its core is rounded by a ball of `radius` > 0 (2^-46 m), or it is a cylinder or cone.
inline bool is_round(const Convex& convex, int64_t radius) {
  return radius > 0 || convex.type == ShapeType::cylinder || convex.type == ShapeType::cone;
}

/// Finds a face that is level with the contact of a pair with a round shape. Its normal is within 2^-2 rad of `axis`,
/// and the separations along `axis` and along this normal are both within +-`sunk` (2^-46 m). Replaces `axis` by the
/// contact axis along this normal. Returns false, with `axis` unchanged, if there is no such face or no round shape.
bool find_level_face(const RestingPair& pair, int64_t sunk, ContactAxis& axis);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
