#include <detent/body.h>
#include <detent/world.h>
#include <math.h>

#include "tests/unit/shape/hull_bytes.h"
#include "tests/unit/world/lab.h"

/// What definitions set can be read back and changed.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef unusual_body() {
  BodyDef def;
  def.position = position(1, 2, 3);
  def.rotation = {0.5, 0.5, -0.5, 0.5};
  def.linear_velocity = reals(1, -2, 3);
  def.angular_velocity = reals(0.5, 0.25, -1);
  def.shape = rounded(box(reals(0.5, 0.75, 1.25)), real(0.125));
  def.material = {real(0.3), real(0.7), real(0.01), RestitutionRule::smaller};
  def.mass = scaled(12.5);
  def.linear_damping = real(0.1);
  def.angular_damping = real(0.2);
  def.gravity_scale = real(-1.5);
  def.user_data = 77;
  def.rotation_locks = k_rotation_lock_z;
  return def;
}

void expect_near(Real a, Real b, double relative = 1e-6) {
  EXPECT_NEAR(real_to_host(a), real_to_host(b), relative * (1 + fabs(real_to_host(b))));
}
void expect_near(const Vec3<Real>& a, const Vec3<Real>& b) {
  expect_near(a.x, b.x);
  expect_near(a.y, b.y);
  expect_near(a.z, b.z);
}

void expect_same(const Shape& a, const Shape& b) {
  EXPECT_EQ(a.type, b.type);
  expect_near(a.radius, b.radius);
  expect_near(a.half_length, b.half_length);
  expect_near(a.half_extents, b.half_extents);
  expect_near(a.rounding, b.rounding);
}

void expect_same(const BodyDef& a, const BodyDef& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_TRUE(a.position == b.position);
  expect_near(a.linear_velocity, b.linear_velocity);
  expect_near(a.angular_velocity, b.angular_velocity);
  expect_same(a.shape, b.shape);
  expect_near(a.material.friction, b.material.friction);
  expect_near(a.material.restitution, b.material.restitution);
  expect_near(a.material.rolling_resistance, b.material.rolling_resistance);
  EXPECT_EQ(a.material.restitution_rule, b.material.restitution_rule);
  EXPECT_NEAR(scaled_to_host(a.mass) / scaled_to_host(b.mass), 1, 1e-6);
  expect_near(a.linear_damping, b.linear_damping);
  expect_near(a.angular_damping, b.angular_damping);
  expect_near(a.gravity_scale, b.gravity_scale);
  EXPECT_EQ(a.user_data, b.user_data);
  EXPECT_EQ(a.rotation_locks, b.rotation_locks);
}

/// Checks that load() accepts the state, and that a step from the loaded state gives the same result.
void expect_sound(Lab& lab) {
  Lab other(get_info(lab.world).capacity);
  std::vector<uint64_t> bytes = lab.snapshot();
  ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes)));
  lab.run(1);
  other.run(1);
  EXPECT_EQ(digest(lab.world), digest(other.world));
}

/// A box asleep on a slab that floats in space.
struct Still {
  Lab lab;
  BodyId slab, box;
  explicit Still(BodyType type = BodyType::fixed) : lab({4, 8, 0}, {}, true) {
    BodyDef def;
    def.type = type;
    def.shape = detent::box(reals(2, 0.25, 2));
    slab = lab.add(def);
    box = lab.add_box(0.5, 0, 0.75, 0);
    lab.run(120);
    EXPECT_FALSE(awake());
  }
  bool awake() {
    bool result = false;
    EXPECT_OK(is_awake(lab.world, box, result));
    return result;
  }
};

