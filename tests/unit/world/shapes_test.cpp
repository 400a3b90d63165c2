#include <math.h>

#include <functional>

#include "base/crc.h"
#include "shape/hull.h"
#include "state/view.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/shape/hull_bytes.h"
#include "tests/unit/world/lab.h"

/// Worlds of cylinders, cones, hulls and rounded shapes.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

alignas(8) constexpr uint8_t k_no_hull[16] = {1, 2, 3};
const Asset k_assets[] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism},
                          {k_no_hull, sizeof k_no_hull}};
const AssetTable k_table = {k_assets, 3};
constexpr Capacity k_capacity = {16, 40, 3};

Lab make_lab(uint32_t bound = 2) {
  WorldDef world;
  world.sleeping = false;  // what stays must stay by itself
  Lab lab(k_capacity, world);
  lab.world.hooks.assets = k_table;
  for (uint32_t i = 0; i < bound; ++i) EXPECT_OK(bind_asset(lab.world, i));
  return lab;
}

struct Named {
  const char* name;
  Shape shape;
  double height;              ///< of the centre of mass, m, where it rests flat
  double rotation_vector[4];  ///< x, y, z, w: to rest flat
};

/// One of each shape that goes through contact_points(), about half a metre in size.
std::vector<Named> all_shapes() {
  const Real half = 0.5, quarter = 0.25, tenth = Real(0.1);
  const double s = sqrt(0.5);
  return {{"cylinder", cylinder(quarter, half), 0.5, {0, 0, 0, 1}},
          {"cylinder on its side", cylinder(quarter, half), 0.25, {s, 0, 0, s}},
          {"cone", cone(half, half), 0.25, {0, 0, 0, 1}},
          {"rounded box", rounded(box({half, quarter, half}), tenth), 0.35, {0, 0, 0, 1}},
          {"rounded cylinder", rounded(cylinder(half, quarter), tenth), 0.35, {0, 0, 0, 1}},
          {"rounded cone", rounded(cone(half, half), tenth), 0.35, {0, 0, 0, 1}},
          {"prism", hull(1), 0.8, {s, 0, 0, s}},
          {"rounded prism", rounded(hull(1), tenth), 0.9, {s, 0, 0, s}},
          {"tetrahedron", hull(0), 0.5, {0.2, 0.1, 0.3, sqrt(0.86)}}};
}

BodyDef def_of(const Named& named, double x, double y, double z) {
  BodyDef def;
  def.shape = named.shape;
  def.position = position(x, y, z);
  def.rotation = {unit(named.rotation_vector[0]), unit(named.rotation_vector[1]), unit(named.rotation_vector[2]),
                  unit(named.rotation_vector[3])};
  // Without rolling resistance a cylinder on its side, or a shape that falls on a corner, would correctly roll for
  // ever.
  def.material.rolling_resistance = real(0.05);
  return def;
}

double speed_of(Lab& lab, BodyId id) {
  const Motion motion = lab.motion(id);
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += motion.linear_velocity[i] * motion.linear_velocity[i] +
           0.25 * motion.angular_velocity[i] * motion.angular_velocity[i];
  return sqrt(sum);
}

/// Drops each shape from about 5 cm, lets it come to rest within 5 s, and checks that it stays at rest for 5 s more.
void expect_rest(double floor, bool on_box) {
  for (const Named& named : all_shapes()) {
    Lab lab = make_lab();
    if (on_box) {
      BodyDef table;
      table.type = BodyType::fixed;
      table.shape = box(reals(2, 0.5, 2));
      table.position = position(0, floor - 0.5, 0);
      lab.add(table);
    } else {
      lab.add_ground();
    }
    const BodyId id = lab.add(def_of(named, 0.1, floor + named.height + 0.05, -0.2));
    uint32_t capped = 0;
    for (int i = 0; i < 300; ++i) capped += step(lab.world).contacts.capped;
    const Motion start = lab.motion(id);
    double fastest = 0;
    for (int i = 0; i < 300; ++i) {
      capped += step(lab.world).contacts.capped;
      fastest = fmax(fastest, speed_of(lab, id));
    }
    const Motion end = lab.motion(id);
    EXPECT_LT(fastest, 1e-4) << named.name;
    EXPECT_EQ(capped, 0u) << named.name;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(end.position[i], start.position[i], 2e-4) << named.name << " axis " << i;
    const double height = end.position[1] - floor;
    if (named.shape.type == ShapeType::hull && named.shape.asset == 0) {  // it falls on its large face, or on another
      EXPECT_LT(fmin(fabs(height - 0.25 / sqrt(3.0)), fabs(height - 0.25)), 1e-3) << height;
    } else {
      EXPECT_NEAR(height, named.height, 1e-3) << named.name;
    }
  }
}

