#include "examples/worlds/worlds.h"

#include "examples/rollback/seeded.h"
#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace worlds {

Snapshot::Snapshot(const World& world) : bytes_(snapshot_bytes(get_info(world).capacity)) {
  must(save(world, bytes_.data(), byte_count()));
}

void Snapshot::restore_to(World& world) const { must(restore(world, bytes_.data(), byte_count())); }

std::vector<uint8_t> Snapshot::difference(const World& world) const {
  std::vector<uint8_t> room(delta_bytes_max(get_info(world).capacity));
  uint32_t count = 0;
  must(save_delta(world, bytes_.data(), byte_count(), room.data(), static_cast<uint32_t>(room.size()), count));
  return {room.begin(), room.begin() + count};
}

void Snapshot::restore_to(World& world, const std::vector<uint8_t>& difference) const {
  must(restore_delta(world, bytes_.data(), byte_count(), difference.data(), static_cast<uint32_t>(difference.size())));
}

void DigestOfAll::add(const World& world) { value_ = detent_rollback::mix(value_ ^ digest(world)) + 1; }

}  // namespace worlds
}  // namespace DETENT_NAMESPACE
}  // namespace detent
