#include "state/view.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Features k_balls = Features::sphere | Features::half_space;
constexpr Capacity k_capacity = {12, 24, 1, true, 1};

/// A world with few features, in memory of its own.
struct Lean {
  std::vector<uint64_t> words = std::vector<uint64_t>(world_bytes(k_capacity) / 8);
  World world;
  Status status;

  explicit Lean(const FeatureTable& features, WorldDef def) {
    def.capacity = k_capacity;
    status = create_world(bytes_of(words), byte_count(words), def, {}, features, world);
  }
  explicit Lean(const FeatureTable& features) : Lean(features, def_of(features)) { EXPECT_OK(status); }

  static WorldDef def_of(const FeatureTable& features) {
    WorldDef def;
    def.continuous = contains(features.features, Features::continuous);
    def.sleeping = contains(features.features, Features::sleeping);
    return def;
  }
  Status add(const Shape& shape, double x, double y, BodyType type = BodyType::dynamic) {
    BodyDef def;
    def.type = type;
    def.shape = shape;
    def.position = position(x, y, 0.1 * x);
    def.linear_velocity = reals(type == BodyType::dynamic ? -x : 0, 0, 0);
    BodyId id;
    return create_body(world, def, id);
  }
  /// Creates a ball joint between the first two bodies.
  Status join() {
    JointDef def;
    def.a = next_body(world, {});
    def.b = next_body(world, def.a);
    JointId id;
    return create_joint(world, def, id);
  }
  std::vector<uint64_t> saved() {
    std::vector<uint64_t> bytes(snapshot_bytes(k_capacity) / 8);
    EXPECT_OK(save(world, bytes_of(bytes), byte_count(bytes)));
    return bytes;
  }
};

struct Kind {
  Features features;
  Shape shape;
};
std::vector<Kind> kinds() {
  return {{Features::sphere, sphere(real(0.5))},
          {Features::capsule, capsule(real(0.25), real(0.5))},
          {Features::box, box(reals(0.5, 0.5, 0.5))},
          {Features::cylinder, cylinder(real(0.5), real(0.5))},
          {Features::cone, cone(real(0.5), real(0.5))},
          {Features::box | Features::rounding, rounded(box(reals(0.25, 0.25, 0.25)), real(0.125))}};
}

/// Digests of 90 ticks of one kind of body that falls onto others and the ground.
std::vector<uint64_t> digests_of(const Kind& kind, const FeatureTable& features, const WorldDef& def) {
  Lean lean(features, def);
  EXPECT_OK(lean.status);
  EXPECT_OK(lean.add(half_space(), 0, 0, BodyType::fixed));
  for (int i = 0; i < 4; ++i) EXPECT_OK(lean.add(kind.shape, 0.3 * i, 0.6 + 1.1 * i));
  std::vector<uint64_t> digests;
  for (int tick = 0; tick < 90; ++tick) {
    const StepReport report = step(lean.world);
    EXPECT_TRUE(report.complete());
    digests.push_back(digest(lean.world));
  }
  EXPECT_GT(get_info(lean.world).contacts, 0u);
  return digests;
}

template <Features features>
void expect_what_all_compute(const Kind& kind) {
  const FeatureTable& lean = feature_table<features | Features::half_space>;
  const WorldDef def = Lean::def_of(lean);
  EXPECT_EQ(digests_of(kind, lean, def), digests_of(kind, feature_table<Features::all>, def));
}

DETENT_TEST(features, a_world_computes_the_same_whatever_else_is_linked) {
  const std::vector<Kind> kind = kinds();
  expect_what_all_compute<Features::sphere>(kind[0]);
  expect_what_all_compute<Features::capsule>(kind[1]);
  expect_what_all_compute<Features::box>(kind[2]);
  expect_what_all_compute<Features::cylinder>(kind[3]);
  expect_what_all_compute<Features::cone>(kind[4]);
  expect_what_all_compute<Features::box | Features::rounding>(kind[5]);
  expect_what_all_compute<Features::sphere | Features::continuous>(kind[0]);
  expect_what_all_compute<Features::box | Features::continuous | Features::sleeping>(kind[2]);
}

DETENT_TEST(features, each_shape_that_is_left_out_is_refused_and_changes_nothing) {
  const FeatureTable lacking[] = {
      feature_table<without(Features::all, Features::sphere)>,
      feature_table<without(Features::all, Features::capsule)>,
      feature_table<without(Features::all, Features::box)>,
      feature_table<without(Features::all, Features::cylinder)>,
      feature_table<without(Features::all, Features::cone)>,
      feature_table<without(Features::all, Features::rounding)>,
  };
  const std::vector<Kind> kind = kinds();
  for (size_t missing = 0; missing < kind.size(); ++missing) {
    Lean lean(lacking[missing]);
    for (const Kind& other : kind) {
      const bool linked = contains(lacking[missing].features, other.features);
      const uint64_t before = digest(lean.world);
      EXPECT_EQ(lean.add(other.shape, 0, 0), linked ? Status::ok : Status::feature_missing);
      EXPECT_EQ(digest(lean.world) == before, !linked);
    }
  }
  Lean no_plane(feature_table<without(Features::all, Features::half_space)>);
  EXPECT_EQ(no_plane.add(half_space(), 0, 0, BodyType::fixed), Status::feature_missing);
  Lean no_hull(feature_table<without(Features::all, Features::hull | Features::terrain | Features::compound)>);
  EXPECT_EQ(bind_asset(no_hull.world, 0), Status::feature_missing);
}

