#include <detent/asset.h>
#include <detent/distance.h>
#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

void bodies() {
  const Shape shapes[] = {
      sphere(0.5),
      capsule(0.25, 0.5),                  // radius, half the length between the centres of its ends
      box({0.5, 0.25, 1.0}),               // half extents
      cylinder(0.5, 0.75),                 // radius, half height, about y
      cone(0.5, 0.75),                     // its centre of mass is a quarter of the height above its base
      rounded(box({0.4, 0.4, 0.4}), 0.1),  // a cube of 1 m whose edges are round
  };
  static WorldStorage<Capacity{.bodies = 8, .contacts = 16}> storage;
  World world;
  check(storage.create({}, world));
  BodyId ground;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  Coord x = 0.0;
  for (const Shape& shape : shapes) {
    BodyId body;
    check(create_body(world, {.position = {x, 2.0, 0.0}, .shape = shape}, body));
    x += Coord(3.0);
  }
  for (int tick = 0; tick < 60; ++tick) check(step(world).complete());
  check(get_info(world).contacts == 6);
}

void mass() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 2}> storage;
  World world;
  check(storage.create({}, world));
  BodyId wooden, weighed;
  check(create_body(world, {.shape = box({0.5, 0.5, 0.5}), .density = 700.0}, wooden));  // kg/m^3
  check(create_body(world, {.shape = box({0.5, 0.5, 0.5}), .mass = 80.0}, weighed));     // kg
  Scaled kilograms;
  check(get_mass(world, wooden, kilograms));
  check(scaled_to_host(kilograms) == 700.0);
  check(get_mass(world, weighed, kilograms));
  check(scaled_to_host(kilograms) == 80.0);
}

alignas(8) const uint8_t rock[] = {
#include "rock.inc"
};
const Asset assets[] = {{rock, sizeof rock}};

void hulls() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 2, .assets = 1}> storage;
  World world;
  check(storage.create({}, {.assets = {assets, 1}}, world));
  check(bind_asset(world, 0));
  BodyId stone;
  check(create_body(world, {.position = {0.0, 2.0, 0.0}, .shape = hull(0)}, stone));

  HullInfo info;
  check(hull_info(assets[0], info));
  check(info.vertex_count >= 4 && info.frame == HullFrame::principal);
}

void questions() {
  Convex ball, crate;
  check(make_convex(sphere(0.5), ball));
  check(make_convex(box({0.5, 0.5, 0.5}), crate));
  const Pose here = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  const Pose there = {{3.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  Closest closest;
  check(closest_points(ball, here, crate, there, closest));
  const double gap = real_to_host(closest.distance);  // 2 m
  check(fabs(gap - 2.0) < 1e-6);
}

}  // namespace

int main() {
  bodies();
  mass();
  hulls();
  questions();
}