DETENT_TEST(access, a_definition_read_back_is_what_was_given_and_creates_the_same_body) {
  BodyDef given = unusual_body();
  const Shape shapes[] = {given.shape, sphere(real(0.3)), capsule(real(0.2), real(1)), cylinder(real(1), real(0.5)),
                          cone(real(0.4), real(0.6))};
  for (const Shape& shape : shapes) {
    given.shape = shape;
    given.angular_velocity.z = Real(0.0);
    given.rotation_locks = 0;
    Lab lab({2, 2, 0}), other({2, 2, 0});
    const BodyId id = lab.add(given);
    BodyDef read, again;
    ASSERT_OK(get_body_def(lab.world, id, read));
    expect_same(read, given);
    const BodyId copy = other.add(read);
    ASSERT_OK(get_body_def(other.world, copy, again));
    expect_same(again, read);
    lab.run(30);
    other.run(30);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(lab.motion(id).position[i], other.motion(copy).position[i], 1e-4);
  }
}

DETENT_TEST(access, what_is_set_is_read_back) {
  Lab lab({2, 2, 0});
  const BodyId id = lab.add(BodyDef{});
  const BodyDef want = unusual_body();
  ASSERT_OK(set_shape(lab.world, id, want.shape));
  ASSERT_OK(set_material(lab.world, id, want.material));
  ASSERT_OK(set_damping(lab.world, id, want.linear_damping, want.angular_damping));
  ASSERT_OK(set_gravity_scale(lab.world, id, want.gravity_scale));
  ASSERT_OK(set_mass(lab.world, id, want.mass));
  ASSERT_OK(set_user_data(lab.world, id, want.user_data));
  ASSERT_OK(set_pose(lab.world, id, want.position, want.rotation));
  ASSERT_OK(set_velocity(lab.world, id, want.linear_velocity, want.angular_velocity));
  ASSERT_OK(set_rotation_locks(lab.world, id, want.rotation_locks));
  Lab other({2, 2, 0});
  const BodyId made = other.add(want);
  BodyDef read, expected;
  ASSERT_OK(get_body_def(lab.world, id, read));
  ASSERT_OK(get_body_def(other.world, made, expected));
  expect_same(read, expected);
  Shape shape;
  Material material;
  Real linear{}, angular{}, gravity_scale{};
  BodyType type{};
  uint32_t locks = 0;
  ASSERT_OK(get_shape(lab.world, id, shape));
  ASSERT_OK(get_material(lab.world, id, material));
  ASSERT_OK(get_damping(lab.world, id, linear, angular));
  ASSERT_OK(get_gravity_scale(lab.world, id, gravity_scale));
  ASSERT_OK(get_type(lab.world, id, type));
  ASSERT_OK(get_rotation_locks(lab.world, id, locks));
  expect_same(shape, want.shape);
  expect_near(material.friction, want.material.friction);
  expect_near(angular, want.angular_damping);
  expect_near(linear, want.linear_damping);
  expect_near(gravity_scale, want.gravity_scale);
  EXPECT_EQ(type, BodyType::dynamic);
  EXPECT_EQ(locks, want.rotation_locks);
  expect_sound(lab);
}

DETENT_TEST(access, a_body_that_becomes_fixed_stops_and_has_its_mass_when_it_is_dynamic_again) {
  Lab lab({2, 2, 0});
  BodyDef def = unusual_body();
  def.rotation_locks = 0;
  const BodyId id = lab.add(def);
  ASSERT_OK(set_type(lab.world, id, BodyType::kinematic));
  const Motion carried = lab.motion(id);
  EXPECT_NEAR(carried.linear_velocity[2], 3, 1e-6);
  EXPECT_NEAR(carried.angular_velocity[2], -1, 1e-5);
  expect_sound(lab);
  Scaled mass{};
  ASSERT_OK(get_mass(lab.world, id, mass));
  EXPECT_EQ(scaled_to_host(mass), 0);
  ASSERT_OK(set_type(lab.world, id, BodyType::dynamic));
  EXPECT_NEAR(lab.motion(id).angular_velocity[0], 0.5, 1e-5);
  ASSERT_OK(set_type(lab.world, id, BodyType::fixed));
  expect_sound(lab);
  EXPECT_EQ(lab.motion(id).linear_velocity[2], 0);
  EXPECT_EQ(lab.motion(id).angular_velocity[0], 0);
  EXPECT_EQ(apply_impulse(lab.world, id, scaleds(1, 0, 0)), Status::bad_argument);
  ASSERT_OK(set_type(lab.world, id, BodyType::dynamic));
  ASSERT_OK(get_mass(lab.world, id, mass));
  EXPECT_NEAR(scaled_to_host(mass), 12.5, 1e-5);
  expect_sound(lab);
}

