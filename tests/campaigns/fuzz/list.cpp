#include "tests/campaigns/fuzz/target.h"

// DETENT_FUZZ_TARGETS: X(namespace, name) for each target of a program, one a configuration.
#define X(space, name)                   \
  namespace space {                      \
  extern const detent_fuzz::Target name; \
  }
DETENT_FUZZ_TARGETS
#undef X

namespace detent_fuzz {

#define X(space, name) &space::name,
const Target* const k_targets[] = {DETENT_FUZZ_TARGETS};
#undef X
const size_t k_target_count = sizeof k_targets / sizeof *k_targets;

}  // namespace detent_fuzz
