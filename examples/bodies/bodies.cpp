#include <detent/body.h>
#include <detent/contact.h>
#include <detent/draw.h>
#include <detent/numbers.h>
#include <detent/world.h>
#include <stdio.h>
#include <stdlib.h>

#include <chrono>
using namespace detent;

namespace {

/// Ends the program if a call failed.
void must(Status status) {
  if (status == Status::ok) return;
  printf("refused: %s\n", status_text(status));
  exit(1);
}

uint64_t nanoseconds(void*) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

void print_line(void* lines, const Position&, const Position&, DrawKind) { ++*static_cast<int*>(lines); }
void print_solid(void*, BodyId id, const Shape&, const Pose& pose, DrawKind kind) {
  const char* const names[] = {"fixed", "kinematic", "awake", "asleep"};
  printf("  body %u %s at height %.2f m\n", id.slot, names[static_cast<uint32_t>(kind)],
         coord_to_host(pose.position.y));
}

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 8, .contacts = 16}> storage;
  World world;
  must(storage.create({}, world));

  // Create
  BodyId ground, crate, hero, lift;
  must(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  must(create_body(world, {.position = {0.0, 0.5, 0.0}, .shape = box({0.5, 0.5, 0.5}), .mass = 20.0}, crate));
  must(create_body(world,
                   {.position = {3.0, 0.9, 0.0},
                    .shape = capsule(0.3, 0.6),
                    .mass = 80.0,
                    .rotation_locks = k_rotation_lock_x | k_rotation_lock_z},
                   hero));
  must(create_body(world, {.type = BodyType::kinematic, .position = {-3.0, 0.25, 0.0}, .shape = box({1.0, 0.25, 1.0})},
                   lift));

  // Change
  must(set_material(world, crate, {.friction = 0.2, .restitution = 0.5}));
  must(set_damping(world, hero, 0.5, 4.0));
  must(set_type(world, crate, BodyType::fixed));    // fixed,
  must(set_type(world, crate, BodyType::dynamic));  // and dynamic again, with the same mass
  must(set_shape(world, crate, box({0.5, 0.25, 0.5})));
  must(set_density(world, crate, 100.0));
  must(set_inertia(world, crate, {8.0, 12.0, 8.0}));  // kg m^2, about its principal axes
  WorldDef settings = get_settings(world);
  settings.gravity = {0.0, -3.7, 0.0};
  must(set_settings(world, settings));

  // Push
  must(apply_impulse_at_point(world, hero, {40.0, 0.0, 0.0}, {3.0, 1.2, 0.0}));
  must(apply_force_at(world, crate, {0.0, 90.0, 0.0}, {0.5, 0.0, 0.0}));
  must(explode(world, {.centre = {0.0, -1.0, 2.0}, .radius = 4.0, .impulse = 20.0}));
  for (int tick = 0; tick < 240; ++tick) {
    must(move_kinematic(world, lift, {-3.0, tick < 60 ? Coord(0.25) : Coord(0.5), 0.0}, {0.0, 0.0, 0.0, 1.0}));
    step(world);
  }

  // Read
  BodyDef def;
  must(get_body_def(world, crate, def));
  printf("the crate weighs %.1f kg, and lies on\n", scaled_to_host(def.mass));
  const uint32_t count = get_info(world).contacts;
  for (uint32_t i = next_contact(world, crate, 0); i < count; i = next_contact(world, crate, i + 1)) {
    Contact contact;
    must(get_contact(world, i, contact));
    const BodyId other = contact.a == crate ? contact.b : contact.a;
    printf("  body %u with %.0f N at %u points\n", other.slot, scaled_to_host(contact.normal_force),
           contact.point_count);
  }

  // Draw
  int lines = 0;
  printf("the world:\n");
  const DebugDraw callbacks = {.user = &lines, .solid = print_solid, .line = print_line};
  draw(world, callbacks, DrawFlags::bodies | DrawFlags::bounds);
  printf("  and %d edges of bounds\n", lines);

  // Time
  Profile profile;
  profile.now = nanoseconds;
  world.hooks.profile = &profile;
  must(wake_body(world, crate));
  step(world);
  for (uint32_t i = 0; i < k_step_stage_count; ++i) {
    if (profile.ticks[i] > 1000000000u) printf("%s took a second\n", stage_name(static_cast<StepStage>(i)));
  }
  printf("%u steps timed\n", static_cast<unsigned>(profile.steps));
}