DETENT_TEST(access, a_body_made_fixed_gets_the_mass_of_water_or_the_one_it_was_given) {
  Lab lab({2, 2, 0});
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = box(reals(0.5, 0.5, 0.5));
  const BodyId water = lab.add(def);
  def.mass = scaled(3);
  def.position = position(5, 0, 0);
  const BodyId given = lab.add(def);
  expect_sound(lab);
  ASSERT_OK(set_type(lab.world, water, BodyType::dynamic));
  ASSERT_OK(set_type(lab.world, given, BodyType::dynamic));
  Scaled mass{};
  ASSERT_OK(get_mass(lab.world, water, mass));
  EXPECT_NEAR(scaled_to_host(mass), 1000, 1e-3);
  ASSERT_OK(get_mass(lab.world, given, mass));
  EXPECT_NEAR(scaled_to_host(mass), 3, 1e-6);
  ASSERT_OK(set_density(lab.world, given, scaled(7)));
  ASSERT_OK(get_mass(lab.world, given, mass));
  EXPECT_NEAR(scaled_to_host(mass), 7, 1e-5);
  expect_sound(lab);
}

DETENT_TEST(access, what_a_sleeper_rests_on_can_be_let_go) {
  Still still;
  EXPECT_EQ(get_info(still.lab.world).contacts, 1u);
  ASSERT_OK(set_type(still.lab.world, still.slab, BodyType::dynamic));
  EXPECT_EQ(get_info(still.lab.world).contacts, 0u);
  EXPECT_TRUE(still.awake());
  expect_sound(still.lab);
  still.lab.run(30);
  EXPECT_LT(still.lab.motion(still.box).position[1], 0.25);
  EXPECT_LT(still.lab.motion(still.slab).position[1], -0.5);
}

DETENT_TEST(access, a_sleeper_that_becomes_fixed_wakes_those_on_it_and_holds) {
  Lab lab({4, 8, 0}, {}, true);
  lab.add_ground();
  const BodyId low = lab.add_box(0.5, 0, 0.5, 0), high = lab.add_box(0.5, 0, 1.5, 0);
  lab.run(200);
  bool awake = true;
  ASSERT_OK(is_awake(lab.world, high, awake));
  EXPECT_FALSE(awake);
  ASSERT_OK(set_type(lab.world, low, BodyType::fixed));
  ASSERT_OK(is_awake(lab.world, high, awake));
  EXPECT_TRUE(awake);
  expect_sound(lab);
  lab.run(60);
  EXPECT_NEAR(lab.motion(high).position[1], 1.5, 0.02);
}

DETENT_TEST(access, a_shape_can_be_changed_in_motion_and_keeps_speed_and_angular_velocity_and_mass) {
  WorldDef calm;
  calm.gravity = {0.0, 0.0, 0.0};
  Lab lab({2, 2, 0}, calm);
  BodyDef def;
  def.shape = box(reals(0.25, 0.5, 0.25));
  def.linear_velocity = reals(1, 2, 3);
  def.angular_velocity = reals(0, 2, 0);
  const BodyId id = lab.add(def);
  Scaled before{}, after{};
  ASSERT_OK(get_mass(lab.world, id, before));
  ASSERT_OK(apply_torque(lab.world, id, scaleds(0, 30, 0)));
  const double inertia = scaled_to_host(before) * (2.0 / 3) * 4;  // of the cube to come
  ASSERT_OK(set_shape(lab.world, id, box(reals(2, 2, 2))));
  ASSERT_OK(get_mass(lab.world, id, after));
  EXPECT_TRUE(before == after);
  EXPECT_NEAR(lab.motion(id).linear_velocity[2], 3, 1e-6);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 2, 1e-5);
  Vec3<Scaled> moments{};
  ASSERT_OK(get_inertia(lab.world, id, moments));
  EXPECT_NEAR(scaled_to_host(moments.y) / inertia, 1, 1e-6);
  expect_sound(lab);  // a step
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 2 + 30.0 / 60 / inertia, 1e-5)
      << "the torque that was applied still acts";
}

