#pragma once
#include "tests/campaigns/fuzz/target.h"

namespace detent_fuzz {

/// Text and pictures that the cook reads: OBJ as points, as a mesh and as a compound, files of clouds, PGM. The first
/// byte chooses the reader.
extern const Target k_readers_target;

}  // namespace detent_fuzz
