#include <detent/body.h>
#include <detent/contact.h>
#include <detent/event.h>
#include <detent/numbers.h>
#include <detent/query.h>
#include <detent/world.h>
#include <math.h>

#include "shape/compound.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/shape/compounds.h"
#include "tests/unit/world/lab.h"

/// Bodies made of several convex shapes.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_compounds::Parts;
using detent_terrains::Bytes;

/// A world whose asset 0 is a compound and, if one is given, whose asset 1 is a terrain.
class CompoundLab : public Lab {
 public:
  explicit CompoundLab(const Parts& parts, WorldDef def = {}, bool sleeping = false)
      : CompoundLab(parts, Bytes({}), def, sleeping) {}
  CompoundLab(const Parts& parts, const Bytes& terrain, WorldDef def = {}, bool sleeping = false,
              uint32_t contacts = 256)
      : Lab({32, contacts, 2}, def, sleeping), compound_(detent_compounds::cooked(parts)), terrain_(terrain) {
    assets_[0] = {compound_.data(), compound_.count()};
    assets_[1] = {terrain_.data(), terrain_.count()};
    const bool has_terrain = terrain_.count() != 0;
    world.hooks.assets = {assets_, has_terrain ? 2u : 1u};
    EXPECT_OK(bind_asset(world, 0));
    if (has_terrain) {
      EXPECT_OK(bind_asset(world, 1));
    }
    EXPECT_OK(compound_info(assets_[0], info));
  }
  /// A definition of the compound with the origin of its source frame at (x, y, z), unrotated.
  BodyDef compound_def(double x, double y, double z) const {
    BodyDef def;
    def.shape = compound(0);
    def.position = position(x + info.origin[0], y + info.origin[1], z + info.origin[2]);
    def.rotation = {unit(ldexp(info.rotation[0], -30)), unit(ldexp(info.rotation[1], -30)),
                    unit(ldexp(info.rotation[2], -30)), unit(ldexp(info.rotation[3], -30))};
    return def;
  }
  /// Adds a box whose top is at y = 0.
  void add_floor(double half) {
    BodyDef floor;
    floor.type = BodyType::fixed;
    floor.shape = box(reals(half, 0.5, half));
    floor.position = position(0, -0.5, 0);
    add(floor);
  }
  BodyId add_compound(double x, double y, double z) { return add(compound_def(x, y, z)); }

  /// The rotational energy over the mass, J/kg.
  double turning_energy(BodyId id) {
    Pose pose;
    Vec3<Real> linear_velocity, angular_velocity;
    EXPECT_OK(get_pose(world, id, pose));
    EXPECT_OK(get_velocity(world, id, linear_velocity, angular_velocity));
    const Vec3<Real> local = vector_to_local(pose.rotation, angular_velocity);
    const double turns[3] = {real_to_host(local.x), real_to_host(local.y), real_to_host(local.z)};
    const CompoundView view = compound_view(compound_.data());
    double energy = 0;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const HullScaled inverse_inertia = view.inverse_inertia(axis);
      energy += turns[axis] * turns[axis] / 2 * ldexp(1, 2 * view.exponent() - inverse_inertia.exponent) /
                inverse_inertia.mantissa;
    }
    return energy;
  }

  CompoundInfo info;

 private:
  Bytes compound_, terrain_;
  Asset assets_[2];
};

double speed_of(const Motion& motion) {
  return hypot(hypot(motion.linear_velocity[0], motion.linear_velocity[1]), motion.linear_velocity[2]) +
         hypot(hypot(motion.angular_velocity[0], motion.angular_velocity[1]), motion.angular_velocity[2]);
}

