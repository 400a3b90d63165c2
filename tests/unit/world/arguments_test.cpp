#include <limits>

#include "tests/unit/world/lab.h"

/// Every bad argument gets its status and changes nothing.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Status try_create(BodyDef def) {
  Lab lab({2, 2, 0});
  const uint64_t before = digest(lab.world);
  BodyId id = {5, 6};
  const Status status = create_body(lab.world, def, id);
  if (status != Status::ok) {
    EXPECT_EQ(digest(lab.world), before);
    EXPECT_EQ(id, (BodyId{5, 6}));
  }
  return status;
}

template <class Change>
Status try_changed(const Change& change) {
  BodyDef def;
  change(def);
  return try_create(def);
}

/// Numbers outside every range of the configuration, as far as its types can hold them.
std::vector<Real> wild_numbers() {
#if DETENT_FIXED
  return {Real::from_raw(INT64_MAX), Real::from_raw(INT64_MIN), Real::from_raw(INT64_MIN + 1)};
#else
  using Limits = std::numeric_limits<Real>;
  return {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(), Limits::lowest()};
#endif
}

DETENT_TEST(arguments, a_default_body_is_accepted) { EXPECT_OK(try_create(BodyDef{})); }

DETENT_TEST(arguments, numbers_that_are_none_are_refused_in_every_field) {
  for (const Real wild : wild_numbers()) {
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.linear_velocity.x = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.linear_velocity.z = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.angular_velocity.y = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = sphere(wild); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = box({real(1), wild, real(1)}); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = capsule(real(1), wild); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = capsule(wild, real(1)); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.material.friction = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.material.restitution = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.material.rolling_resistance = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.linear_damping = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.angular_damping = wild; }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.gravity_scale = wild; }), Status::out_of_range);
  }
#if !DETENT_FIXED
  const Unit nan = std::numeric_limits<Unit>::quiet_NaN();
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.rotation.x = nan; }), Status::not_normalised);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = nan; }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.density = nan; }), Status::out_of_range);
#endif
#if defined(DETENT_F64)
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.position.x = nan; }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.position.z = 1e300; }), Status::out_of_range);
#endif
}

DETENT_TEST(arguments, sizes_of_zero_or_less_are_refused) {
  for (const double size : {0.0, -1.0, 1e-6, 20000.0}) {
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = sphere(real(size)); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = box(reals(1, 1, size)); }), Status::out_of_range);
    EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = capsule(real(size), real(1)); }), Status::out_of_range);
  }
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = capsule(real(1), real(-1)); }), Status::out_of_range);
  EXPECT_OK(try_changed([&](BodyDef& d) { d.shape = capsule(real(1), real(0)); }));
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = box(reals(0.001, 100, 100)); }), Status::out_of_range);
}

DETENT_TEST(arguments, a_rod_however_slender_has_an_inertia) {
  for (const BodyType type : {BodyType::dynamic, BodyType::kinematic}) {
    EXPECT_OK(try_changed([&](BodyDef& d) {
      d.shape = box(reals(16.32, 0.0010061, 0.0010061));
      d.type = type;
    }));
  }
}

DETENT_TEST(arguments, masses_of_zero_or_less_are_refused) {
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = scaled(-1); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.density = scaled(0); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.density = scaled(-1000); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = scaled(1e-30); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = scaled(1e30); }), Status::out_of_range);
#if DETENT_FIXED
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = Scaled::from_parts(3, 0); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = Scaled::from_parts(INT32_MIN, 0); }), Status::out_of_range);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.mass = Scaled::from_parts(0, 5); }), Status::out_of_range);
#endif
}

DETENT_TEST(arguments, a_rotation_must_be_of_unit_length) {
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.rotation = {0.0, 0.0, 0.0, 0.0}; }), Status::not_normalised);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.rotation = {0.5, 0.0, 0.0, 1.0}; }), Status::not_normalised);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.rotation = {0.0, 0.0, 0.0, 0.99}; }), Status::not_normalised);
  EXPECT_OK(try_changed([&](BodyDef& d) { d.rotation = {0.0, 0.0, 0.0, 1.0005}; }));
  EXPECT_OK(try_changed([&](BodyDef& d) { d.rotation = {0.5, -0.5, 0.5, -0.5}; }));
}

