#include "describe.h"

#include <math.h>
#include <string.h>

#include "geometry/hull.h"

namespace detent_cook {

HullDescription describe_hull(const std::vector<uint8_t>& bytes) {
  HullDescription description;
  std::vector<uint64_t> aligned(bytes.size() / 8 + 1);
  if (!bytes.empty()) memcpy(aligned.data(), bytes.data(), bytes.size());
  detent::HullInfo info;
  const detent::Status status =
      detent::hull_info({reinterpret_cast<const uint8_t*>(aligned.data()), static_cast<uint32_t>(bytes.size())}, info);
  if (status != detent::Status::ok) {
    description.problem = detent::status_text(status);
    return description;
  }
  description.vertex_count = info.vertex_count;
  description.face_count = info.face_count;
  description.edge_count = info.edge_count;
  description.principal = info.frame == detent::HullFrame::principal;
  description.exponent = info.exponent;
  description.radius = ldexp(info.core_radius, info.exponent - 30);
  description.volume = ldexp(info.volume_mantissa, info.volume_exponent);
  for (size_t k = 0; k < 3; ++k) description.origin[k] = info.origin[k];
  for (size_t k = 0; k < 4; ++k) description.rotation[k] = ldexp(info.rotation[k], -30);
  return description;
}

bool is_hull(const std::vector<uint8_t>& bytes) {
  return bytes.size() >= sizeof detent::k_hull_magic &&
         memcmp(bytes.data(), detent::k_hull_magic, sizeof detent::k_hull_magic) == 0;
}

}  // namespace detent_cook