DETENT_TEST(compounds, rest_on_their_feet) {
  for (const Parts& parts : {detent_compounds::letter_l(), detent_compounds::table()}) {
    CompoundLab lab(parts, {}, true);
    lab.add_ground();
    const BodyId id = lab.add_compound(0, 0.05, 0);
    for (int tick = 0; tick < 240; ++tick) EXPECT_TRUE(lab.run(1).complete()) << tick;
    const Motion motion = lab.motion(id);
    EXPECT_NEAR(motion.position[0], lab.info.origin[0], 2e-3);
    EXPECT_NEAR(motion.position[1], lab.info.origin[1], 2e-3);
    EXPECT_NEAR(motion.position[2], lab.info.origin[2], 2e-3);
    bool awake = true;
    EXPECT_OK(is_awake(lab.world, id, awake));
    EXPECT_FALSE(awake);
  }
}

DETENT_TEST(compounds, stand_on_each_other_and_on_boxes) {
  CompoundLab lab(detent_compounds::table());
  lab.add_ground();
  std::vector<BodyId> ids;
  for (int i = 0; i < 3; ++i) ids.push_back(lab.add_compound(0, 1.0 * i, 0));
  const BodyId on_top = lab.add_box(0.25, 0.3, 3.25, 0.2);
  const BodyId under = lab.add_box(0.25, 0.2, 0.25, 0.1);
  lab.run(300);
  for (size_t i = 0; i < ids.size(); ++i) {
    const Motion motion = lab.motion(ids[i]);
    EXPECT_NEAR(motion.position[1], static_cast<double>(i) + lab.info.origin[1], 0.02) << i;
    EXPECT_LT(speed_of(motion), 0.02) << i;
  }
  EXPECT_NEAR(lab.motion(on_top).position[1], 3.25, 0.02);
  EXPECT_NEAR(lab.motion(under).position[1], 0.25, 0.01);
}

/// The same box as a box and as a compound, side by side. It tumbles, so small differences between the two collision
/// functions grow at each impact of an edge.
DETENT_TEST(compounds, of_one_box_behave_as_it_does) {
  CompoundLab lab({detent_compounds::box({0, 0, 0}, {0.5, 0.25, 0.3})});
  lab.add_ground();
  BodyDef def = lab.compound_def(0, 1.5, 0);
  def.linear_velocity = reals(0.5, 0, 0.2);
  def.angular_velocity = reals(0.3, 1, -0.2);
  const BodyId one = lab.add(def);
  def.shape = box(reals(0.5, 0.25, 0.3));
  def.position = position(20, 1.5, 0);
  const BodyId other = lab.add(def);
  Scaled mass_one, mass_other;
  EXPECT_OK(get_mass(lab.world, one, mass_one));
  EXPECT_OK(get_mass(lab.world, other, mass_other));
  EXPECT_NEAR(scaled_to_host(mass_one) / scaled_to_host(mass_other), 1, 1e-6);
  for (int tick = 0; tick < 30; ++tick) {
    lab.run(1);
    const Motion a = lab.motion(one), b = lab.motion(other);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.position[k] + (k == 0 ? 20 : 0), b.position[k], 1e-3) << tick;
  }
  lab.run(270);
  EXPECT_NEAR(lab.motion(one).position[1], lab.motion(other).position[1], 1e-3);
  EXPECT_LT(speed_of(lab.motion(one)), 1e-3);
}

DETENT_TEST(compounds, turn_freely_without_losing_energy) {
  CompoundLab lab(detent_compounds::letter_l(), weightless());
  BodyDef def = lab.compound_def(0, 0, 0);
  def.angular_velocity = reals(3, 0.5, 4);
  const BodyId id = lab.add(def);
  const double before = lab.turning_energy(id);
  lab.run(1200);
  EXPECT_GT(before, 1);
  EXPECT_NEAR(lab.turning_energy(id) / before, 1, 1e-3);
}