DETENT_TEST(world_shapes, every_shape_dropped_on_the_ground_comes_to_rest_and_stays) { expect_rest(0, false); }
DETENT_TEST(world_shapes, every_shape_dropped_on_a_box_comes_to_rest_and_stays) { expect_rest(1, true); }

DETENT_TEST(world_shapes, the_new_shapes_stand_on_each_other) {
  Lab lab = make_lab();
  lab.add_ground();
  const Real half = 0.5, quarter = 0.25, tenth = Real(0.1);
  const double s = sqrt(0.5);
  const Named tower[] = {{"cylinder", cylinder(half, quarter), 0.25, {0, 0, 0, 1}},
                         {"rounded box", rounded(box({half, quarter, half}), tenth), 0.35, {0, 0, 0, 1}},
                         {"prism", hull(1), 0.8, {s, 0, 0, s}},
                         {"rounded cylinder", rounded(cylinder(quarter, quarter), tenth), 0.35, {0, 0, 0, 1}},
                         {"cone", cone(quarter, half), 0.25, {0, 0, 0, 1}}};
  std::vector<BodyId> ids;
  std::vector<double> heights;
  double top = 0;
  for (const Named& named : tower) {
    heights.push_back(top + named.height);
    ids.push_back(lab.add(def_of(named, 0, top + named.height, 0)));
    top += 2 * named.height;
  }
  lab.run(600);
  for (size_t i = 0; i < ids.size(); ++i) {
    const Motion motion = lab.motion(ids[i]);
    EXPECT_NEAR(motion.position[1], heights[i], 0.02) << tower[i].name;
    EXPECT_NEAR(hypot(motion.position[0], motion.position[2]), 0, 0.02) << tower[i].name;
  }
}

DETENT_TEST(world_shapes, a_hull_has_to_be_bound_and_a_hull) {
  Lab lab = make_lab(0);
  BodyDef def;
  BodyId id;
  def.shape = hull(1);
  EXPECT_EQ(create_body(lab.world, def, id), Status::asset_missing);
  ASSERT_OK(bind_asset(lab.world, 1));
  EXPECT_OK(create_body(lab.world, def, id));
  lab.world.hooks.assets.count = 1;
  EXPECT_EQ(create_body(lab.world, def, id), Status::asset_missing);
  lab.world.hooks.assets = k_table;
  def.shape = hull(0);
  EXPECT_EQ(create_body(lab.world, def, id), Status::asset_missing);
  ASSERT_OK(bind_asset(lab.world, 2));
  def.shape = hull(2);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.shape = hull(3);
  EXPECT_EQ(create_body(lab.world, def, id), Status::out_of_range);
  def.shape = rounded(hull(1), real(-1));
  EXPECT_EQ(create_body(lab.world, def, id), Status::out_of_range);
  Shape triangle;
  triangle.type = ShapeType::triangle;
  def.shape = triangle;
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  EXPECT_EQ(get_info(lab.world).bodies, 1u);
}

