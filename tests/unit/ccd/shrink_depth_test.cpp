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

DETENT_TEST(shrink_depth, scales_a_cone_down_to_a_quarter) {
  for (const bool is_flat : {false, true}) {
    const BodyProperties properties = properties_of(is_flat ? cone(0.4, 0.1) : cone(0.1, 0.4));
    for (const double shrink_depth : {0.0, 0.001, 0.0125, 0.05, 0.075, 0.09, 0.6}) {
      Convex whole, convex;
      ASSERT_TRUE(shrink_convex({}, properties, real_near(0), whole));
      ASSERT_TRUE(shrink_convex({}, properties, real_near(shrink_depth), convex));
      ASSERT_EQ(convex.exponent, whole.exponent);
      const double left = std::max(1 - shrink_depth / 0.1, 0.25);
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(std::ldexp(convex.size[i], convex.exponent - 30), left * ((i == 0) == is_flat ? 0.4 : 0.1), 1e-6);
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