DETENT_TEST(compounds, of_two_balls_roll) {
  CompoundLab lab(detent_compounds::dumbbell());
  lab.add_ground();
  BodyDef def = lab.compound_def(0, 0.5, 0);
  def.linear_velocity = reals(0, 0, 2);
  def.angular_velocity = reals(4, 0, 0);
  const BodyId id = lab.add(def);
  lab.run(240);
  const Motion motion = lab.motion(id);
  EXPECT_NEAR(motion.position[2], 8, 0.05);
  EXPECT_NEAR(motion.position[1], 0.5, 2e-3);
  EXPECT_NEAR(motion.linear_velocity[2], 2, 0.02);
  EXPECT_NEAR(motion.angular_velocity[0], 4, 0.05);
  EXPECT_EQ(get_info(lab.world).contacts, 1u);
}

/// Compounds are dropped into a bowl of triangles, fast and rotating.
DETENT_TEST(compounds, never_fall_through_a_mesh) {
  const Bytes bowl = detent_terrains::cooked(
      detent_terrains::ground(16, 0.5, [](double x, double z) { return 0.15 * (x * x + z * z); }));
  const Parts kinds[] = {detent_compounds::jack(0.4, 0.1), detent_compounds::letter_l()};
  for (const Parts& parts : kinds) {
    CompoundLab lab(parts, bowl);
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = terrain(1);
    lab.add(ground);
    detent_queries::Random random(5);
    const uint32_t rounds = detent_oracle::rounds(50);
    for (uint32_t round = 0; round < rounds; ++round) {
      const double x = random.uniform(-1, 1), z = random.uniform(-1, 1), angular_velocity = random.uniform(-20, 20);
      const double speed = random.uniform(1, 60);
      BodyDef def = lab.compound_def(x, 2.5, z);
      def.linear_velocity = reals(0, -speed, 0);
      def.angular_velocity = reals(angular_velocity, 0.3 * angular_velocity, -angular_velocity);
      const BodyId id = lab.add(def);
      for (int tick = 0; tick < 90; ++tick) {
        lab.run(1);
        const Motion motion = lab.motion(id);
        const double over = motion.position[1] - 0.15 * (pow(motion.position[0], 2) + pow(motion.position[2], 2));
        const bool inside = hypot(motion.position[0], motion.position[2]) < 3;
        if (inside) {
          ASSERT_GT(over, 0) << round << ", " << tick;
        }
      }
      EXPECT_OK(destroy_body(lab.world, id));
    }
  }
}

/// One part may separate from a wall that it touches while another part moves into the wall. If a compound leaves the
/// room, the report says so: a part was already deep in the wall. This happens once in 3,000 throws.
DETENT_TEST(compounds, never_leave_a_closed_room_in_silence) {
  uint32_t thrown = 0, left = 0;
  const Parts kinds[] = {detent_compounds::letter_l(), detent_compounds::table(), detent_compounds::dumbbell()};
  for (const Parts& parts : kinds) {
    CompoundLab lab(parts, detent_terrains::cooked(detent_terrains::box_terrain(8, 6, 7, 4)));
    BodyDef room;
    room.type = BodyType::fixed;
    room.shape = terrain(1);
    lab.add(room);
    detent_queries::Random random(23);
    const uint32_t rounds = detent_oracle::rounds(150);
    for (uint32_t round = 0; round < rounds; ++round) {
      BodyDef def = lab.compound_def(0, 0, 0);
      const double speed = random.uniform(50, 500) / sqrt(3.0);
      const auto side = [&] { return random.uniform(-1, 1) < 0 ? -speed : speed; };
      const double x = side(), y = side(), z = side(), angular_velocity = random.uniform(-30, 30);
      def.linear_velocity = reals(x, y, z);
      def.angular_velocity = reals(angular_velocity, 0.5 * angular_velocity, -angular_velocity);
      def.material.restitution = real(0.5);
      const BodyId id = lab.add(def);
      bool inside = true, told = false;
      for (int tick = 0; inside && tick < 40; ++tick) {
        told = lab.run(1).ccd.overlaps_left != 0 || told;
        const Motion motion = lab.motion(id);
        inside = fabs(motion.position[0]) < 8 && fabs(motion.position[1]) < 6 && fabs(motion.position[2]) < 7;
        ASSERT_TRUE(inside || told) << round << ", " << tick;
      }
      ++thrown;
      left += inside ? 0 : 1;
      EXPECT_OK(destroy_body(lab.world, id));
    }
  }
  EXPECT_LE(1000 * left, thrown);
}

