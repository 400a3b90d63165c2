#pragma once
#include <string.h>

#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes nonsense of all that a step may not read before it has written it: what a new world has no zeros in. What the
/// world keeps from step to step must be forgotten then (forget_steps, restore).
inline void spoil_work_space(World& world, int byte) {
  const Layout layout = view_of(world).layout;
  memset(world.block + layout.persistent_bytes, byte, layout.candidates - layout.persistent_bytes);
  memset(world.block + layout.moving_bodies, byte, layout.bytes - layout.moving_bodies);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
