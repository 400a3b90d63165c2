#include "tests/campaigns/stress/scenes.h"

#include <math.h>

#include "tests/common/queries/random.h"

namespace detent_stress {

namespace {

using detent_queries::length;
using detent_queries::operator+;
using detent_queries::operator*;
using detent_queries::Random;
using detent_queries::rotate;
using detent_queries::Rotation;
using detent_queries::Triple;

enum class Axis : uint32_t { x, y, z };

/// The rotation by an angle in [-1, 1] rad. Uses a series, because sin() differs between machines.
Rotation rotation_about(Axis axis, double angle) {
  const double half = angle / 2;
  double sine = half, term = half;
  for (int n = 2; n < 20; n += 2) {
    term *= -half * half / (n * (n + 1));
    sine += term;
  }
  Rotation rotation = {0, 0, 0, sqrt(1 - sine * sine)};
  rotation[static_cast<uint32_t>(axis)] = sine;
  return rotation;
}

void set(double (&result)[3], const Triple& value) {
  for (size_t i = 0; i < 3; ++i) result[i] = value[i];
}
void set(double (&result)[4], const Rotation& value) {
  for (size_t i = 0; i < 4; ++i) result[i] = value[i];
}

StageBody body_of(Solid solid, const Triple& size, const Triple& position) {
  StageBody body;
  body.solid = solid;
  set(body.size, size);
  set(body.position, position);
  return body;
}

StageBody unit_box(double x, double y, double z) { return body_of(Solid::box, {0.5, 0.5, 0.5}, {x, y, z}); }

StageBody fixed_box(const Triple& half, const Triple& position) {
  StageBody body = body_of(Solid::box, half, position);
  body.role = Role::fixed;
  return body;
}

Stage on_floor(const std::string& name, uint32_t ticks) {
  Stage stage;
  stage.name = name;
  stage.ticks = ticks;
  stage.bodies.push_back(fixed_box({100, 1, 100}, {0, -1, 0}));
  return stage;
}

/// A direction whose angle to +z has a cosine uniform in [cosine_min, 1].
Triple near_z(Random& random, double cosine_min) {
  const double cosine = random.uniform(cosine_min, 1), sine = sqrt(1 - cosine * cosine);
  const Triple z = {0, 0, 1};
  return z * cosine + random.perpendicular(z) * sine;
}

}  // namespace

Stage pyramid(uint32_t base) {
  Stage stage = on_floor("pyramid", 600);
  for (uint32_t row = 0; row < base; ++row) {
    const uint32_t count = base - row;
    for (uint32_t i = 0; i < count; ++i) stage.bodies.push_back(unit_box((i - (count - 1) * 0.5) * 1.1, row + 0.5, 0));
  }
  return stage;
}

Stage tower(uint32_t count, uint64_t seed) {
  Stage stage = on_floor("tower", 3600);
  Random random(seed);
  for (uint32_t i = 0; i < count; ++i) {
    const double x = random.uniform(-0.01, 0.01), z = random.uniform(-0.01, 0.01);
    StageBody body = unit_box(x, i + 0.5, z);
    set(body.rotation, rotation_about(Axis::y, random.uniform(-0.02, 0.02)));
    stage.bodies.push_back(body);
  }
  return stage;
}

Stage mass_cube(double ratio) {
  Stage stage = on_floor("mass_cube", 1200);
  for (uint32_t i = 0; i < 4; ++i) {
    StageBody body = unit_box(0, i + 0.5, 0);
    body.density = i == 3 ? ratio : 1;
    stage.bodies.push_back(body);
  }
  return stage;
}

Stage mass_slab(double ratio) {
  Stage stage = on_floor("mass_slab", 1200);
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      StageBody body = unit_box(x, 0.5, z);
      body.mass = 1;
      stage.bodies.push_back(body);
    }
  }
  StageBody slab = body_of(Solid::box, {1.5, 0.25, 1.5}, {0, 1.25, 0});
  slab.mass = ratio;
  stage.bodies.push_back(slab);
  return stage;
}

