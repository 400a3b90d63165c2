#include <detent/body.h>
#include <detent/contact.h>
#include <detent/draw.h>
#include <detent/query.h>
#include <detent/world.h>
#include <math.h>

#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/world/terrain_lab.h"

/// Bodies made of meshes and height fields.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_terrains::Source;

double flat(double, double) { return 0; }

/// All convex shapes, and the heights of their centres at rest above the ground.
struct Resting {
  Shape shape;
  double height;
};
std::vector<Resting> shapes() {
  return {{sphere(real(0.5)), 0.5},
          {box(reals(0.5, 0.25, 0.4)), 0.25},
          {rounded(box(reals(0.4, 0.2, 0.3)), real(0.1)), 0.3},
          {cylinder(real(0.4), real(0.3)), 0.3},
          {cone(real(0.4), real(0.5)), 0.25}};
}

DETENT_TEST(terrains, carry_every_shape_as_a_half_space_does) {
  const Bytes terrains[] = {detent_terrains::cooked(detent_terrains::plane(16, 0.7)), field_of(16, 0.7, flat, true)};
  for (const Bytes& bytes : terrains) {
    TerrainLab lab(bytes, {}, true);
    lab.add_terrain();
    std::vector<BodyId> ids;
    const std::vector<Resting> resting = shapes();
    for (size_t i = 0; i < resting.size(); ++i)
      ids.push_back(
          lab.add_shape(resting[i].shape, 1.6 * static_cast<double>(i) - 3.1, resting[i].height + 0.05, 0.13));
    for (int tick = 0; tick < 240; ++tick) {
      const StepReport report = step(lab.world);
      EXPECT_TRUE(report.complete()) << tick;
    }
    for (size_t i = 0; i < ids.size(); ++i) {
      const Motion motion = lab.motion(ids[i]);
      EXPECT_NEAR(motion.position[1], resting[i].height, 2e-3) << i;
      EXPECT_NEAR(motion.position[0], 1.6 * static_cast<double>(i) - 3.1, 1e-3) << i;
      EXPECT_NEAR(motion.position[2], 0.13, 1e-3) << i;
      bool awake = true;
      EXPECT_OK(is_awake(lab.world, ids[i], awake));
      EXPECT_FALSE(awake) << i;
    }
  }
}

/// Boxes, plates and rods fall one after the other on ground whose slopes differ by up to a few degrees, so that they
/// lie across its ridges and valleys.
DETENT_TEST(terrains, let_boxes_of_all_proportions_come_to_rest) {
  const auto uneven = [](double x, double z) {
    const int i = static_cast<int>(lround(2 * x)) + 100, j = static_cast<int>(lround(2 * z)) + 100;
    return 0.003 * ((7 * i + 13 * j + 5 * i * j) % 11);
  };
  TerrainLab lab(field_of(24, 0.5, uneven, false), {}, true);
  lab.add_terrain();
  detent_queries::Random random(5);
  const uint32_t count = detent_oracle::rounds(400);
  uint32_t restless = 0;
  for (uint32_t i = 0; i < count; ++i) {
    BodyDef def;
    const double longest = random.log_uniform(0.125, 1);
    const double width = longest * random.log_uniform(0.03, 1), height = longest * random.log_uniform(0.03, 1);
    def.shape = box(reals(width, longest, height));
    const double x = random.uniform(-2, 2), z = random.uniform(-2, 2);
    def.position = position(x, 2, z);
    const detent_queries::Triple spin = random.direction();
    def.angular_velocity = reals(3 * spin[0], 3 * spin[1], 3 * spin[2]);
    const BodyId id = lab.add(def);
    bool awake = true;
    for (int second = 0; second < 15 && awake; ++second) {
      lab.run(60);
      EXPECT_OK(is_awake(lab.world, id, awake));
    }
    restless += awake ? 1 : 0;
    EXPECT_OK(destroy_body(lab.world, id));
  }
  printf("%u of %u boxes did not come to rest\n", restless, count);
  EXPECT_LE(restless, count / 2000);
}

