#pragma once
#include <detent/world.h>

/// The triangles of bodies that have a surface() (shape.h), for those who draw them. Not linked unless called; reads
/// the world only.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A triangle of a body, where the body is.
struct BodyTriangle {
  uint32_t index = 0;       ///< as QueryHit::triangle
  uint32_t material = 0;    ///< as it was cooked
  Position corner[3] = {};  ///< counter-clockwise from the front, m, world
};

/// Calls visit(user, triangle) for each triangle of the body, always in the same order. Rounding: to a position's step.
/// Errors: bad_id, bad_argument (the body has no surface), asset_missing.
Status visit_triangles(const World& world, BodyId id, void* user,
                       void (*visit)(void* user, const BodyTriangle& triangle));

}  // namespace DETENT_NAMESPACE
}  // namespace detent
