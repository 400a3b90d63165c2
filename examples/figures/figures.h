#pragma once
#include "examples/figures/svg.h"

/// The figures of the pages of docs/, drawn from what the library does and says.
namespace figures {

Svg draw_joints();
Svg draw_mover();
Svg draw_events();
Svg draw_continuous_collision();
Svg draw_memory();

}  // namespace figures