/// Without friction, a body that slides over inner edges keeps its speed and stays on the ground.
DETENT_TEST(terrains, are_slid_over_without_a_hitch) {
  TerrainLab lab(detent_terrains::cooked(detent_terrains::plane(60, 0.31)));
  lab.add_terrain(0);
  const BodyId ids[] = {lab.add_shape(box(reals(0.5, 0.25, 0.4)), -8, 0.25, 0.03, 0),
                        lab.add_shape(cylinder(real(0.4), real(0.3)), -8, 0.3, 2.04, 0),
                        lab.add_shape(sphere(real(0.3)), -8, 0.3, -2.02, 0)};
  lab.run(30);
  for (const BodyId id : ids) EXPECT_OK(set_velocity(lab.world, id, reals(7, 0, 0.3), {}));
  for (int tick = 0; tick < 120; ++tick) {
    lab.run(1);
    for (const BodyId id : ids) {
      const Motion motion = lab.motion(id);
      EXPECT_NEAR(motion.linear_velocity[0], 7, 2e-3) << tick;
      EXPECT_NEAR(motion.linear_velocity[1], 0, 2e-3) << tick;
      EXPECT_NEAR(motion.linear_velocity[2], 0.3, 2e-3) << tick;
      EXPECT_LT(fabs(motion.angular_velocity[0]) + fabs(motion.angular_velocity[1]) + fabs(motion.angular_velocity[2]),
                5e-3)
          << tick;
    }
  }
}

/// Bodies hit a closed room from inside, on all sides.
DETENT_TEST(terrains, let_nothing_through) {
  TerrainLab lab(detent_terrains::cooked(detent_terrains::box_terrain(4, 3, 5, 3)));
  lab.add_terrain();
  detent_queries::Random random(17);
  const std::vector<Resting> kinds = shapes();
  const uint32_t rounds = detent_oracle::rounds(60);
  for (uint32_t round = 0; round < rounds; ++round) {
    std::vector<BodyId> ids;
    for (uint32_t i = 0; i < 10; ++i) {
      BodyDef def;
      def.shape = kinds[i % kinds.size()].shape;
      const double x = random.uniform(-2, 2), z = random.uniform(-3, 3);
      def.position = position(x, -1.5 + 0.3 * i, z);
      const double speed_x = random.uniform(-400, 400), speed_y = random.uniform(-400, 400);
      const double speed_z = random.uniform(-400, 400), angular_velocity = random.uniform(-60, 60);
      def.linear_velocity = reals(speed_x, speed_y, speed_z);
      def.angular_velocity = reals(angular_velocity, 0.5 * angular_velocity, 0);
      def.material.restitution = real(0.5);
      ids.push_back(lab.add(def));
    }
    for (int tick = 0; tick < 60; ++tick) {
      lab.run(1);
      for (const BodyId id : ids) {
        const Motion motion = lab.motion(id);
        ASSERT_LT(fabs(motion.position[0]), 4) << round << ", " << tick;
        ASSERT_LT(fabs(motion.position[1]), 3) << round << ", " << tick;
        ASSERT_LT(fabs(motion.position[2]), 5) << round << ", " << tick;
      }
    }
    for (const BodyId id : ids) EXPECT_OK(destroy_body(lab.world, id));
  }
}

DETENT_TEST(terrains, of_one_side_let_through_what_comes_from_behind) {
  for (const bool one_sided : {false, true}) {
    TerrainLab lab(detent_terrains::cooked(detent_terrains::plane(8, 1), one_sided));
    lab.add_terrain();
    const BodyId up = lab.add_shape(sphere(real(0.2)), 0.3, -2, 0.2);
    const BodyId down = lab.add_shape(sphere(real(0.2)), 2.3, 2, 0.2);
    EXPECT_OK(set_velocity(lab.world, up, reals(0, 300, 0), {}));
    EXPECT_OK(set_velocity(lab.world, down, reals(0, -300, 0), {}));
    lab.run(2);
    EXPECT_EQ(lab.motion(up).position[1] > 0, one_sided);
    EXPECT_GT(lab.motion(down).position[1], 0);
  }
}

