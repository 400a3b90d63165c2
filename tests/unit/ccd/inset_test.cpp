#include "ccd/impact_pair.h"

#include <algorithm>
#include <cmath>

#include "tests/common/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(shrink_depth, far_beyond_a_core_leaves_the_least_of_it) {
  const BodyProperties properties = properties_of(rounded(box(reals_near({{0.1, 0.1, 0.1}})), real_near(0.5)));
  for (const double shrink_depth : {0.05, 0.11, 0.24, 0.26, 0.3, 0.6}) {
    Convex convex;
    ASSERT_TRUE(shrink_convex({}, properties, real_near(shrink_depth), convex));
    for (const int32_t size : convex.size) {
      EXPECT_GE(size, 1) << shrink_depth;
      EXPECT_NEAR(std::ldexp(size, convex.exponent - 30), std::max(0.1 - shrink_depth, 0.0), 1e-6) << shrink_depth;
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
