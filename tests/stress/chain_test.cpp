#include <stdio.h>

#include <algorithm>
#include <vector>

#include "tests/oracle/effort.h"
#include "tests/world/joint_lab.h"

/// Scene S6: a chain of 30 links with a weight at its end, released level.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_links = 30;
constexpr double k_link = 0.5, k_length = k_links * k_link;  // m
constexpr double k_radius = 0.05, k_half_length = 0.2, k_weight_half = 0.3;

struct Chain {
  Lab lab = Lab(Capacity{k_links + 2, 8, 0, true, k_links + 1});
  std::vector<JointId> joints;

  /// `ratio`: of the weight's mass to a link's.
  explicit Chain(double ratio) {
    BodyDef def;
    def.filter.group = -1;
    def.type = BodyType::fixed;
    def.shape = sphere(real(0.1));
    BodyId last = lab.add(def);
    def.type = BodyType::dynamic;
    def.shape = capsule(real(k_radius), real(k_half_length));
    def.rotation = {Unit(0.0), Unit(0.0), Unit(-0.70710678118), Unit(0.70710678118)};  // along x
    Scaled mass;
    for (int i = 0; i < k_links; ++i) {
      def.position = position((i + 0.5) * k_link, 0, 0);
      const BodyId link = lab.add(def);
      hang(last, link, i * k_link);
      last = link;
    }
    EXPECT_OK(get_mass(lab.world, last, mass));
    def.shape = box(reals(k_weight_half, k_weight_half, k_weight_half));
    def.rotation = BodyDef().rotation;
    def.position = position(k_length + k_weight_half, 0, 0);
    def.mass = scaled(ratio * scaled_to_host(mass));
    hang(last, lab.add(def), k_length);
  }
  void hang(BodyId a, BodyId b, double x) { joints.push_back(add_joint(lab, JointType::ball, a, b, x, 0, 0)); }
  /// How much longer the way along the anchors is than the links, over their length.
  double stretch() const {
    double gaps = 0;
    for (const JointId id : joints) gaps += length(joint_ends(lab.world, id).gap());
    return gaps / k_length;
  }
};

DETENT_TEST(chain, of_thirty_links_hardly_stretches_whatever_hangs_from_it) {
  const uint32_t ticks = std::min(detent_oracle::rounds(1800), 1800u);
  for (const double ratio : {100.0, 10.0, 1.0}) {
    Chain chain(ratio);
    double most = 0, late = 0;
    uint32_t saturations = 0;
    for (uint32_t tick = 0; tick < ticks; ++tick) {
      saturations += chain.lab.run(1).saturations;
      const double stretch = chain.stretch();
      most = std::max(most, stretch);
      if (tick >= ticks - ticks / 3) late += stretch / (ticks / 3);
    }
    printf("weight of %g links: stretch %.4f %% at most, %.4f %% late\n", ratio, 100 * most, 100 * late);
    EXPECT_LE(most, 0.05) << ratio;
    EXPECT_LE(late, 0.01) << ratio;
    EXPECT_EQ(saturations, 0u) << ratio;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