/// 5 m a tick.
DETENT_TEST(compounds, let_bullets_through_where_they_are_hollow) {
  for (const bool aimed : {false, true}) {
    for (const bool turning : {false, true}) {
      CompoundLab lab(detent_compounds::table(), weightless());
      BodyDef def = lab.compound_def(0, 0, 0);
      if (turning) def.angular_velocity = reals(0, 0.001, 0);
      const BodyId id = lab.add(def);
      BodyDef bullet;
      bullet.shape = sphere(real(0.03));
      bullet.position = position(-8, 0.45, aimed ? 0.93 : 0.2);
      bullet.linear_velocity = reals(300, 0, 0);
      const BodyId shot = lab.add(bullet);
      lab.run(4);
      const Motion motion = lab.motion(shot), struck = lab.motion(id);
      if (aimed) {
        EXPECT_LT(motion.position[0], -0.9);
        EXPECT_GT(speed_of(struck), 0.01);
      } else {
        EXPECT_NEAR(motion.position[0], 12, 1e-3);
        EXPECT_LT(speed_of(struck), 0.01);
      }
    }
  }
}

/// A table flies against a post that stands between its legs, and against one in front of a leg.
DETENT_TEST(compounds, meet_in_flight_with_the_part_that_is_in_the_way) {
  for (const bool before_leg : {false, true}) {
    CompoundLab lab(detent_compounds::table(), weightless());
    BodyDef post;
    post.type = BodyType::fixed;
    post.shape = box(reals(0.04, 0.2, 0.04));
    post.position = position(12, 0.3, before_leg ? 0.93 : 0);
    lab.add(post);
    BodyDef def = lab.compound_def(0, 0, 0);
    def.linear_velocity = reals(300, 0, 0);
    const BodyId id = lab.add(def);
    lab.run(4);
    const Motion motion = lab.motion(id);
    if (before_leg) {
      EXPECT_LT(motion.linear_velocity[0], 290);
      EXPECT_GT(fabs(motion.angular_velocity[1]), 10);
    } else {
      EXPECT_NEAR(motion.position[0], 20, 1e-3);
      EXPECT_NEAR(motion.linear_velocity[0], 300, 1e-3);
    }
  }
}

DETENT_TEST(compounds, tell_which_parts_touch) {
  CompoundLab lab(detent_compounds::table());
  const BodyId ground = lab.add_ground();
  const BodyId id = lab.add_compound(0, 0, 0);
  lab.run(60);
  ASSERT_EQ(get_info(lab.world).contacts, 1u);
  Contact contact;
  ASSERT_OK(get_contact(lab.world, 0, contact));
  EXPECT_TRUE(contact.a == ground && contact.b == id);
  ASSERT_EQ(contact.point_count, 4u);
  uint32_t legs = 0;
  for (const ContactPoint& point : contact.point) {
    EXPECT_EQ(point.child_a, 0u);
    legs |= 1u << point.child_b;
  }
  EXPECT_EQ(legs, 0b111100u);
}

DETENT_TEST(compounds, that_rest_find_no_contact_anew) {
  CompoundLab lab(detent_compounds::table());
  lab.add_floor(4);
  lab.add_compound(0, 0, 0);
  lab.add_compound(0, 1.3, 0);
  lab.run(60);
  for (int tick = 0; tick < 60; ++tick) {
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.contacts.recycled, report.contacts.count) << tick;
  }
}

