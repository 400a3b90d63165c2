#include <detent/body.h>
#include <detent/contact.h>
#include <detent/numbers.h>
#include <detent/recording.h>
#include <detent/world.h>
#include <stdio.h>
#include <string.h>

#include "examples/scenes/make.h"
#include "examples/scenes/scene.h"
#include "tests/guards/environment/settings.h"

// run [unusual | fast]: prints every digest of some scenes, and what the conversions give. The text must be the same in
// all floating-point environments. `unusual`: in settings that the program makes first; `fast`: it was linked with
// -ffast-math, so it must find flush-to-zero on. The exit code is 0 only if the settings were kept by every call.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_ticks = 160;

alignas(8) uint8_t block[1u << 18];

FloatSettings settings;

bool kept(const char* call) {
  if (float_settings() == settings) return true;
  fprintf(stderr, "the floating-point settings were changed by %s\n", call);
  return false;
}

template <class T>
void print_bytes(const T& value) {
  unsigned char bytes[sizeof value];
  memcpy(bytes, &value, sizeof value);
  for (const unsigned char byte : bytes) printf("%02x", byte);
  printf(" ");
}

WorldDef fading_world() { return world_of(1, 0); }

/// A ball whose speed falls through the denormals of float, and later of double, on its way to zero.
void build_fading(Recorder& recorder) {
  BodyDef ball;
  ball.linear_velocity.x = Real(1.0);
  ball.linear_damping = Real(1024.0);
  ball.gravity_scale = Real(0.0);
  make_body(recorder, ball);
}

constexpr Scene k_fading = {"fading", "a ball that slows to nothing", k_ticks, fading_world, build_fading, nullptr};

/// A ray, a cast that turns and what is nearest: their answers.
bool ask(const World& world) {
  CastQuery cast;
  cast.shape = box({Real(0.3), Real(0.1), Real(0.7)});
  cast.position = {Coord(0.1), Coord(8.3), Coord(-0.2)};
  cast.displacement = {Real(0.7), Real(-9.1), Real(0.3)};
  cast.rotation_vector = {Real(0.1), Real(1.3), Real(-0.7)};
  ClosestQuery closest;
  closest.shape = cast.shape;
  closest.position = cast.position;
  closest.all = cast.all = true;
  QueryReport ray, hit, near;
  if (query_ray(world, {cast.position, cast.displacement}, {}, ray) != Status::ok ||
      query_cast(world, cast, {}, hit) != Status::ok || query_closest(world, closest, {}, near) != Status::ok)
    return false;
  const uint64_t sum = ray.digest + 3 * hit.digest + 5 * near.digest;
  printf("answers %08lx%08lx, %u\n", static_cast<unsigned long>(sum >> 32),
         static_cast<unsigned long>(sum & 0xffffffffu), static_cast<unsigned>(hit.dropped));
  return kept("a query");
}

bool run_scene(const Scene* scene) {
  World world;
  if (scene == nullptr ||
      create_world(block, sizeof block, scene->world(), {.assets = scene_assets()}, world) != Status::ok)
    return false;
  Recorder recorder(world, {}, nullptr, 0);
  scene->build(recorder);
  bool all_kept = kept("create_body");
  for (uint32_t tick = 0; tick < k_ticks && all_kept; ++tick) {
    if (scene->before_tick != nullptr) scene->before_tick(recorder, tick);
    all_kept = kept("a change of the world");
    recorder.step();
    all_kept = all_kept && kept("step") && (tick % 16 != 0 || ask(world));
    const uint64_t state = digest(world);
    printf("%s tick %u digest %08lx%08lx\n", scene->name, static_cast<unsigned>(tick + 1),
           static_cast<unsigned long>(state >> 32), static_cast<unsigned long>(state & 0xffffffffu));
  }
  return all_kept;
}

/// Numbers that the settings would touch: inexact ones, a denormal, a NaN; and poses between and beside others.
bool convert_and_view() {
  const uint64_t inputs[] = {0x3fb999999999999a, 0xc00a666666666666, 0x0000000000000123, 0x7ff8000000000000};
  for (const uint64_t bits : inputs) {
    double input;
    memcpy(&input, &bits, sizeof input);
    Real real = 0.0;
    Coord coord = 0.0;
    Scaled scaled = 0.0;
    printf("%s, %s, %s: ", status_text(real_from_host(input, real)), status_text(coord_from_host(input, coord)),
           status_text(scaled_from_host(input, scaled)));
    print_bytes(real_to_host(real));
    print_bytes(coord_to_host(coord));
    print_bytes(scaled_to_host(scaled));
    printf("\n");
  }
  Pose from = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  Pose to = from;
  if (coord_from_host(0.7, to.position.x) != Status::ok || unit_from_host(0.6, to.rotation.y) != Status::ok ||
      unit_from_host(0.8, to.rotation.w) != Status::ok || !kept("a conversion")) {
    return false;
  }
  const Pose between = interpolate(from, to, Unit(0.3));
  const CameraRelative seen = relative_to_camera(between, to.position);
  for (const float value : seen.position) print_bytes(value);
  for (const float value : seen.rotation) print_bytes(value);
  printf("\n");
  return kept("a view");
}

