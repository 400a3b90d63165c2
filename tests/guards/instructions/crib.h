#pragma once
#include <detent/world.h>

/// A crib: planks in layers laid crosswise, so that each lies on all of the layer below. Many contacts for few boxes.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Planks in each layer, from the ground up. Range: [1, 5] each; the planks of a layer do not touch each other.
inline constexpr uint32_t k_crib_layers[] = {DETENT_CRIB_LAYERS};

constexpr uint32_t crib_planks() {
  uint32_t planks = 0;
  for (const uint32_t layer : k_crib_layers) planks += layer;
  return planks;
}

/// Pairs in contact; those of the lowest layer lie on the ground.
constexpr uint32_t crib_contacts() {
  uint32_t contacts = 0, below = 1;
  for (const uint32_t layer : k_crib_layers) {
    contacts += layer * below;
    below = layer;
  }
  return contacts;
}

/// The ground is a body too; contact points are found anew in each tick.
inline constexpr Capacity k_crib_capacity = {crib_planks() + 1, crib_contacts(), 0, false};

inline Status build_crib(World& world) {
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  BodyId id;
  Status status = create_body(world, ground, id);
  BodyDef plank;
  // All numbers are exact in every configuration.
  const Real half_length = 0.5, half_thickness = 0.0625;
  Coord height = Coord(0.0625);
  bool along_x = true;
  for (const uint32_t layer : k_crib_layers) {
    plank.shape = along_x ? box({half_length, half_thickness, half_thickness})
                          : box({half_thickness, half_thickness, half_length});
    Coord aside = Coord(0.0);
    for (uint32_t i = 1; i < layer; ++i) aside = aside - Coord(0.09375);
    for (uint32_t i = 0; i < layer && status == Status::ok; ++i) {
      plank.position = along_x ? Position{Coord(0.0), height, aside} : Position{aside, height, Coord(0.0)};
      status = create_body(world, plank, id);
      aside = aside + Coord(0.1875);
    }
    height = height + Coord(0.125);
    along_x = !along_x;
  }
  return status;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