DETENT_TEST(compounds, tell_which_children_touch_a_mesh) {
  CompoundLab lab(detent_compounds::table(),
                  detent_terrains::cooked(detent_terrains::ground(8, 1, [](double, double) { return 0.0; })));
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = terrain(1);
  lab.add(ground);
  lab.add_compound(0, 0, 0);
  lab.run(60);
  uint32_t legs = 0;
  for (uint32_t i = 0; i < get_info(lab.world).contacts; ++i) {
    Contact contact;
    ASSERT_OK(get_contact(lab.world, i, contact));
    for (uint32_t k = 0; k < contact.point_count; ++k) {
      EXPECT_EQ(contact.point[k].child_a, 0u);
      legs |= 1u << contact.point[k].child_b;
    }
  }
  EXPECT_EQ(legs, 0b111100u);
}

/// The normal of the plane rotates through the directions of several keys; the contact stays the same.
/// A table slides without friction, so far in a tick that its shrunken parts could pass into the floor.
DETENT_TEST(compounds, that_their_contacts_keep_apart_are_not_searched) {
  CompoundLab lab(detent_compounds::table());
  lab.add_floor(20);
  BodyDef def = lab.compound_def(0, 0, 0);
  def.linear_velocity = reals(1, 0, 0);
  def.material.friction = real(0);
  const BodyId id = lab.add(def);
  uint32_t tests = 0, kept_apart = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const StepReport report = lab.run(1);
    tests += report.ccd.tests;
    kept_apart += report.ccd.kept_apart;
  }
  EXPECT_EQ(tests, 0u);
  EXPECT_GT(kept_apart, 50u);
  EXPECT_NEAR(lab.motion(id).position[0], lab.info.origin[0] + 1, 0.01);
}

DETENT_TEST(compounds, that_tilt_keep_their_contacts) {
  CompoundLab lab(detent_compounds::letter_l());
  BodyDef floor = lab.compound_def(0, 0, 0);
  floor.type = BodyType::kinematic;
  floor.material.friction = real(1);
  floor.angular_velocity = reals(0, 0, 0.2);
  lab.add(floor);
  BodyDef crate;
  crate.shape = box(reals(0.25, 0.25, 0.25));
  crate.position = position(0.3, 0.75, 0);
  crate.material.friction = real(1);
  lab.add(crate);
  for (uint32_t tick = 0; tick < 120; ++tick) {
    lab.run(1);
    ASSERT_EQ(get_info(lab.world).contacts, 1u) << tick;
    Contact contact;
    ASSERT_OK(get_contact(lab.world, 0, contact));
    EXPECT_EQ(contact.age, tick);
    EXPECT_EQ(contact.point_count, 4u) << tick;
  }
}

/// Two planes touch, and one finds no capacity. The next tick must look for it again, although the contact of the other
/// plane is recycled.
DETENT_TEST(compounds, that_lose_a_plane_for_want_of_room_look_for_it_in_each_tick) {
  for (const uint32_t room : {1u, 2u}) {
    WorldDef def;
    def.gravity = reals(-5, -9.81, 0);
    CompoundLab lab(detent_compounds::letter_l(), Bytes({}), def, false, room);
    BodyDef corner = lab.compound_def(0, 0, 0);
    corner.type = BodyType::fixed;
    lab.add(corner);
    BodyDef crate;
    crate.shape = box(reals(0.25, 0.25, 0.25));
    crate.position = position(-0.25, 0.75, 0);
    lab.add(crate);
    for (int tick = 0; tick < 60; ++tick) {
      const StepReport report = lab.run(1);
      EXPECT_EQ(report.lost.contacts, 2 - room) << tick;
      EXPECT_EQ(report.contacts.count, room) << tick;
    }
  }
}

/// Its 37 parts lie on the ground in one plane.
DETENT_TEST(compounds, of_many_pieces_lie_still) {
  Parts wheel = {detent_compounds::box({0, 0, 0}, {0.3, 0.1, 0.3})};
  for (int i = 0; i < 36; ++i) {
    const double angle = 2 * M_PI * i / 36;
    wheel.push_back(detent_compounds::box({0.45 * cos(angle), 0, 0.45 * sin(angle)}, {0.04, 0.12, 0.04}));
  }
  CompoundLab lab(wheel, {}, true);
  lab.add_ground();
  const BodyId id = lab.add_compound(0, 0.15, 0);
  uint32_t dropped = 0;
  for (int tick = 0; tick < 120; ++tick) dropped += lab.run(1).lost.contacts;
  EXPECT_EQ(dropped, 0u);
  EXPECT_EQ(lab.run(1).awake, 0u);
  EXPECT_NEAR(lab.motion(id).position[1], 0.12, 1e-3);
}

