#pragma once
#include <detent/detail/layout.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_snapshot_magic = 0x544e5444;  // "DTNT" in canonical bytes
inline constexpr uint32_t k_snapshot_format = 6;

/// The value of BlockHeader::left_out for a world with this feature table.
inline uint32_t left_out(const FeatureTable& features) {
  return static_cast<uint32_t>(without(Features::all, features.features));
}
/// The features that a world needs for these settings.
inline Features features_of(bool continuous, bool sleeping) {
  return (continuous ? Features::continuous : Features::none) | (sleeping ? Features::sleeping : Features::none);
}

inline Capacity capacity_of(const BlockHeader& header) {
  return {header.capacity_bodies, header.capacity_contacts, header.capacity_assets,
          header.manifolds != 0,  header.capacity_joints,   header.capacity_sensed};
}

/// The type `T`; `const T` if `Byte` is const.
template <class T, class Byte>
struct Select {
  using Type = T;
};
template <class T>
struct Select<T, const uint8_t> {
  using Type = const T;
};

/// The persistent arrays of a block, as spans. `Byte` is uint8_t, or const uint8_t for a world that is only read.
template <class Byte>
struct StateView {
  template <class T>
  using Of = typename Select<T, Byte>::Type;

  Layout layout;
  Of<BlockHeader>& header;
  Of<WorldState>& world;
  Span<Of<BodyPose>> poses;
  Span<Of<BodyMotion>> motions;
  Span<Of<BodyProperties>> properties;
  Span<Of<BodyActivity>> activities;
  Span<Of<uint32_t>> slots;
  Span<Of<ContactState>> contacts;  ///< all elements of the capacity, used or not
  Span<Of<AssetState>> assets;
  Span<Of<ManifoldState>> manifolds;  ///< one per contact if the world has room for them, else empty
  Span<Of<JointState>> joints;        ///< all elements of the capacity, used or not
  Span<Of<SensedState>> sensed;       ///< all elements of the capacity, used or not
};

template <class T, class Byte>
typename Select<T, Byte>::Type* at_offset(Byte* block, uint32_t offset) {
  return reinterpret_cast<typename Select<T, Byte>::Type*>(block + offset);
}

/// Returns the arrays of a block of this capacity. Range: the capacity is valid (layout_of()).
template <class Byte>
DETENT_SHARED StateView<Byte> view_of(Byte* block, Capacity capacity) {
  bool fits = false;
  const Layout layout = layout_of(capacity, fits);
  return {layout,
          *at_offset<BlockHeader>(block, layout.header),
          *at_offset<WorldState>(block, layout.world),
          {at_offset<BodyPose>(block, layout.poses), capacity.bodies},
          {at_offset<BodyMotion>(block, layout.motions), capacity.bodies},
          {at_offset<BodyProperties>(block, layout.properties), capacity.bodies},
          {at_offset<BodyActivity>(block, layout.activities), capacity.bodies},
          {at_offset<uint32_t>(block, layout.slots), slot_words(capacity.bodies)},
          {at_offset<ContactState>(block, layout.contacts), capacity.contacts},
          {at_offset<AssetState>(block, layout.assets), capacity.assets},
          {at_offset<ManifoldState>(block, layout.manifolds), manifold_count(capacity)},
          {at_offset<JointState>(block, layout.joints), capacity.joints},
          {at_offset<SensedState>(block, layout.sensed), capacity.sensed}};
}
DETENT_SHARED inline StateView<uint8_t> view_of(World& world) {
  return view_of(world.block, capacity_of(*at_offset<BlockHeader>(world.block, 0)));
}
DETENT_SHARED inline StateView<const uint8_t> view_of(const World& world) {
  const uint8_t* block = world.block;
  return view_of(block, capacity_of(*at_offset<BlockHeader>(block, 0)));
}

/// Sets `slot` to the slot of the body `id`. Returns false if there is no such body.
template <class Byte>
bool find_body(const StateView<Byte>& state, BodyId id, uint32_t& slot) {
  slot = id.slot - 1;  // slot 0 of the null id wraps to a slot beyond every capacity
  return slot < state.properties.count && state.properties[slot].type != 0 &&
         state.properties[slot].generation == id.generation;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