DETENT_TEST(world_shapes, a_hull_in_its_sources_frame_is_for_bodies_that_nothing_moves) {
  // The tetrahedron, marked as being in its source frame: inverse inertia, origin and rotation are then those of that
  // frame.
  alignas(8) static uint8_t bytes[sizeof detent_hulls::k_tetrahedron];
  memcpy(bytes, detent_hulls::k_tetrahedron, sizeof bytes);
  memset(bytes + k_hull_inverse_inertia_at, 0, 24 + 24 + 12);
  const uint32_t one = 1u << 30;
  for (uint32_t i = 0; i < 4; ++i) bytes[k_hull_rotation_at + 12 + i] = static_cast<uint8_t>(one >> (8 * i));
  bytes[k_hull_frame_at] = 2;
  const uint32_t checksum =
      crc32(bytes + k_hull_checksum_at + 4, sizeof bytes - k_hull_checksum_at - 4, crc32(bytes, k_hull_checksum_at));
  for (uint32_t i = 0; i < 4; ++i) bytes[k_hull_checksum_at + i] = static_cast<uint8_t>(checksum >> (8 * i));
  const Asset assets[] = {{bytes, sizeof bytes}};
  Lab lab(k_capacity);
  lab.world.hooks.assets = {assets, 1};
  ASSERT_OK(bind_asset(lab.world, 0));
  BodyDef def;
  BodyId id;
  def.shape = hull(0);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.type = BodyType::kinematic;
  EXPECT_OK(create_body(lab.world, def, id));
  def.type = BodyType::fixed;
  EXPECT_OK(create_body(lab.world, def, id));
  std::vector<uint64_t> bytes_out = lab.snapshot();
  EXPECT_OK(load(lab.world, bytes_of(bytes_out), byte_count(bytes_out)));
}

DETENT_TEST(world_shapes, an_asset_cannot_be_bound_to_another_content_under_the_bodies_that_have_it) {
  Lab lab = make_lab(1);
  BodyDef def;
  def.shape = hull(0);
  const BodyId id = lab.add(def);
  EXPECT_OK(bind_asset(lab.world, 0));
  const uint64_t before = digest(lab.world);
  const Asset other[] = {k_assets[1]};
  lab.world.hooks.assets = {other, 1};
  EXPECT_EQ(bind_asset(lab.world, 0), Status::asset_mismatch);
  EXPECT_EQ(digest(lab.world), before);
  EXPECT_OK(destroy_body(lab.world, id));
  EXPECT_OK(bind_asset(lab.world, 0));
}

DETENT_TEST(world_shapes, a_step_without_a_hulls_bytes_says_so) {
  Lab lab = make_lab();
  lab.add_ground();
  BodyDef def;
  def.shape = hull(1);
  def.position = position(0, 0.2, 0);
  lab.add(def);
  EXPECT_EQ(lab.run(1).contacts.capped, 0u);
  lab.world.hooks.assets = {};
  EXPECT_EQ(lab.run(1).contacts.capped, 1u);
}

/// One body of each shape, falling on the ground.
Lab make_heap() {
  Lab lab = make_lab();
  lab.add_ground();
  double x = 0;
  for (const Named& named : all_shapes()) lab.add(def_of(named, x += 1.5, named.height + 0.01, 0));
  lab.run(20);
  return lab;
}

DETENT_TEST(world_shapes, a_snapshot_with_hulls_is_taken_back_only_with_their_bytes) {
  Lab lab = make_heap();
  const std::vector<uint64_t> good = lab.snapshot();
  const uint64_t before = digest(lab.world);
  lab.run(10);
  const uint64_t after = digest(lab.world);
  const auto load_with = [&](AssetTable assets) {
    Lab fresh(k_capacity);
    fresh.world.hooks.assets = assets;
    std::vector<uint64_t> bytes = good;
    const Status status = load(fresh.world, bytes_of(bytes), byte_count(bytes));
    if (status == Status::ok) {
      EXPECT_EQ(digest(fresh.world), before);
      fresh.run(10);
      EXPECT_EQ(digest(fresh.world), after);
    } else {
      EXPECT_EQ(get_info(fresh.world).bodies, 0u);
    }
    return status;
  };
  EXPECT_OK(load_with(k_table));
  EXPECT_EQ(load_with({}), Status::asset_missing);
  EXPECT_EQ(load_with({k_assets, 1}), Status::asset_missing);
  const Asset hole[] = {k_assets[0], {}};
  EXPECT_EQ(load_with({hole, 2}), Status::asset_missing);
  const Asset swapped[] = {k_assets[1], k_assets[0]};
  EXPECT_EQ(load_with({swapped, 2}), Status::asset_mismatch);
  const Asset no_hull[] = {k_assets[0], k_assets[2]};
  EXPECT_EQ(load_with({no_hull, 2}), Status::asset_mismatch);
}