DETENT_TEST(terrains, touch_in_several_places_at_once) {
  // A valley: the box's lower edges touch both slopes.
  TerrainLab lab(detent_terrains::cooked(detent_terrains::ground(8, 1, [](double x, double) { return fabs(x); })));
  const BodyId ground = lab.add_terrain();
  const BodyId ball = lab.add_shape(sphere(real(0.5)), 0, 0.5 * sqrt(2.0) + 0.01, 0.2, 0);
  ContactEvent events[8];
  lab.world.hooks.contact_events = {events, 8};
  uint32_t begun = 0;
  for (int tick = 0; tick < 120; ++tick) {
    const StepReport report = lab.run(1);
    for (uint32_t i = 0; i < report.events.contact; ++i) begun += events[i].type == ContactEventType::begin ? 1 : 0;
  }
  EXPECT_EQ(begun, 1u);  // of the two bodies
  EXPECT_NEAR(lab.motion(ball).position[1], 0.5 * sqrt(2.0), 1e-3);
  EXPECT_NEAR(lab.motion(ball).position[0], 0, 1e-3);
  ASSERT_EQ(get_info(lab.world).contacts, 2u);
  uint32_t parts[2] = {};
  double weight = 0;
  for (uint32_t i = 0; i < 2; ++i) {
    Contact contact;
    ASSERT_OK(get_contact(lab.world, i, contact));
    EXPECT_TRUE(contact.a == ground && contact.b == ball);
    EXPECT_EQ(contact.point_count, 1u);
    parts[i] = contact.part;
    weight += scaled_to_host(contact.normal_force) * unit_to_host(contact.normal.y);
  }
  EXPECT_TRUE(parts[0] != 0 && parts[0] < parts[1]);
  Scaled mass;
  EXPECT_OK(get_mass(lab.world, ball, mass));
  EXPECT_NEAR(weight, 9.81 * scaled_to_host(mass), 0.02 * weight);
}

/// A rotating terrain carries bodies that lie on it: contacts use the velocity of the surface at each point.
DETENT_TEST(terrains, carry_along_when_they_move) {
  TerrainLab lab(detent_terrains::cooked(detent_terrains::plane(8, 1)));
  BodyDef table = lab.ground_def(1);
  table.type = BodyType::kinematic;
  table.angular_velocity = reals(0, 0.5, 0);
  lab.add(table);
  const BodyId box_id = lab.add_shape(box(reals(0.3, 0.1, 0.3)), 2, 0.1, 0, 1);
  lab.run(240);  // 2 rad
  const Motion motion = lab.motion(box_id);
  EXPECT_NEAR(hypot(motion.position[0], motion.position[2]), 2, 0.05);
  EXPECT_NEAR(atan2(-motion.position[2], motion.position[0]), 2, 0.06);
  EXPECT_NEAR(motion.angular_velocity[1], 0.5, 0.01);
}

/// A rotating wall pushes bodies out of its way, at any speed.
DETENT_TEST(terrains, sweep_away_what_they_meet) {
  Source wall;
  detent_terrains::add_vertex(wall, 0, -2, 0);
  detent_terrains::add_vertex(wall, 6, -2, 0);
  detent_terrains::add_vertex(wall, 6, 2, 0);
  detent_terrains::add_vertex(wall, 0, 2, 0);
  detent_terrains::add_triangle(wall, 0, 1, 2);
  detent_terrains::add_triangle(wall, 0, 2, 3);
  WorldDef def;
  def.gravity = {};
  TerrainLab lab(detent_terrains::cooked(wall), def);
  BodyDef turning = lab.ground_def();
  turning.type = BodyType::kinematic;
  turning.angular_velocity = reals(0, -60, 0);  // 1 rad a tick
  lab.add(turning);
  const BodyId ball = lab.add_shape(sphere(real(0.2)), 3, 0, 1.5);
  lab.run(1);
  const Motion motion = lab.motion(ball);
  EXPECT_GT(hypot(motion.linear_velocity[0], motion.linear_velocity[2]), 100);
  EXPECT_TRUE(lab.run(0).complete());
}