/// Changes, pushes and reads that the scenes don't use.
bool change_and_read() {
  World world;
  BodyId ground, crate, lift;
  BodyDef plane, body;
  plane.type = BodyType::fixed;
  plane.shape = half_space();
  body.position.y = Coord(0.5);
  body.shape = box({0.5, 0.5, 0.5});
  body.angular_velocity = {0.1, 0.2, 0.3};
  if (create_world(block, sizeof block, world_of(3, 9), {}, world) != Status::ok ||
      create_body(world, plane, ground) != Status::ok || create_body(world, body, crate) != Status::ok) {
    return false;
  }
  body.type = BodyType::kinematic;
  body.position.x = Coord(5.0);
  if (create_body(world, body, lift) != Status::ok) return false;
  WorldDef changed = get_settings(world);
  changed.tick = Real(0.013);
  const Quat turned = {0.0, 0.6, 0.0, 0.8};
  for (uint32_t tick = 0; tick < 20; ++tick) {
    const bool done =
        apply_force_at(world, crate, {0.7, 0.1, 0.0}, {0.1, 0.2, 0.3}) == Status::ok &&
        apply_impulse_at_point(world, crate, {0.3, 0.1, 0.0}, {0.0, 0.45, 0.1}) == Status::ok &&
        explode(world, {{0.1, -0.3, 0.2}, 3.3, 0.7}) == Status::ok &&
        move_kinematic(world, lift, {5.1, 0.3, 0.7}, turned) == Status::ok &&
        set_shape(world, lift, cone(0.3, 0.7)) == Status::ok && set_density(world, crate, 3.3) == Status::ok &&
        set_rotation_locks(world, crate, tick % 8) == Status::ok &&
        set_type(world, lift, tick % 2 == 0 ? BodyType::dynamic : BodyType::kinematic) == Status::ok &&
        set_type(world, lift, BodyType::kinematic) == Status::ok && set_settings(world, changed) == Status::ok;
    if (!done || !kept("a change of a body")) return false;
    step(world);
    const uint64_t state = digest(world);
    printf("changed tick %u digest %08lx%08lx", static_cast<unsigned>(tick + 1),
           static_cast<unsigned long>(state >> 32), static_cast<unsigned long>(state & 0xffffffffu));
    BodyDef def;
    Vec3<Scaled> inertia;
    Vec3<Real> linear_velocity;
    Contact contact;
    if (get_body_def(world, crate, def) != Status::ok || get_inertia(world, crate, inertia) != Status::ok ||
        get_velocity_at(world, crate, {0.1, 0.2, 0.3}, linear_velocity) != Status::ok || !kept("a getter")) {
      return false;
    }
    print_bytes(def.angular_velocity);
    print_bytes(inertia);
    print_bytes(linear_velocity);
    if (get_info(world).contacts != 0 && get_contact(world, 0, contact) == Status::ok) {
      print_bytes(contact.normal);
      print_bytes(contact.point[0].position);
      print_bytes(contact.normal_force);
    }
    printf("\n");
  }
  return kept("a contact read");
}

bool run() {
  settings = float_settings();
  return run_scene(find_scene("stack")) && run_scene(find_scene("balls")) && run_scene(find_scene("traffic")) &&
         run_scene(&k_fading) && change_and_read() && convert_and_view();
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent

int main(int argc, char** argv) {
  const char* const mode = argc > 1 ? argv[1] : "";
  if (strcmp(mode, "unusual") == 0 && !set_unusual_floats()) {
    fprintf(stderr, "the target refused the settings\n");
    return 1;
  }
  if (strcmp(mode, "fast") == 0 && !flushes_to_zero()) {
    fprintf(stderr, "-ffast-math did not set flush-to-zero: the test would show nothing\n");
    return 1;
  }
  return detent::run() ? 0 : 1;
}