DETENT_TEST(access, a_shape_that_grows_under_a_sleeper_lifts_it) {
  Still still;
  ASSERT_OK(set_shape(still.lab.world, still.slab, box(reals(2, 0.5, 2))));
  EXPECT_TRUE(still.awake());
  expect_sound(still.lab);
  still.lab.run(120);
  EXPECT_GT(still.lab.motion(still.box).position[1], 0.8);
}

DETENT_TEST(access, a_heavier_body_keeps_its_speed_and_is_pushed_less) {
  Lab lab({2, 2, 0});
  BodyDef def;
  def.mass = scaled(1);
  def.linear_velocity = reals(4, 0, 0);
  def.angular_velocity = reals(0, 3, 0);
  const BodyId id = lab.add(def);
  ASSERT_OK(set_mass(lab.world, id, scaled(8)));
  EXPECT_EQ(lab.motion(id).linear_velocity[0], 4);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 3, 1e-5);
  ASSERT_OK(apply_impulse(lab.world, id, scaleds(8, 0, 0)));
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], 5, 1e-6);
  expect_sound(lab);
}

DETENT_TEST(access, an_inertia_that_is_set_turns_the_body_and_goes_with_its_mass) {
  WorldDef calm;
  calm.gravity = {0.0, 0.0, 0.0};
  Lab lab({2, 2, 0}, calm);
  BodyDef def;  // a ball of 1/2 m: its unit is 1 m
  def.mass = scaled(2);
  def.angular_velocity = reals(0, 3, 0);
  const BodyId id = lab.add(def);
  Vec3<Scaled> moments{};
  ASSERT_OK(set_inertia(lab.world, id, scaleds(0.5, 0.25, 1)));
  ASSERT_OK(get_inertia(lab.world, id, moments));
  EXPECT_NEAR(scaled_to_host(moments.y), 0.25, 1e-9);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 3, 1e-6) << "the angular velocity stays";
  ASSERT_OK(apply_angular_impulse(lab.world, id, scaleds(0, 0.5, 0)));
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 5, 1e-6);
  expect_sound(lab);  // it is loaded from its snapshot, among others
  ASSERT_OK(set_mass(lab.world, id, scaled(4)));
  ASSERT_OK(get_inertia(lab.world, id, moments));
  EXPECT_NEAR(scaled_to_host(moments.z), 2, 1e-8);
  ASSERT_OK(set_shape(lab.world, id, sphere(real(0.5))));
  ASSERT_OK(get_inertia(lab.world, id, moments));
  EXPECT_NEAR(scaled_to_host(moments.z), 0.4 * 4 * 0.25, 1e-8) << "of the shape again";
}