/// Hollow compounds catch on each other: a pile of them comes to rest inside its walls.
DETENT_TEST(compounds, come_to_rest_in_a_pile) {
  const Parts kinds[] = {detent_compounds::jack(0.4, 0.1), detent_compounds::letter_l(), detent_compounds::dumbbell()};
  for (const Parts& parts : kinds) {
    CompoundLab lab(parts);
    lab.add_ground();
    for (int side = 0; side < 4; ++side) {
      BodyDef wall;
      wall.type = BodyType::fixed;
      wall.shape = side < 2 ? box(reals(1, 10, 5)) : box(reals(5, 10, 1));
      const double at = side % 2 == 0 ? 3 : -3;
      wall.position = side < 2 ? position(at, 10, 0) : position(0, 10, at);
      lab.add(wall);
    }
    detent_queries::Random random(9);
    std::vector<BodyId> ids;
    for (int i = 0; i < 12; ++i) {
      const double x = random.uniform(-0.8, 0.8), z = random.uniform(-0.8, 0.8),
                   rotation_vector = random.uniform(-1, 1);
      BodyDef def = lab.compound_def(x, 1.5 + 1.8 * i, z);
      def.angular_velocity = reals(rotation_vector, 0.7, -rotation_vector);
      ids.push_back(lab.add(def));
    }
    uint32_t dropped = 0, capped = 0;
    for (int tick = 0; tick < 1200; ++tick) {
      const StepReport report = lab.run(1);
      dropped += report.lost.contacts;
      capped += report.contacts.capped;
    }
    EXPECT_EQ(dropped, 0u);
    EXPECT_EQ(capped, 0u);
    for (const BodyId id : ids) {
      const Motion motion = lab.motion(id);
      EXPECT_LT(fabs(motion.position[0]), 2);
      EXPECT_LT(fabs(motion.position[2]), 2);
      EXPECT_GT(motion.position[1], 0.05);
      EXPECT_LT(speed_of(motion), 0.05);
    }
  }
}

/// A ball touches in one point, as a part of a compound, too. The two balls of the dumbbell lie on the same floor, so
/// they form one contact of two points.
DETENT_TEST(compounds, of_balls_touch_in_single_points) {
  CompoundLab lab(detent_compounds::dumbbell());
  lab.add_floor(3);
  lab.add_compound(0, 0.5, 0);
  lab.run(30);
  ASSERT_EQ(get_info(lab.world).contacts, 1u);
  Contact contact;
  ASSERT_OK(get_contact(lab.world, 0, contact));
  ASSERT_EQ(contact.point_count, 2u);
  EXPECT_EQ(contact.point[0].child_b + contact.point[1].child_b, 3u);
}

/// The centre of the compound lies inside the ridge; each of its balls is on one side. Two balls lie on each side.
DETENT_TEST(compounds, stand_astride_a_ridge) {
  const Bytes ridge =
      detent_terrains::cooked(detent_terrains::ground(8, 1, [](double x, double) { return 1 - fabs(x); }));
  const Parts arch = {detent_compounds::ball(-1, 0, -0.5, 0.2), detent_compounds::ball(1, 0, -0.5, 0.2),
                      detent_compounds::ball(-1, 0, 0.5, 0.2), detent_compounds::ball(1, 0, 0.5, 0.2),
                      detent_compounds::capsule({-1, 1.2, 0}, {1, 1.2, 0}, 0.1)};
  CompoundLab lab(arch, ridge);
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = terrain(1);
  ground.material.friction = real(1);
  lab.add(ground);
  const double rest = 0.2 * sqrt(2.0);
  BodyDef def = lab.compound_def(0, rest + 0.01, 0.1);
  def.material.friction = real(1);
  const BodyId id = lab.add(def);
  EXPECT_LT(rest + lab.info.origin[1], 1);
  lab.run(120);
  EXPECT_NEAR(lab.motion(id).position[1], rest + lab.info.origin[1], 0.01);
  EXPECT_EQ(get_info(lab.world).contacts, 2u);
}

