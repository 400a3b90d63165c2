#pragma once
#include "shape/height_field.h"
#include "shape/mesh.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Terrain (a mesh or a height field), in its own axes. Coordinates are in 2^-30 of the unit 2^exponent m.
struct Surface {
  bool is_mesh = false;  ///< false: a height field
  MeshView mesh;
  HeightFieldView field;

  int32_t exponent() const { return is_mesh ? mesh.exponent() : field.exponent(); }
  bool one_sided() const { return is_mesh ? mesh.one_sided() : field.one_sided(); }
  GridBox bounds() const { return is_mesh ? mesh.bounds() : field.bounds(); }
  SurfaceTriangle triangle(uint32_t i) const { return is_mesh ? mesh.triangle(i) : field.triangle(i); }

  /// Calls visit(index) for each triangle whose bounds, a GridBox, satisfy `meets`; always in the same order.
  template <class Meets, class Visit>
  void walk(Meets&& meets, Visit&& visit) const {
    if (is_mesh)
      mesh.walk(meets, visit);
    else
      field.walk(meets, visit);
  }
};

/// The terrain at `bytes`. read_surface() must have accepted them; this function checks nothing.
Surface surface_view(const uint8_t* bytes);

/// surface.triangle(index), for callers that must not link the readers of the formats.
SurfaceTriangle surface_triangle(const Surface& surface, uint32_t index);

/// Checks untrusted bytes. Errors: as read_mesh(); not_detent if they are neither a mesh nor a height field.
Status read_surface(const Asset& asset, Surface& surface);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