DETENT_TEST(arguments, kinds_outside_their_list_are_refused) {
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.type = static_cast<BodyType>(0); }), Status::bad_argument);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.type = static_cast<BodyType>(4); }), Status::bad_argument);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape.type = static_cast<ShapeType>(0); }), Status::bad_argument);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape.type = static_cast<ShapeType>(99); }), Status::bad_argument);
  EXPECT_EQ(try_changed([&](BodyDef& d) { d.shape = half_space(); }), Status::bad_argument);
  EXPECT_EQ(try_changed([&](BodyDef& d) {
              d.type = BodyType::fixed;
              d.linear_velocity = reals(1, 0, 0);
            }),
            Status::bad_argument);
}

DETENT_TEST(arguments, calls_refuse_what_would_leave_the_range_and_change_nothing) {
  Lab lab({2, 2, 0});
  const BodyId id = lab.add_box(0.5, 0, 0, 0);
  BodyDef wall;
  wall.type = BodyType::fixed;
  const BodyId fixed = lab.add(wall);
  const uint64_t before = digest(lab.world);
  for (const Real wild : wild_numbers()) {
    EXPECT_EQ(set_velocity(lab.world, id, {wild, wild, wild}, reals(0, 0, 0)), Status::out_of_range);
    EXPECT_EQ(set_velocity(lab.world, id, reals(0, 0, 0), {wild, wild, wild}), Status::out_of_range);
    EXPECT_EQ(set_gravity(lab.world, {wild, wild, wild}), Status::out_of_range);
    EXPECT_EQ(apply_impulse_at(lab.world, id, scaleds(1, 0, 0), {wild, wild, wild}), Status::out_of_range);
  }
  EXPECT_EQ(apply_force(lab.world, id, scaleds(1e15, 0, 0)), Status::out_of_range);
  EXPECT_EQ(apply_torque(lab.world, id, scaleds(0, 1e15, 0)), Status::out_of_range);
  EXPECT_EQ(apply_impulse(lab.world, id, scaleds(0, 0, -1e15)), Status::out_of_range);
  EXPECT_EQ(apply_angular_impulse(lab.world, id, scaleds(1e15, 0, 0)), Status::out_of_range);
  EXPECT_EQ(set_pose(lab.world, id, position(0, 0, 0), {0.0, 0.0, 0.0, 0.0}), Status::not_normalised);
  EXPECT_EQ(apply_force(lab.world, fixed, scaleds(1, 0, 0)), Status::bad_argument);
  EXPECT_EQ(set_velocity(lab.world, fixed, reals(1, 0, 0), reals(0, 0, 0)), Status::bad_argument);
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(arguments, a_world_needs_its_block_and_sound_settings) {
  alignas(8) static uint8_t block[8192];
  World world;
  const auto make = [&](const auto& change) {
    WorldDef def;
    def.capacity = {2, 2, 0};
    change(def);
    return create_world(block, sizeof block, def, {}, world);
  };
  EXPECT_OK(make([](WorldDef&) {}));
  EXPECT_EQ(make([](WorldDef& d) { d.capacity.bodies = 0; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.capacity.contacts = k_capacity_max + 1; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.capacity.bodies = 1000; }), Status::buffer_too_small);
  EXPECT_EQ(make([](WorldDef& d) { d.substeps_max = 0; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.substeps_max = 65; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.resting_penetration = real(0); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.resting_penetration = real(0.25); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.substeps = 65; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.iterations = 0; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.tick = real(0); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.tick = real(1); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.relaxation = real(2); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.contact_frequency = real(0.5); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.gravity = reals(0, 2000, 0); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.convergence = 31; }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.stabilisation = static_cast<Stabilisation>(3); }), Status::bad_argument);
  EXPECT_EQ(make([](WorldDef& d) { d.contact_recycle_distance = real(-0.001); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.contact_recycle_distance = real(0.016); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.contact_margin = real(0); }), Status::out_of_range);
  EXPECT_EQ(make([](WorldDef& d) { d.contact_margin = real(0.07); }), Status::out_of_range);
  EXPECT_OK(make([](WorldDef& d) { d.capacity.manifolds = false; }));
  EXPECT_OK(make([](WorldDef& d) { d.reduction = ManifoldReduction::deepest_area; }));
  EXPECT_EQ(make([](WorldDef& d) { d.reduction = static_cast<ManifoldReduction>(0); }), Status::bad_argument);
  EXPECT_EQ(make([](WorldDef& d) { d.reduction = static_cast<ManifoldReduction>(3); }), Status::bad_argument);
  WorldDef def;
  def.capacity = {2, 2, 0};
  EXPECT_EQ(create_world(block + 4, sizeof block - 4, def, {}, world), Status::buffer_misaligned);
  EXPECT_EQ(create_world(nullptr, 0, def, {}, world), Status::buffer_too_small);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