DETENT_TEST(compounds, are_one_body_in_what_is_told) {
  CompoundLab lab(detent_compounds::table());
  lab.add_ground();
  lab.add_compound(0, 0.02, 0);
  ContactEvent events[16];
  lab.world.hooks.contact_events = {events, 16};
  uint32_t begun = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const StepReport report = lab.run(1);
    for (uint32_t i = 0; i < report.events.contact; ++i) begun += events[i].type == ContactEventType::begin ? 1 : 0;
  }
  EXPECT_EQ(begun, 1u);
}

DETENT_TEST(compounds, are_asked_part_by_part) {
  CompoundLab lab(detent_compounds::table(), weightless());
  const BodyId id = lab.add_compound(0, 0, 0);
  QueryHit hit[1];
  QueryReport report;
  RayQuery ray;
  ray.origin = position(-5, 0.45, 0.5);
  ray.displacement = reals(10, 0, 0);
  EXPECT_OK(query_ray(lab.world, ray, {hit, 1}, report));
  EXPECT_EQ(report.hits, 0u);
  ray.origin = position(-5, 0.45, 0.95);
  EXPECT_OK(query_ray(lab.world, ray, {hit, 1}, report));
  ASSERT_EQ(report.hits, 1u);
  EXPECT_TRUE(hit[0].body == id);
  EXPECT_NEAR(coord_to_host(hit[0].point.x), -1, 1e-4);
  ClosestQuery closest;
  closest.shape = sphere(real(0.1));
  closest.position = position(0.2, 0.5, 0.1);
  EXPECT_OK(query_closest(lab.world, closest, {hit, 1}, report));
  ASSERT_EQ(report.hits, 1u);
  EXPECT_NEAR(real_to_host(hit[0].distance), 0.3, 1e-4);  // to the top
  OverlapQuery overlap;
  overlap.shape = box(reals(0.8, 0.3, 0.8));
  overlap.position = position(0, 0.5, 0);
  EXPECT_OK(query_overlap(lab.world, overlap, {hit, 1}, report));
  EXPECT_EQ(report.hits, 0u);
  overlap.position = position(0.2, 0.5, 0.2);
  EXPECT_OK(query_overlap(lab.world, overlap, {hit, 1}, report));
  EXPECT_EQ(report.hits, 1u);
  overlap.shape = compound(0);
  EXPECT_EQ(query_overlap(lab.world, overlap, {hit, 1}, report), Status::bad_argument);
}

DETENT_TEST(compounds, give_their_parts_to_draw) {
  const Bytes bytes = detent_compounds::cooked(detent_compounds::dumbbell());
  const Asset asset = {bytes.data(), bytes.count()};
  CompoundPart part;
  EXPECT_OK(compound_part(asset, 1, part));
  EXPECT_EQ(part.type, ShapeType::sphere);
  EXPECT_NEAR(part.radius, 0.5, 1e-9);
  EXPECT_NEAR(hypot(hypot(part.from[0], part.from[1]), part.from[2]), 1, 1e-9);
  EXPECT_OK(compound_part(asset, 2, part));
  EXPECT_EQ(part.type, ShapeType::capsule);
  EXPECT_NEAR(hypot(hypot(part.from[0] - part.to[0], part.from[1] - part.to[1]), part.from[2] - part.to[2]), 2, 1e-8);
  EXPECT_EQ(compound_part(asset, 3, part), Status::out_of_range);
  const Bytes table = detent_compounds::cooked(detent_compounds::table());
  EXPECT_OK(compound_part({table.data(), table.count()}, 0, part));
  EXPECT_EQ(part.type, ShapeType::hull);
  HullInfo hull;
  EXPECT_OK(hull_info(part.hull, hull));
  EXPECT_EQ(hull.vertex_count, 8u);
}

