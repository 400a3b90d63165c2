#pragma once
#include "tests/campaigns/fuzz/target.h"

namespace detent_fuzz {

/// Scenes as JSON, which are read and played for some ticks by the configuration that the first byte names.
extern const Target k_scenes_target;
/// Compressed recordings, unpacked and sought in as the first byte says.
extern const Target k_packed_target;

}  // namespace detent_fuzz
