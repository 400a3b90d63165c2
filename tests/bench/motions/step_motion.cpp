#include "tests/bench/motions/step_motion.h"

#include "tests/common/oracle/step_motion.h"

namespace detent_bench {

detent_oracle::Placed step_motion_at(const detent_oracle::PosesOfStep& poses, double time) {
  return detent::step_motion_at(poses, time);
}

}  // namespace detent_bench
