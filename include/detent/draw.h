#pragma once
#include <detent/world.h>

/// Draws a world through the caller's functions, without changing the world. The code is linked only if draw() is used.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The kind of an object to draw. The caller can choose its colour by the kind.
enum class DrawKind : uint32_t {
  fixed,            ///< a fixed body
  kinematic,        ///< a kinematic body
  awake,            ///< a dynamic body that takes part in the next step
  asleep,           ///< a dynamic body that sleeps
  bounds,           ///< an edge of a body's bounds
  contact,          ///< a contact point
  normal,           ///< the normal at a contact point
  linear_velocity,  ///< the velocity of a body
};

/// The caller's drawing functions. A null function is not called.
struct DebugDraw {
  void* user = nullptr;  ///< passed to each function
  /// Draws a body at its pose. For a terrain, visit_triangles() (query.h) gives the triangles; for a compound,
  /// compound_part() (asset.h) gives the parts.
  void (*solid)(void* user, BodyId id, const Shape& shape, const Pose& pose, DrawKind kind) = nullptr;
  /// Draws a line, m, world.
  void (*line)(void* user, const Position& from, const Position& to, DrawKind kind) = nullptr;
  /// Draws a point, m, world.
  void (*point)(void* user, const Position& point, DrawKind kind) = nullptr;
};

/// The objects that draw() draws. Combine with |.
enum class DrawFlags : uint32_t {
  none = 0,    ///< nothing
  bodies = 1,  ///< each body, by `solid`; if `solid` is null, only the edges of the terrains' triangles, by `line`
  bounds = 2,  ///< the twelve edges of each body's axis-aligned bounds, except for half-spaces
  /// Each contact point, and a line along its normal, as long as a quarter of the pair's smaller extent (WorldDef).
  contacts = 4,
  velocities = 8,  ///< a line from the centre of each moving body to its place after 0.1 s at the current velocity
  all = 15,        ///< everything
};
/// The flags that are in `a` or in `b`.
constexpr DrawFlags operator|(DrawFlags a, DrawFlags b) {
  return static_cast<DrawFlags>(static_cast<uint32_t>(a) | static_cast<uint32_t>(b));
}
/// Whether all flags of `some` are in `all`.
constexpr bool contains(DrawFlags all, DrawFlags some) {
  return (static_cast<uint32_t>(some) & ~static_cast<uint32_t>(all)) == 0;
}

/// Draws the world: first the bodies, in the order of their slots, then the contacts, in the order of get_contact().
void draw(const World& world, const DebugDraw& to, DrawFlags flags = DrawFlags::all);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