DETENT_TEST(terrains, are_saved_restored_and_loaded) {
  const Bytes bytes = detent_terrains::cooked(detent_terrains::ground(8, 1, [](double x, double) { return fabs(x); }));
  TerrainLab lab(bytes, {}, true);
  lab.add_terrain();
  lab.add_shape(box(reals(0.5, 0.25, 0.4)), 0.2, 1, 0.1);
  lab.add_shape(sphere(real(0.4)), -0.3, 2, 0.1);
  lab.run(40);
  TerrainLab other(bytes, {}, true);
  std::vector<uint64_t> saved = expect_one_way_on(lab, other);
  TerrainLab flat_lab(detent_terrains::cooked(detent_terrains::plane(8, 1)), {}, true);
  EXPECT_EQ(load(flat_lab.world, bytes_of(saved), byte_count(saved)), Status::asset_mismatch);
}

DETENT_TEST(terrains, are_refused_where_they_cannot_be) {
  TerrainLab lab(detent_terrains::cooked(detent_terrains::plane(2, 1)));
  BodyId id;
  BodyDef def = lab.ground_def();
  def.type = BodyType::dynamic;
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.type = BodyType::fixed;
  def.shape.rounding = real(0.1);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.shape = hull(0);
  EXPECT_EQ(create_body(lab.world, def, id), Status::bad_argument);
  def.shape = terrain(1);
  EXPECT_EQ(create_body(lab.world, def, id), Status::out_of_range);
  id = lab.add_terrain();
  EXPECT_EQ(set_type(lab.world, id, BodyType::dynamic), Status::bad_argument);
  Shape shape;
  EXPECT_OK(get_shape(lab.world, id, shape));
  EXPECT_TRUE(shape.type == ShapeType::terrain && shape.asset == 0);

  Lab plain({4, 4, 1});
  plain.world.features =
      &feature_table<without(Features::all, Features::terrain | Features::hull | Features::compound)>;
  EXPECT_EQ(bind_asset(plain.world, 0), Status::feature_missing);
}

/// Debug drawing reports every triangle to renderers, and its edges if the renderer draws lines only.
DETENT_TEST(terrains, are_shown_where_they_are) {
  TerrainLab lab(detent_terrains::cooked(detent_terrains::box_terrain(2, 1, 3, 2)));
  BodyDef def = lab.ground_def();
  def.position = position(5, 0, 0);
  def.rotation = {unit(0), unit(sqrt(0.5)), unit(0), unit(sqrt(0.5))};  // x to -z
  const BodyId id = lab.add(def);
  const BodyId ball = lab.add_shape(sphere(real(0.5)), 0, 0, 0);
  struct Shown {
    uint32_t triangles = 0, lines = 0, solids = 0, materials = 0;
    double low = 0, high = 0;
  } shown;
  const auto visit = [](void* user, const BodyTriangle& triangle) {
    Shown& all = *static_cast<Shown*>(user);
    EXPECT_EQ(triangle.index, all.triangles++);
    all.materials |= 1u << triangle.material;
    for (const Position& at : triangle.corner) {
      all.low = fmin(all.low, coord_to_host(at.x));
      all.high = fmax(all.high, coord_to_host(at.x));
    }
  };
  ASSERT_OK(visit_triangles(lab.world, id, &shown, visit));
  EXPECT_EQ(shown.triangles, 48u);
  EXPECT_EQ(shown.materials, 63u);
  EXPECT_NEAR(shown.high, 8, 1e-4);
  EXPECT_EQ(visit_triangles(lab.world, ball, &shown, visit), Status::bad_argument);
  EXPECT_EQ(visit_triangles(lab.world, {}, &shown, visit), Status::bad_id);
  EXPECT_EQ(visit_triangles(lab.world, id, &shown, nullptr), Status::bad_argument);

  DebugDraw to;
  to.user = &shown;
  to.line = [](void* user, const Position&, const Position&, DrawKind kind) {
    EXPECT_EQ(kind, DrawKind::fixed);
    ++static_cast<Shown*>(user)->lines;
  };
  draw(lab.world, to, DrawFlags::bodies);
  EXPECT_EQ(shown.lines, 3 * 48u);
  to.solid = [](void* user, BodyId, const Shape&, const Pose&, DrawKind) { ++static_cast<Shown*>(user)->solids; };
  draw(lab.world, to, DrawFlags::bodies);
  EXPECT_EQ(shown.lines, 3 * 48u);
  EXPECT_EQ(shown.solids, 2u);
  lab.world.hooks.assets = {};
  EXPECT_EQ(visit_triangles(lab.world, id, &shown, visit), Status::asset_missing);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
