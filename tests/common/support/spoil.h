#pragma once
#include <string.h>

#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Overwrites the memory that a step may not read before it has written it. A new world does not clear this memory. If
/// the world has made steps, call forget_steps() or restore() afterwards, because it keeps data between steps there.
inline void spoil_work_space(World& world, int byte) {
  const Layout layout = view_of(world).layout;
  memset(world.block + layout.persistent_bytes, byte, layout.candidates - layout.persistent_bytes);
  memset(world.block + layout.moving_bodies, byte, layout.bytes - layout.moving_bodies);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
