#pragma once
#include "tests/campaigns/fuzz/target.h"

namespace detent_fuzz {

/// What machines of examples/rollback tell each other. The first byte chooses the message.
extern const Target k_packets_target;

}  // namespace detent_fuzz