DETENT_TEST(access, an_inertia_that_no_body_can_have_is_refused) {
  Lab lab({2, 2, 0});
  BodyDef def;
  def.mass = scaled(2);
  def.rotation_locks = k_rotation_lock_x;
  const BodyId id = lab.add(def), ground = lab.add_ground();
  const uint64_t before = digest(lab.world);
  EXPECT_EQ(set_inertia(lab.world, id, scaleds(1, 0, 1)), Status::out_of_range);
  EXPECT_EQ(set_inertia(lab.world, id, scaleds(1, -1, 1)), Status::out_of_range);
  EXPECT_EQ(set_inertia(lab.world, id, scaleds(1, 2.5, 1)), Status::out_of_range) << "beyond mass x (1 m)^2";
  EXPECT_EQ(set_inertia(lab.world, id, scaleds(1, 2 * 0x1p-15 * 0.99, 1)), Status::out_of_range);
  EXPECT_EQ(set_inertia(lab.world, ground, scaleds(1, 1, 1)), Status::bad_argument);
  EXPECT_EQ(set_inertia(lab.world, {}, scaleds(1, 1, 1)), Status::bad_id);
  EXPECT_EQ(digest(lab.world), before);
  EXPECT_OK(set_inertia(lab.world, id, scaleds(1, 1, 1)));
  Vec3<Scaled> moments{};
  ASSERT_OK(get_inertia(lab.world, id, moments));
  EXPECT_EQ(scaled_to_host(moments.x), 0) << "it stays locked";
}

DETENT_TEST(access, settings_of_a_body_act_on_what_sleeps_against_it) {
  WorldDef slope;
  slope.gravity = reals(3, -9.81, 0);
  Lab lab({4, 8, 0}, slope, true);
  const BodyId ground = lab.add_ground();
  const BodyId id = lab.add_box(0.5, 0, 0.5, 0);
  lab.run(120);
  EXPECT_NEAR(lab.motion(id).position[0], 0, 0.02);
  ASSERT_OK(set_material(lab.world, ground, {real(0), real(0), real(0), RestitutionRule::larger}));
  lab.run(60);
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], 3, 0.1);
  ASSERT_OK(set_damping(lab.world, id, real(1000), real(0)));
  lab.run(1);
  EXPECT_LT(lab.motion(id).linear_velocity[0], 0.3);
  ASSERT_OK(set_gravity_scale(lab.world, id, real(-1)));
  ASSERT_OK(set_damping(lab.world, id, real(0), real(0)));
  lab.run(60);
  EXPECT_GT(lab.motion(id).position[1], 4);
}

DETENT_TEST(access, a_point_of_a_turning_body_has_its_velocity) {
  Lab lab({1, 1, 0});
  BodyDef def;
  def.shape = sphere(real(1));
  def.linear_velocity = reals(1, 0, 0);
  def.angular_velocity = reals(0, 0, 2);
  const BodyId id = lab.add(def);
  Vec3<Real> linear_velocity = {};
  ASSERT_OK(get_velocity_at(lab.world, id, reals(0, 1.5, 0), linear_velocity));
  EXPECT_NEAR(real_to_host(linear_velocity.x), 1 - 3, 1e-5);
  ASSERT_OK(get_velocity_at(lab.world, id, reals(1, 0, 0), linear_velocity));
  EXPECT_NEAR(real_to_host(linear_velocity.y), 2, 1e-5);
  EXPECT_EQ(get_velocity_at(lab.world, id, reals(2.5, 0, 0), linear_velocity), Status::out_of_range);
}

