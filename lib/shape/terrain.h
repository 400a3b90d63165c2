#pragma once
#include "shape/height_field.h"
#include "shape/mesh.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Terrain (a mesh or a height field), in its own axes. Coordinates are in 2^-30 of the unit 2^exponent m.
struct Terrain {
  bool is_mesh = false;  ///< false: a height field
  MeshView mesh;
  HeightFieldView field;

  int32_t exponent() const { return is_mesh ? mesh.exponent() : field.exponent(); }
  bool one_sided() const { return is_mesh ? mesh.one_sided() : field.one_sided(); }
  GridBox bounds() const { return is_mesh ? mesh.bounds() : field.bounds(); }
  TerrainTriangle triangle(uint32_t i) const { return is_mesh ? mesh.triangle(i) : field.triangle(i); }

  /// Calls visit(index) for each triangle whose bounds, a GridBox, satisfy `meets`; always in the same order.
  template <class Meets, class Visit>
  void walk(Meets&& meets, Visit&& visit) const {
    if (is_mesh)
      mesh.walk(meets, visit);
    else
      field.walk(meets, visit);
  }
};

/// The terrain at `bytes`. read_terrain() must have accepted them; this function checks nothing.
Terrain terrain_view(const uint8_t* bytes);

/// Returns terrain.triangle(index). Callers that must not link the readers of the formats call it through the feature
/// table.
TerrainTriangle terrain_triangle(const Terrain& terrain, uint32_t index);

/// Checks untrusted bytes. Errors: as read_mesh(); not_detent if they are neither a mesh nor a height field.
Status read_terrain(const Asset& asset, Terrain& terrain);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