Stage pit(uint32_t bodies, uint64_t seed, uint32_t side) {
  constexpr double k_distance = 1.2;     // within a layer, m
  constexpr double k_layer = 1.1;        // m
  constexpr double k_wall_half = 0.5;    // m
  constexpr double k_half_room = 0.625;  // half width of the pit for each body of a row, m
  Stage stage;
  stage.name = "pit";
  stage.ticks = 600;
  const double half = side * k_half_room;
  const double height = (bodies / (side * side) + 3) * k_layer / 2;  // half height
  stage.bodies.push_back(fixed_box({half + 2 * k_wall_half, 1, half + 2 * k_wall_half}, {0, -1, 0}));
  for (const double sign : {-1.0, 1.0}) {
    stage.bodies.push_back(
        fixed_box({k_wall_half, height, half + 2 * k_wall_half}, {sign * (half + k_wall_half), height, 0}));
    stage.bodies.push_back(fixed_box({half, height, k_wall_half}, {0, height, sign * (half + k_wall_half)}));
  }
  Random random(seed);
  for (uint32_t i = 0; i < bodies; ++i) {
    const uint32_t layer = i / (side * side), x = i % side, z = i / side % side;
    const Triple at = {(x - (side - 1) * 0.5) * k_distance, (layer + 1) * k_layer, (z - (side - 1) * 0.5) * k_distance};
    // The solids alternate along each row and from row to row.
    const uint32_t kind = (i + i / side) % 4;
    Triple size = {};
    switch (static_cast<Solid>(kind)) {
      case Solid::box:
        for (double& extent : size) extent = random.uniform(0.2, 0.35);
        break;
      case Solid::sphere:
        size[0] = random.uniform(0.25, 0.4);
        break;
      case Solid::capsule:
        size[0] = random.uniform(0.15, 0.25);
        size[1] = random.uniform(0.15, 0.25);
        break;
      case Solid::icosahedron:
        size[0] = random.uniform(0.3, 0.45);
        break;
      case Solid::half_space:  // of the ground alone
        break;
    }
    StageBody body = body_of(static_cast<Solid>(kind), size, at);
    set(body.rotation, random.rotation());
    stage.bodies.push_back(body);
  }
  return stage;
}

Stage paper_shot(Target target, Projectile projectile, double speed, uint64_t seed) {
  constexpr double k_cosine_60_degrees = 0.5, k_cosine_1_degree = 0.99984769515639123916;
  Stage stage;
  stage.name = "paper_shot";
  stage.gravity = 0;
  stage.ticks = 13;  // the projectile reaches the target in the first tick, and 12 ticks more
  const bool wall = target == Target::wall;
  Random random(seed);
  const Rotation rotation_vector = random.rotation();

  const double half = wall ? 5 : 1;
  StageBody slab = body_of(Solid::box, {half, half, 0.005}, {0, 0, 0});
  slab.role = wall ? Role::fixed : Role::dynamic;
  set(slab.rotation, rotation_vector);
  stage.bodies.push_back(slab);

  const double spread = wall ? 2 : 0.1;  // m
  Triple aim = {spread, spread, 0};
  while (length(aim) > spread) aim = {random.uniform(-spread, spread), random.uniform(-spread, spread), 0};
  const Triple back = near_z(random, wall ? k_cosine_60_degrees : k_cosine_1_degree);
  const double distance = 0.8 + random.uniform(0.3, 1.3) * speed * stage.tick;
  StageBody shot = body_of(Solid::sphere, {0.05, 0, 0}, rotate(rotation_vector, aim + back * distance));
  shot.density = 7800;
  const Rotation rotation = random.rotation();
  set(shot.rotation, rotation);
  set(shot.linear_velocity, rotate(rotation_vector, back * -speed));
  if (projectile == Projectile::rod) {
    shot.solid = Solid::box;
    set(shot.size, Triple{0.01, 0.5, 0.01});
    set(shot.angular_velocity, random.perpendicular(rotate(rotation, Triple{0, 1, 0})) * 40);
  }
  stage.bodies.push_back(shot);
  return stage;
}