DETENT_TEST(access, bad_arguments_get_their_status_and_change_nothing) {
  Lab lab({3, 4, 0});
  const BodyId ground = lab.add_ground();
  const BodyId id = lab.add_box(0.5, 0, 0.5, 0);
  BodyDef wheel;
  wheel.type = BodyType::kinematic;
  wheel.angular_velocity = reals(0, 1, 0);
  wheel.position = position(5, 5, 5);
  const BodyId spinning = lab.add(wheel);
  lab.run(5);
  const uint64_t before = digest(lab.world);
  World& world = lab.world;
  const BodyId none[] = {{}, {4, 1}, {id.slot, id.generation + 1}};
  BodyDef def;
  Shape shape;
  Material material;
  for (const BodyId bad : none) {
    EXPECT_EQ(set_type(world, bad, BodyType::fixed), Status::bad_id);
    EXPECT_EQ(set_shape(world, bad, shape), Status::bad_id);
    EXPECT_EQ(set_mass(world, bad, scaled(1)), Status::bad_id);
    EXPECT_EQ(set_density(world, bad, scaled(1)), Status::bad_id);
    EXPECT_EQ(set_material(world, bad, material), Status::bad_id);
    EXPECT_EQ(set_damping(world, bad, real(1), real(1)), Status::bad_id);
    EXPECT_EQ(set_gravity_scale(world, bad, real(1)), Status::bad_id);
    EXPECT_EQ(set_rotation_locks(world, bad, 1), Status::bad_id);
    EXPECT_EQ(get_body_def(world, bad, def), Status::bad_id);
    EXPECT_EQ(get_shape(world, bad, shape), Status::bad_id);
  }
  EXPECT_EQ(set_type(world, id, static_cast<BodyType>(0)), Status::bad_argument);
  EXPECT_EQ(set_type(world, id, static_cast<BodyType>(4)), Status::bad_argument);
  EXPECT_EQ(set_type(world, ground, BodyType::dynamic), Status::bad_argument);
  EXPECT_EQ(set_shape(world, id, half_space()), Status::bad_argument);
  EXPECT_EQ(set_shape(world, spinning, half_space()), Status::bad_argument);
  EXPECT_EQ(set_shape(world, id, sphere(real(-1))), Status::out_of_range);
  EXPECT_EQ(set_shape(world, id, hull(0)), Status::out_of_range);
  EXPECT_EQ(set_mass(world, id, scaled(0)), Status::out_of_range);
  EXPECT_EQ(set_mass(world, id, scaled(-1)), Status::out_of_range);
  EXPECT_EQ(set_density(world, id, scaled(0)), Status::out_of_range);
  EXPECT_EQ(set_density(world, ground, scaled(1)), Status::bad_argument);
  EXPECT_EQ(set_material(world, id, {real(-1), real(0), real(0), RestitutionRule::larger}), Status::out_of_range);
  EXPECT_EQ(set_material(world, id, {real(1), real(0), real(0), static_cast<RestitutionRule>(2)}),
            Status::bad_argument);
  EXPECT_EQ(set_damping(world, id, real(1), real(-1)), Status::out_of_range);
  EXPECT_EQ(set_damping(world, id, real(1025), real(1)), Status::out_of_range);
  EXPECT_EQ(set_gravity_scale(world, id, real(1025)), Status::out_of_range);
  EXPECT_EQ(set_rotation_locks(world, id, 8), Status::bad_argument);
  WorldDef settings = get_settings(world);
  settings.tick = real(1);
  EXPECT_EQ(set_settings(world, settings), Status::out_of_range);
  settings = get_settings(world);
  settings.stabilisation = static_cast<Stabilisation>(0);
  EXPECT_EQ(set_settings(world, settings), Status::bad_argument);
  EXPECT_EQ(digest(world), before);
}

DETENT_TEST(access, a_shape_is_refused_where_its_code_or_its_bytes_are_missing) {
  static WorldStorage<Capacity{2, 2, 2}> storage;
  const Asset assets[] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
  World world;
  WorldDef def;
  def.continuous = def.sleeping = false;
  ASSERT_OK(storage.create(def, {.assets = {assets, 2}}, feature_table<Features::sphere | Features::hull>, world));
  BodyId id;
  ASSERT_OK(create_body(world, {}, id));
  ASSERT_OK(bind_asset(world, 1));
  const uint64_t before = digest(world);
  EXPECT_EQ(set_shape(world, id, box(reals(1, 1, 1))), Status::feature_missing);
  EXPECT_EQ(set_shape(world, id, rounded(hull(1), real(0.1))), Status::feature_missing);
  EXPECT_EQ(set_shape(world, id, hull(0)), Status::asset_missing);
  EXPECT_EQ(set_shape(world, id, hull(2)), Status::out_of_range);
  EXPECT_EQ(digest(world), before);
  ASSERT_OK(set_shape(world, id, hull(1)));
  Shape shape;
  ASSERT_OK(get_shape(world, id, shape));
  EXPECT_EQ(shape.type, ShapeType::hull);
  EXPECT_EQ(shape.asset, 1u);
  Scaled mass{};
  ASSERT_OK(set_density(world, id, scaled(1)));
  ASSERT_OK(get_mass(world, id, mass));
  ASSERT_OK(set_type(world, id, BodyType::fixed));
  ASSERT_OK(set_type(world, id, BodyType::dynamic));
  Scaled again{};
  ASSERT_OK(get_mass(world, id, again));
  EXPECT_TRUE(mass == again);
  EXPECT_EQ(bind_asset(world, 0), Status::ok);
}

