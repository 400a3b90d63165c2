#pragma once
#include <detent/world.h>

/// The triangles of bodies whose shape is a terrain (terrain() in shape.h), for drawing. Not linked unless called; only
/// reads the world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A triangle of a body, at the body's current pose.
struct BodyTriangle {
  uint32_t index = 0;       ///< as QueryHit::triangle
  uint32_t material = 0;    ///< as cooked
  Position corner[3] = {};  ///< counter-clockwise from the front, m, world
};

/// Calls visit(user, triangle) for each triangle of the body, always in the same order. Rounding: to a step of a
/// position. Errors: bad_id, bad_argument (the body's shape is no terrain), asset_missing.
Status visit_triangles(const World& world, BodyId id, void* user,
                       void (*visit)(void* user, const BodyTriangle& triangle));

}  // namespace DETENT_NAMESPACE
}  // namespace detent
