#pragma once
#include <detent/config.h>

/// @file
/// Ids of bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Names a body by value. Null if both members are zero. Valid until the body is destroyed; a later body in the same
/// slot has another generation. A slot whose generation would overflow is no longer used, and is counted in
/// `WorldInfo::slots_retired`.
struct BodyId {
  uint32_t slot = 0;        ///< index + 1; 0 is null
  uint32_t generation = 0;  ///< 1 for the first body of a slot
  /// Whether both name the same body.
  friend constexpr bool operator==(BodyId a, BodyId b) { return a.slot == b.slot && a.generation == b.generation; }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