DETENT_TEST(access, a_fast_angular_velocity_that_a_larger_shape_cannot_have_is_refused) {
  Lab lab({1, 1, 0});
  BodyDef def;
  def.shape = sphere(real(0.25));
  def.angular_velocity = reals(0, 30000, 0);
  const BodyId id = lab.add(def);
  const uint64_t before = digest(lab.world);
  EXPECT_EQ(set_shape(lab.world, id, sphere(real(1000))), Status::out_of_range);
  EXPECT_EQ(digest(lab.world), before);
  ASSERT_OK(set_shape(lab.world, id, sphere(real(0.125))));
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 30000, 0.1);
}

DETENT_TEST(access, settings_read_back_create_the_same_world) {
  WorldDef def;
  def.capacity = {2, 4, 1, true};
  def.gravity = reals(1, 2, 3);
  def.tick = real(0.01);
  def.substeps = 5;
  def.substeps_max = 20;
  def.resting_penetration = real(1.0 / 32);
  def.iterations = 2;
  def.convergence = 9;
  def.stabilisation = Stabilisation::post;
  def.relaxation = real(1.25);
  def.contact_frequency = real(0.125);
  def.damping_ratio = real(3);
  def.restitution_threshold = real(0.5);
  def.continuous = false;
  def.sleeping = false;
  def.contact_margin = real(0.03125);
  def.contact_recycle_distance = real(0.0078125);
  def.reduction = ManifoldReduction::deepest_area;
  Lab lab(def.capacity, def);
  Lab again(def.capacity, get_settings(lab.world)), changed(def.capacity);
  EXPECT_EQ(digest(lab.world), digest(again.world));
  EXPECT_NE(digest(lab.world), digest(changed.world));
  ASSERT_OK(set_settings(changed.world, get_settings(lab.world)));
  EXPECT_EQ(digest(lab.world), digest(changed.world));
}

DETENT_TEST(access, settings_change_in_the_middle_of_a_pile) {
  Lab lab = make_pile();
  const WorldDef first = get_settings(lab.world);
  for (const double tick : {1.0 / 240, 1.0 / 30, 1.0 / 60}) {
    WorldDef def = first;
    def.tick = real(tick);
    def.contact_recycle_distance = tick < 0.01 ? real(0) : first.contact_recycle_distance;
    def.substeps = tick < 0.01 ? 4 : 0;
    def.stabilisation = tick > 0.02 ? Stabilisation::post : Stabilisation::soft;
    ASSERT_OK(set_settings(lab.world, def));
    expect_sound(lab);
    lab.run(60);
    expect_sound(lab);
  }
  BodyId id = next_body(lab.world, {});
  for (int i = 0; i < 4; ++i) {
    id = next_body(lab.world, id);
    EXPECT_NEAR(lab.motion(id).position[1], 0.5 + i, 0.05);
  }
}

DETENT_TEST(access, settings_that_a_world_cannot_do_are_refused_and_others_wake_it) {
  static WorldStorage<Capacity{2, 2, 0}> storage;
  World world;
  WorldDef def;
  def.continuous = def.sleeping = false;
  ASSERT_OK(storage.create(def, {}, feature_table<Features::sphere>, world));
  def.sleeping = true;
  EXPECT_EQ(set_settings(world, def), Status::feature_missing);
  Still still;
  ASSERT_OK(set_settings(still.lab.world, get_settings(still.lab.world)));
  EXPECT_TRUE(still.awake());
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
