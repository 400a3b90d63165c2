#include "state/snapshot.h"

#include "base/bytes.h"
#include "base/float_environment.h"
#include "state/fields.h"
#include "state/step_cache.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Layout layout_of(const World& world) { return view_of(world).layout; }

}  // namespace

void swap_state(uint8_t* block, const Layout& layout) {
  if (!k_big_endian) return;
  for (uint32_t i = 0; i < k_section_count; ++i) {
    uint8_t* element = block + layout.*k_sections[i].offset;
    const uint32_t count = section_bytes(layout, i) / k_sections[i].element_bytes;
    for (uint32_t k = 0; k < count; ++k, element += k_sections[i].element_bytes) swap_element(i, element);
  }
}

Status check_header(const BlockHeader& header, Capacity capacity, const FeatureTable& features) {
  if (header.magic != k_snapshot_magic) return Status::not_detent;
  if (header.format != k_snapshot_format || header.manifolds > 1 || header.zero != 0) return Status::format_unknown;
  if (header.simulation != k_simulation_version) return Status::simulation_differs;
  if (header.config != k_config) return Status::config_differs;
  if (!(capacity_of(header) == capacity)) return Status::capacity_differs;
  const Features left_out = static_cast<Features>(header.left_out);
  if (!contains(Features::all, left_out)) return Status::format_unknown;
  if (!contains(features.features, without(Features::all, left_out))) return Status::feature_missing;
  return Status::ok;
}

Status check_canonical_header(const uint8_t* bytes, Capacity capacity, const FeatureTable& features) {
  BlockHeader header;
  memcpy(&header, bytes, sizeof header);
  if (k_big_endian) swap_element(0, reinterpret_cast<uint8_t*>(&header));
  return check_header(header, capacity, features);
}

void take_over(World& world) {
  view_of(world).header.left_out = left_out(*world.features);
  forget_steps(world);
}

void swap_element(uint32_t section_index, uint8_t* element) {
  const SectionFields& section = k_section_fields[section_index];
  for (uint32_t i = 0; i < section.field_count; ++i) {
    swap_words(element + section.fields[i].offset, section.fields[i].width, section.fields[i].count);
  }
}

Status save(const World& world, uint8_t* bytes, uint32_t byte_count) {
  const Layout layout = layout_of(world);
  if (bytes == nullptr || byte_count < layout.persistent_bytes) return Status::buffer_too_small;
  memcpy(bytes, world.block, layout.persistent_bytes);
  swap_state(bytes, layout);
  return Status::ok;
}

Status restore(World& world, const uint8_t* bytes, uint32_t byte_count) {
  const Layout layout = layout_of(world);
  if (bytes == nullptr || byte_count < sizeof(BlockHeader)) return Status::truncated;
  const Status status = check_canonical_header(bytes, capacity_of(view_of(world).header), *world.features);
  if (status != Status::ok) return status;
  if (byte_count < layout.persistent_bytes) return Status::truncated;
  memcpy(world.block, bytes, layout.persistent_bytes);
  swap_state(world.block, layout);
  take_over(world);
  return Status::ok;
}

Status load(World& world, uint8_t* bytes, uint32_t byte_count) {
  const FloatEnvironment environment;
  const Layout layout = layout_of(world);
  const Capacity capacity = capacity_of(view_of(world).header);
  if (bytes == nullptr || byte_count < sizeof(BlockHeader)) return Status::truncated;
  if (reinterpret_cast<uintptr_t>(bytes) % 8 != 0) return Status::buffer_misaligned;
  if (const Status status = check_canonical_header(bytes, capacity, *world.features); status != Status::ok)
    return status;
  if (byte_count < layout.persistent_bytes) return Status::truncated;
  if (byte_count > layout.persistent_bytes) return Status::corrupt;
  swap_state(bytes, layout);
  if (const Status status = check_state(bytes, capacity, world.hooks.assets, *world.features, world.hooks.filter_rules);
      status != Status::ok)
    return status;
  memcpy(world.block, bytes, layout.persistent_bytes);
  take_over(world);
  return Status::ok;
}

bool snapshot_read(const World& world, uint32_t offset, uint8_t* bytes, uint32_t count) {
  const Layout layout = layout_of(world);
  if (offset > layout.persistent_bytes || count > layout.persistent_bytes - offset) return false;
  if (!k_big_endian) {
    memcpy(bytes, world.block + offset, count);
    return true;
  }
  memset(bytes, 0, count);  // the fill between arrays, which no element covers
  const uint32_t end = offset + count;
  for (uint32_t i = 0; i < k_section_count; ++i) {
    const uint32_t start = layout.*k_sections[i].offset;
    const uint32_t size = k_sections[i].element_bytes;
    const uint32_t elements = section_bytes(layout, i) / size;
    const uint32_t first = offset > start ? (offset - start) / size : 0;
    for (uint32_t k = first; k < elements && start + k * size < end; ++k) {
      uint8_t element[k_element_bytes_max];
      memcpy(element, world.block + start + k * size, size);
      swap_element(i, element);
      for (uint32_t byte = 0; byte < size; ++byte) {
        const uint32_t at = start + k * size + byte;
        if (at >= offset && at < end) bytes[at - offset] = element[byte];
      }
    }
  }
  return true;
}

Status empty_world(World& world, Capacity capacity) {
  WorldDef def;
  def.capacity = capacity;
  def.continuous = world.features->continuous != nullptr;
  def.sleeping = world.features->sleeping != nullptr;
  World same;
  return create_world(world.block, world_bytes(capacity), def, {}, *world.features, same);
}

Status load_from(World& world, Status (*read)(void* context, uint32_t offset, uint8_t* bytes, uint32_t count),
                 void* context) {
  const FloatEnvironment environment;
  const Layout layout = layout_of(world);
  const Capacity capacity = capacity_of(view_of(world).header);
  const auto fail = [&](Status status) {
    const Status emptied = empty_world(world, capacity);
    return emptied == Status::ok ? status : emptied;
  };
  forget_steps(world);
  constexpr uint32_t k_read_bytes = 256;
  for (uint32_t offset = 0; offset < layout.persistent_bytes; offset += k_read_bytes) {
    const uint32_t left = layout.persistent_bytes - offset;
    const Status status = read(context, offset, world.block + offset, left < k_read_bytes ? left : k_read_bytes);
    if (status != Status::ok) return fail(status);
    if (offset != 0) continue;
    const Status header = check_canonical_header(world.block, capacity, *world.features);
    if (header != Status::ok) return fail(header);
  }
  swap_state(world.block, layout);
  const Status status =
      check_state(world.block, capacity, world.hooks.assets, *world.features, world.hooks.filter_rules);
  if (status != Status::ok) return fail(status);
  take_over(world);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