DETENT_TEST(features, a_policy_that_is_left_out_is_refused) {
  WorldDef def = Lean::def_of(feature_table<k_balls>);
  EXPECT_EQ(Lean(feature_table<k_balls>, def).status, Status::ok);
  def.continuous = true;
  EXPECT_EQ(Lean(feature_table<k_balls | Features::sleeping>, def).status, Status::feature_missing);
  def.continuous = false;
  def.sleeping = true;
  EXPECT_EQ(Lean(feature_table<k_balls | Features::continuous>, def).status, Status::feature_missing);

  Lean lean(feature_table<k_balls>);
  EXPECT_OK(lean.add(sphere(real(0.5)), 0, 0));
  EXPECT_EQ(sleep_body(lean.world, next_body(lean.world, {})), Status::feature_missing);
}

DETENT_TEST(features, joints_that_are_left_out_are_refused_and_change_nothing) {
  Lean lean(feature_table<k_balls>), jointed(feature_table<k_balls | Features::joints>);
  for (Lean* world : {&lean, &jointed}) {
    for (const double x : {0.0, 2.0}) EXPECT_OK(world->add(sphere(real(0.5)), x, 1));
  }
  const uint64_t before = digest(lean.world);
  EXPECT_EQ(before, digest(jointed.world));
  EXPECT_EQ(lean.join(), Status::feature_missing);
  EXPECT_EQ(digest(lean.world), before);
  EXPECT_OK(jointed.join());
  EXPECT_EQ(step(jointed.world).joints.count, 1u);
}

DETENT_TEST(features, a_snapshot_goes_to_a_world_that_has_all_that_its_own_had) {
  Lean lean(feature_table<k_balls>), all(feature_table<Features::all>, Lean::def_of(feature_table<k_balls>));
  EXPECT_OK(all.status);
  EXPECT_OK(lean.add(half_space(), 0, 0, BodyType::fixed));
  EXPECT_OK(lean.add(sphere(real(0.5)), 0.25, 2));
  const std::vector<uint64_t> of_none = all.saved();
  for (const bool trusted : {true, false}) {
    std::vector<uint64_t> bytes = lean.saved();
    EXPECT_OK(trusted ? restore(all.world, bytes_of(bytes), byte_count(bytes))
                      : load(all.world, bytes_of(bytes), byte_count(bytes)));
    EXPECT_EQ(digest(all.world), digest(lean.world));
    EXPECT_OK(all.add(box(reals(0.5, 0.5, 0.5)), 3, 1));  // it keeps its own features

    bytes = of_none;
    const uint64_t before = digest(lean.world);
    EXPECT_EQ(trusted ? restore(lean.world, bytes_of(bytes), byte_count(bytes))
                      : load(lean.world, bytes_of(bytes), byte_count(bytes)),
              Status::feature_missing);
    EXPECT_EQ(digest(lean.world), before);
  }
}

DETENT_TEST(features, a_snapshot_that_uses_what_it_says_was_left_out_is_corrupt) {
  Lean all(feature_table<Features::all>);
  EXPECT_OK(all.add(rounded(box(reals(0.25, 0.25, 0.25)), real(0.125)), 0, 1));
  EXPECT_OK(all.add(rounded(box(reals(0.25, 0.25, 0.25)), real(0.125)), 2, 1));
  EXPECT_OK(all.join());
  const std::vector<uint64_t> good = all.saved();
  for (uint32_t bit = 0; bit < 32; ++bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[offsetof(BlockHeader, left_out) + bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    const Features left_out = static_cast<Features>(1u << bit);
    const Features used =
        Features::box | Features::rounding | Features::continuous | Features::sleeping | Features::joints;
    const Status expected = !contains(Features::all, left_out) ? Status::format_unknown
                            : contains(used, left_out)         ? Status::corrupt
                                                               : Status::ok;
    EXPECT_EQ(load(all.world, bytes_of(bytes), byte_count(bytes)), expected) << "bit " << bit;
  }
}

DETENT_TEST(features, a_sleeper_is_refused_where_the_snapshot_has_no_sleeping) {
  WorldDef def;
  def.sleeping = false;  // but a body may still be put to sleep
  Lean all(feature_table<Features::all>, def);
  EXPECT_OK(all.add(sphere(real(0.5)), 0, 1));
  EXPECT_OK(sleep_body(all.world, next_body(all.world, {})));
  std::vector<uint64_t> bytes = all.saved();
  const uint32_t at = offsetof(BlockHeader, left_out) + 2;  // canonical bytes: sleeping is bit 18
  bytes_of(bytes)[at] ^= 1u << 2;
  EXPECT_EQ(load(all.world, bytes_of(bytes), byte_count(bytes)), Status::corrupt);
  bytes = all.saved();
  EXPECT_OK(load(all.world, bytes_of(bytes), byte_count(bytes)));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
