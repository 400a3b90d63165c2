#pragma once
#include <detent/world.h>

/// Shows a world through the caller's functions. Not linked unless called; reads the world only.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What is drawn: the caller chooses the colours.
enum class DrawKind : uint32_t {
  fixed,      ///< a fixed body
  kinematic,  ///< a kinematic body
  awake,      ///< a dynamic body that takes part in the next step
  asleep,     ///< one that does not
  bounds,     ///< an edge of a body's bounds
  contact,    ///< a contact point
  normal,     ///< its normal
  velocity,   ///< where a body goes
};

/// Null functions are left out.
struct DebugDraw {
  void* user = nullptr;  ///< given to each function
  /// A body, where it is. The triangles of a surface(): visit_triangles() (triangles.h); the parts of a compound:
  /// compound_part() (compound.h).
  void (*solid)(void* user, BodyId id, const Shape& shape, const Pose& pose, DrawKind kind) = nullptr;
  /// A line, m, world.
  void (*line)(void* user, const Position& from, const Position& to, DrawKind kind) = nullptr;
  /// A point, m, world.
  void (*point)(void* user, const Position& point, DrawKind kind) = nullptr;
};

/// Combine with |.
enum class DrawFlags : uint32_t {
  none = 0,        ///< nothing
  bodies = 1,      ///< each a solid, of kind fixed, kinematic, awake or asleep; a surface() without `solid` as lines
  bounds = 2,      ///< the twelve edges of each body's axis-aligned bounds; of a half-space none
  contacts = 4,    ///< each point, and a line along the normal as long as a quarter of the smaller body
  velocities = 8,  ///< a line from each body that moves to where its centre would be in a tenth of a second
  all = 15,        ///< everything
};
/// Both.
constexpr DrawFlags operator|(DrawFlags a, DrawFlags b) {
  return static_cast<DrawFlags>(static_cast<uint32_t>(a) | static_cast<uint32_t>(b));
}
/// Whether all of `some` are in `all`.
constexpr bool contains(DrawFlags all, DrawFlags some) {
  return (static_cast<uint32_t>(some) & ~static_cast<uint32_t>(all)) == 0;
}

/// Bodies come in slot order, contacts in that of contacts.h.
void draw(const World& world, const DebugDraw& to, DrawFlags flags = DrawFlags::all);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
