#include <detent/body.h>
#include <detent/mover.h>
#include <detent/numbers.h>
#include <detent/world.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

constexpr Real k_tick = Real(1.0 / 60), k_zero = 0.0;
constexpr Real k_way = Real(3.0 / 60);      ///< m in a tick, at 3 m/s
constexpr Real k_drop = Real(9.81 / 3600);  ///< m: increase of the fall's displacement from tick to tick, g / 60^2

/// A game's state of a character.
struct Character {
  Mover mover;
  Real rise = k_zero;  ///< displacement up in the next tick, m
};

/// One tick: a desired displacement along x, and a jump if `jump` is set.
MoverReport play(World& world, const MoverSettings& settings, Character& character, Real displacement, bool jump) {
  if (jump && character.mover.ground.slot != 0) character.rise = Real(5.0 / 60);
  character.rise -= k_drop;
  MoverReport report;
  check(move_mover(world, settings, {displacement, character.rise, k_zero}, character.mover, report));
  if (report.on_ground) character.rise = k_zero;
  for (uint32_t i = 0; i < report.contact_count; ++i) {
    const MoverContact& contact = report.contacts[i];
    if (contact.impulse == Vec3<Scaled>{Scaled(0.0), Scaled(0.0), Scaled(0.0)}) continue;
    check(apply_impulse_at_point(world, contact.body, contact.impulse, contact.point));
  }
  return report;
}

double x_of(const Character& character) { return coord_to_host(character.mover.position.x); }
double y_of(const Character& character) { return coord_to_host(character.mover.position.y); }
bool is_about(double value, double expected) { return value > expected - 0.01 && value < expected + 0.01; }

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 16, .contacts = 32}> storage;
  World world;
  check(storage.create({.tick = k_tick}, world));
  BodyId id, lift, crate;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, id));
  const Coord step_x[] = {4.0, Coord(4.4), Coord(4.8), Coord(5.2)};
  const Real step_top[] = {Real(0.1), Real(0.2), Real(0.3), Real(0.4)};  // half heights
  for (int i = 0; i < 4; ++i) {
    BodyDef stair = {.type = BodyType::fixed, .shape = box({2.0, step_top[i], 2.0})};
    stair.position = {step_x[i], Coord(0.0), Coord(0.0)};
    stair.position = to_world({stair.position, stair.rotation}, {k_zero, step_top[i], k_zero});
    check(create_body(world, stair, id));
  }
  BodyDef platform = {.type = BodyType::kinematic, .position = {Coord(8.2), Coord(0.3), 0.0}};
  platform.shape = box({1.0, 0.5, 2.0});
  check(create_body(world, platform, lift));
  BodyDef thing = {.position = {-2.0, 0.5, 0.0}, .shape = box({0.5, 0.5, 0.5}), .mass = 20.0};
  check(create_body(world, thing, crate));

  MoverSettings settings;
  settings.radius = Real(0.3);
  settings.half_length = Real(0.6);  // 1.8 m tall
  settings.filter.category = 2;      // decides which bodies it collides with

  Character character;
  character.mover.position = {Coord(0.0), Coord(0.91), Coord(0.0)};

  // Up the stairs and onto the platform: a rise of 0.8 m.
  uint32_t steps = 0;
  bool stands = true;
  for (int tick = 0; tick < 165; ++tick) {
    step(world);
    const MoverReport report = play(world, settings, character, k_way, false);
    steps += report.stepped ? 1 : 0;
    stands = stands && report.on_ground;
  }
  printf("up %u steps: x %.2f m, y %.2f m\n", static_cast<unsigned>(steps), x_of(character), y_of(character));
  check(steps >= 4 && stands && is_about(y_of(character), 0.8 + 0.91));

  // The platform carries the character.
  check(set_velocity(world, lift, {k_zero, 1.0, k_zero}, {k_zero, k_zero, k_zero}));
  for (int tick = 0; tick < 60; ++tick) {
    step(world);
    const MoverReport report = play(world, settings, character, k_zero, false);
    check(report.on_ground && report.carried.y > k_zero);
  }
  check(is_about(y_of(character), 1.8 + 0.91));

  // The snapshot of the world and the bytes of the mover are enough to go back and replay (`rise` is 0 on the ground).
  static uint8_t snapshot[snapshot_bytes({.bodies = 16, .contacts = 32})];
  uint8_t bytes[k_mover_bytes];
  check(save(world, snapshot, sizeof snapshot));
  save_mover(character.mover, bytes);
  for (int tick = 0; tick < 20; ++tick) {
    step(world);
    play(world, settings, character, -k_way, tick == 0);
  }
  const Position there = character.mover.position;
  check(restore(world, snapshot, sizeof snapshot));
  check(load_mover(bytes, character.mover));
  character.rise = k_zero;
  for (int tick = 0; tick < 20; ++tick) {
    step(world);
    play(world, settings, character, -k_way, tick == 0);
  }
  check(character.mover.position == there);

  // Down the stairs again, and against the crate.
  for (int tick = 0; tick < 260; ++tick) {
    step(world);
    play(world, settings, character, -k_way, false);
  }
  Pose pose;
  check(get_pose(world, crate, pose));
  printf("the crate was pushed to x %.2f m\n", coord_to_host(pose.position.x));
  check(is_about(y_of(character), 0.91) && coord_to_host(pose.position.x) < -2.1);
}
