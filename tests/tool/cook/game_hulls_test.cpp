#include <gtest/gtest.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <map>
#include <set>

#include "cook.h"
#include "read_points.h"
#include "tests/common/support/data_file.h"
#include "tests/tool/cook/solids.h"
#if DETENT_HAS_QHULL
#include "tests/tool/cook/qhull.h"
#endif

namespace {

using namespace detent_cook;
using namespace detent_cook_test;

const std::string& game_hulls() {
  static const std::string bytes = detent_test::data_file("hulls/game_hulls.bin");
  return bytes;
}

std::vector<Cloud> game_clouds() {
  std::vector<Cloud> clouds;
  for (size_t at = 0; at < game_hulls().size();) {
    const PointsRead read = read_clouds(std::string_view(game_hulls()).substr(at), 0);
    if (!read.problem.empty()) {
      ADD_FAILURE() << read.problem;
      break;
    }
    clouds.push_back(read.points);
    at += 4 + 12 * read.points.size();
  }
  return clouds;
}

#define SKIP_WITHOUT_GAME_HULLS() \
  if (game_hulls().empty()) GTEST_SKIP() << "no hulls/game_hulls.bin under DETENT_DATA"

TEST(game_hulls, cook_or_are_refused_for_a_stated_cause) {
  SKIP_WITHOUT_GAME_HULLS();
  for (const Frame frame : {Frame::principal, Frame::source}) {
    std::map<std::string, int> reasons;
    int cooked = 0;
    double error = 0;
    size_t byte_count = 0;
    for (const Cloud& cloud : game_clouds()) {
      CookOptions options;
      options.frame = frame;
      const CookResult result = cook_hull(cloud, options);
      if (result.bytes.empty()) {
        ++reasons[result.reason.substr(0, 35)];
        EXPECT_EQ(result.reason.compare(0, 31, "all points lie in one plane: th") == 0 ||
                      result.reason.compare(0, 31, "all points lie in one plane but") == 0,
                  true)
            << result.reason;
        continue;
      }
      ++cooked;
      byte_count += result.bytes.size();
      error = fmax(error, ldexp(result.error, 30 - result.exponent));
    }
    EXPECT_GE(cooked, 3365);
    EXPECT_LE(error, 2);
    printf("%s frame: %d hulls, %.0f bytes each, error %.2f steps\n",
           frame == Frame::principal ? "principal" : "source", cooked, static_cast<double>(byte_count) / cooked, error);
    for (const auto& [reason, count] : reasons) printf("%d refused: %s...\n", count, reason.c_str());
  }
}

TEST(game_hulls, have_the_mass_that_other_formulae_give) {
  SKIP_WITHOUT_GAME_HULLS();
  double volume = 0, inertia = 0, centre = 0;
  for (const Cloud& cloud : game_clouds()) {
    const CookResult result = cook_hull(cloud);
    if (result.bytes.empty()) continue;
    const Integrals right = integrals_of(result.bytes);
    const auto found = stored_inertia(result.bytes);
    volume = fmax(volume, static_cast<double>(fabsl(stored_volume(result.bytes) / right.volume - 1)));
    for (size_t k = 0; k < 3; ++k) {
      inertia = fmax(inertia, static_cast<double>(fabsl(found[k] / right.inertia[k] - 1)));
      centre = fmax(centre, static_cast<double>(fabsl(right.centre[k])) / ldexp(1, result.exponent - 30));
    }
  }
  printf("relative errors: volume %.2g, inertia %.2g; centre %.2g steps\n", volume, inertia, centre);
  EXPECT_LE(volume, 0x1p-30);
  EXPECT_LE(inertia, 0x1p-29);
  EXPECT_LE(centre, 0.501);
}

#if DETENT_HAS_QHULL
/// Qhull's vertices that lie clearly outside the others' hull are among the cooked ones, and the volumes agree.
void expect_as_qhull(const Cloud& cloud, double& worst) {
  const CookResult result = cook_hull(cloud);
  if (result.bytes.empty()) return;
  const QhullAnswer right = qhull(cloud);
  ASSERT_TRUE(right.problem.empty()) << right.problem;
  const double step = ldexp(1, result.exponent - 30);
  // A layer of two steps over the surface; a solid's is at most 3 volume / inradius, and the inradius is at least a
  // sixth of the width's upper bound or so: generous.
  const double layer = 40 * 2 * step / result.width * right.volume;
  EXPECT_NEAR(result.volume, right.volume, layer + 1e-12 * right.volume);
  worst = fmax(worst, fabs(result.volume / right.volume - 1) * result.width / step);
}

TEST(game_hulls, have_the_volume_that_qhull_gives) {
  SKIP_WITHOUT_GAME_HULLS();
  double worst = 0;
  for (const Cloud& cloud : game_clouds()) expect_as_qhull(cloud, worst);
  printf("volume: at most %.2g steps of the width away\n", worst);
}

TEST(cook, random_hulls_have_the_volume_and_the_vertices_that_qhull_gives) {
  Random random = {11};
  double worst = 0;
  for (int round = 0; round < 200; ++round) {
    const Cloud cloud =
        placed(ellipsoid(random, 5 + round, 1, exp2(-random.uniform(0, 8)), exp2(-random.uniform(0, 8))),
               {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1}, {1, 2, 3});
    expect_as_qhull(cloud, worst);
    EXPECT_EQ(cook_hull(cloud).vertex_count, qhull(cloud).vertices.size());
  }
  printf("volume: at most %.2g steps of the width away\n", worst);
}
#else
TEST(cook, random_hulls_have_the_volume_and_the_vertices_that_qhull_gives) {
  GTEST_SKIP() << "built without Qhull (Debian: libqhull-dev)";
}
#endif

}  // namespace