DETENT_TEST(compounds, are_saved_restored_and_loaded) {
  const Parts parts = detent_compounds::table();
  CompoundLab lab(parts, {}, true);
  lab.add_ground();
  lab.add_compound(0, 0.5, 0);
  lab.add_compound(0.3, 1.8, 0.2);
  lab.run(40);
  CompoundLab other(parts, {}, true);
  std::vector<uint64_t> saved = expect_one_way_on(lab, other);
  CompoundLab stranger(detent_compounds::letter_l(), {}, true);
  EXPECT_EQ(load(stranger.world, bytes_of(saved), byte_count(saved)), Status::asset_mismatch);
}

/// Flips each bit of the state of a world with a compound: load() refuses it, or the world can be stepped.
DETENT_TEST(compounds, in_a_flipped_snapshot_are_refused_or_harmless) {
  const Parts parts = {detent_compounds::ball(-1, 0, 0, 0.5), detent_compounds::ball(1, 0, 0, 0.5)};
  CompoundLab lab(parts);
  lab.add_ground();
  lab.add_compound(0, 0.5, 0);
  lab.run(5);
  std::vector<uint64_t> saved = lab.snapshot();
  CompoundLab other(parts);
  for (size_t word = 0; word < saved.size(); ++word) {
    if (saved[word] == 0 && word % 16 != 0) continue;
    for (int bit = 0; bit < 64; bit += 1 + static_cast<int>(word % 3)) {
      saved[word] ^= uint64_t{1} << bit;
      std::vector<uint64_t> copy = saved;
      if (load(other.world, bytes_of(copy), byte_count(copy)) == Status::ok) other.run(1);
      saved[word] ^= uint64_t{1} << bit;
    }
  }
}

DETENT_TEST(compounds, without_their_asset_touch_nothing_which_is_counted) {
  CompoundLab lab(detent_compounds::table());
  lab.add_ground();
  const BodyId lower = lab.add_compound(0, 0, 0), upper = lab.add_compound(0, 1, 0);
  const BodyId box_below = lab.add_box(0.25, 0.2, 0.25, 0.1);
  EXPECT_TRUE(lab.run(30).complete());
  const AssetTable assets = lab.world.hooks.assets;
  lab.world.hooks.assets = {};
  const StepReport report = lab.run(30);
  EXPECT_FALSE(report.complete());
  EXPECT_GT(report.contacts.capped, 0u);
  EXPECT_LT(lab.motion(lower).linear_velocity[1], -1) << "it falls";
  EXPECT_LT(lab.motion(upper).linear_velocity[1], -1);
  EXPECT_NEAR(lab.motion(box_below).position[1], 0.25, 0.01);
  lab.world.hooks.assets = assets;
}

DETENT_TEST(compounds, are_refused_where_they_cannot_be) {
  CompoundLab lab(detent_compounds::table());
  BodyId id;
  BodyDef def = lab.compound_def(0, 0, 0);
  def.shape.rounding = real(0.1);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.shape = hull(0);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.shape = compound(1);
  EXPECT_EQ(create_body(lab.world, def, id), Status::asset_missing);
  id = lab.add_compound(0, 0, 0);
  EXPECT_OK(set_type(lab.world, id, BodyType::fixed));
  EXPECT_OK(set_type(lab.world, id, BodyType::dynamic));
  Shape shape;
  EXPECT_OK(get_shape(lab.world, id, shape));
  EXPECT_TRUE(shape.type == ShapeType::compound && shape.asset == 0 && shape.rounding == Real(0.0));
  BodyId same;
  def.shape = shape;
  EXPECT_OK(create_body(lab.world, def, same));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