/// The status of load() for the snapshot with a body altered by `alter`.
Status load_altered(const std::vector<uint64_t>& good, uint32_t slot,
                    const std::function<void(BodyProperties&)>& alter) {
  Lab fresh(k_capacity);
  fresh.world.hooks.assets = k_table;
  std::vector<uint64_t> bytes = good;
  alter(view_of(bytes_of(bytes), k_capacity).properties[slot]);
  return load(fresh.world, bytes_of(bytes), byte_count(bytes));
}

DETENT_TEST(world_shapes, a_snapshot_whose_shapes_are_not_what_create_body_makes_is_refused) {
  if (k_big_endian) return;
  Lab lab = make_heap();
  const std::vector<uint64_t> good = lab.snapshot();
  constexpr uint32_t k_cylinder = 1, k_round_box = 4, k_prism = 7, k_round_prism = 8;
  const auto refused = [&](uint32_t slot, const std::function<void(BodyProperties&)>& alter) {
    return load_altered(good, slot, alter) == Status::corrupt;
  };
  EXPECT_OK(load_altered(good, k_prism, [](BodyProperties&) {}));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.asset = 0; })) << "the other hull";
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.asset = 2; })) << "not bound";
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.asset = 3; })) << "beyond the table";
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.asset = 0xffffffff; }));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.rotation_locks = 1; }))
      << "whose inverse inertia is not 0";
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { ++body.size_exponent; }));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { --body.size_exponent; }));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.size.x = body.size.y; }));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.rounding = Unit(0.125); }));
  EXPECT_TRUE(refused(k_prism, [](BodyProperties& body) { body.shape = 8; })) << "a triangle";
  EXPECT_TRUE(refused(k_round_prism, [](BodyProperties& body) { body.rounding = Unit(0.0); }));
  EXPECT_TRUE(refused(k_round_box, [](BodyProperties& body) { body.rounding = -body.rounding; }));
  EXPECT_TRUE(refused(k_round_box, [](BodyProperties& body) { body.rounding = Unit(0x1p-20); }));
  EXPECT_TRUE(refused(k_round_box, [](BodyProperties& body) { body.bounding_radius = Unit(0.5); }));
  EXPECT_TRUE(refused(k_cylinder, [](BodyProperties& body) { body.rounding = Unit(0.125); }));
  EXPECT_TRUE(refused(k_cylinder, [](BodyProperties& body) { body.asset = 1; }));
  EXPECT_TRUE(refused(k_cylinder, [](BodyProperties& body) { body.size.z = body.size.y; }));
  EXPECT_TRUE(refused(k_cylinder, [](BodyProperties& body) { body.shape = static_cast<uint32_t>(ShapeType::cone); }));
  EXPECT_TRUE(refused(0, [](BodyProperties& body) { body.rounding = Unit(0.125); })) << "a rounded half-space";
}

DETENT_TEST(world_shapes, no_bit_of_a_shape_can_be_flipped_into_a_crash) {
  Lab lab = make_heap();
  const std::vector<uint64_t> good = lab.snapshot();
  std::vector<uint64_t> place = good;
  const StateView<uint8_t> view = view_of(bytes_of(place), k_capacity);
  const uint32_t first = static_cast<uint32_t>(reinterpret_cast<uint8_t*>(view.properties.data) - bytes_of(place));
  const uint32_t bodies = get_info(lab.world).bodies;
  Lab other = make_lab();
  uint32_t loaded = 0, refused = 0;
  const auto try_bit = [&](uint32_t bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[bit / 8] ^= static_cast<uint8_t>(1 << (bit % 8));
    if (load(other.world, bytes_of(bytes), byte_count(bytes)) != Status::ok) {
      ++refused;
      return;
    }
    ++loaded;
    other.run(2);  // any state that is let in can be stepped
  };
  const uint32_t stride = detent_oracle::rounds(4) < 4 ? 7 : 1;  // an emulator tries one in seven
  for (uint32_t bit = 8 * first; bit < 8 * (first + bodies * uint32_t{sizeof(BodyProperties)}); bit += stride)
    try_bit(bit);
  for (uint32_t bit = 8 * (byte_count(good) - 3 * uint32_t{sizeof(AssetState)}); bit < 8 * byte_count(good); ++bit)
    try_bit(bit);
  EXPECT_GT(loaded, 0u);
  EXPECT_GT(refused, loaded / 8);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
