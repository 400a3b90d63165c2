#pragma once
#include "tests/common/oracle/motions.h"

namespace detent_bench {

/// Where the library, of one configuration, has a body in a step.
detent_oracle::Placed step_motion_at(const detent_oracle::PosesOfStep& poses, double time);

}  // namespace detent_bench