Stage chain(uint32_t links, double ratio) {
  constexpr double k_half = 0.25;        // of a link's length, m
  constexpr double k_weight_half = 0.3;  // m
  constexpr double k_root = 0.70710678118654752440;
  Stage stage;
  stage.name = "chain";
  stage.ticks = 1800;
  stage.collisions = false;
  StageBody hook = body_of(Solid::sphere, {0.1, 0, 0}, {0, 0, 0});
  hook.role = Role::fixed;
  stage.bodies.push_back(hook);
  /// Connects a point of the body with a point of the previous body.
  const auto hang = [&stage](const StageBody& body, const Triple& anchor_last, const Triple& anchor) {
    StageJoint joint;
    joint.a = static_cast<uint32_t>(stage.bodies.size() - 1);
    joint.b = joint.a + 1;
    set(joint.anchor_a, anchor_last);
    set(joint.anchor_b, anchor);
    stage.joints.push_back(joint);
    stage.bodies.push_back(body);
  };
  StageBody link = body_of(Solid::capsule, {0.05, 0.2, 0}, {});
  set(link.rotation, Rotation{0, 0, -k_root, k_root});  // the link's y along x
  for (uint32_t i = 0; i < links; ++i) {
    set(link.position, Triple{(2 * i + 1) * k_half, 0, 0});
    hang(link, {0, i == 0 ? 0 : k_half, 0}, {0, -k_half, 0});
  }
  StageBody weight =
      body_of(Solid::box, {k_weight_half, k_weight_half, k_weight_half}, {2 * links * k_half + k_weight_half, 0, 0});
  weight.mass = ratio * mass_of(link);
  hang(weight, {0, k_half, 0}, {-k_weight_half, 0, 0});
  return stage;
}

Stage free_rotation() {
  Stage stage;
  stage.name = "free_rotation";
  stage.gravity = 0;
  stage.ticks = 10000;
  StageBody body = body_of(Solid::box, {0.5, 0.2, 0.05}, {0, 0, 0});
  set(body.angular_velocity, Triple{0.01, 10, 0.01});
  stage.bodies.push_back(body);
  return stage;
}

Stage dominoes(uint32_t count) {
  Stage stage = on_floor("dominoes", 1800);
  for (uint32_t i = 0; i < count; ++i) {
    const double x = (i - (count - 1) * 0.5) * 0.4;
    StageBody body = body_of(Solid::box, {0.05, 0.5, 0.25}, {x, 0.5, 0});
    if (i == 0) {
      // Rotated about the lower edge towards the second domino.
      const Rotation tilt = rotation_about(Axis::z, -0.2);
      set(body.rotation, tilt);
      set(body.position, rotate(tilt, Triple{-0.05, 0.5, 0}) + Triple{x + 0.05, 0, 0});
    }
    stage.bodies.push_back(body);
  }
  return stage;
}

Stage incline(double friction, double part) {
  Stage stage = on_floor("incline", 61 * 60);
  const double tangent = friction * part, cosine = 1 / sqrt(1 + tangent * tangent);
  const double half = sqrt((1 + cosine) / 2);  // cosine of half the slope
  const Rotation tilt = {0, 0, -tangent * cosine / (2 * half), half};
  StageBody& floor = stage.bodies[0];
  set(floor.rotation, tilt);
  set(floor.position, rotate(tilt, Triple{0, -1, 0}));
  StageBody body = unit_box(0, 0, 0);
  set(body.rotation, tilt);
  set(body.position, rotate(tilt, Triple{-60, 0.5, 0}));
  stage.bodies.push_back(body);
  for (StageBody& each : stage.bodies) each.friction = friction;
  return stage;
}

Stage sleep_stacks(uint32_t stacks, uint32_t height, bool sleeping) {
  Stage stage = on_floor("sleep_stacks", 900);
  stage.sleeping = sleeping;
  uint32_t side = 1;
  while (side * side < stacks) ++side;
  for (uint32_t i = 0; i < stacks; ++i) {
    const double x = (i % side - (side - 1) * 0.5) * 3, z = (i / side - (side - 1) * 0.5) * 3;
    for (uint32_t level = 0; level < height; ++level) stage.bodies.push_back(unit_box(x, level + 0.5, z));
  }
  return stage;
}

Stage bounce(double height, uint32_t bounces) {
  Stage stage = on_floor("bounce", 0);
  StageBody body = body_of(Solid::sphere, {0.5, 0, 0}, {0, height, 0});
  body.restitution = 1;
  stage.bodies.push_back(body);
  const double period = 2 * sqrt(2 * (height - 0.5) / stage.gravity);
  stage.ticks = static_cast<uint32_t>(bounces * period / stage.tick);
  return stage;
}

Stage slide_and_roll(double speed, double friction) {
  Stage stage = on_floor("slide_and_roll", 120);
  StageBody body = body_of(Solid::sphere, {0.5, 0, 0}, {0, 0.5, 0});
  body.linear_velocity[0] = speed;
  stage.bodies.push_back(body);
  for (StageBody& each : stage.bodies) each.friction = friction;
  return stage;
}

}  // namespace detent_stress
