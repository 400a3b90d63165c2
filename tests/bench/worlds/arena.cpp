#include "tests/bench/worlds/arena.h"

#include <detent/numbers.h>
#include <math.h>

#include "examples/rollback/seeded.h"
#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr double k_spacing = 1.3;  // m, of bodies in a layer; there are two layers
constexpr uint32_t k_input_ticks = 16;

Position arena_point(double x, double y, double z) {
  Position point;
  must(coord_from_host(x, point.x));
  must(coord_from_host(y, point.y));
  must(coord_from_host(z, point.z));
  return point;
}
Vec3<Real> arena_extents(double x, double y, double z) {
  Vec3<Real> extents;
  must(real_from_host(x, extents.x));
  must(real_from_host(y, extents.y));
  must(real_from_host(z, extents.z));
  return extents;
}

uint32_t columns_of(const WorldsScene& scene) { return static_cast<uint32_t>(ceil(sqrt((scene.bodies + 1) / 2))); }

/// The place of a body in two layers of columns.
Position place_of(const WorldsScene& scene, uint32_t body) {
  const uint32_t columns = columns_of(scene), layer = body / (columns * columns), at = body % (columns * columns);
  const double middle = (columns - 1) / 2.0;
  return arena_point(k_spacing * (at % columns - middle), 0.5 + layer, k_spacing * (at / columns - middle));
}

void build_walls(Recorder& recorder, const WorldsScene& scene) {
  const double half = k_spacing * (columns_of(scene) / 2.0 + 1);
  for (const double side : {-1.0, 1.0}) {
    BodyDef wall;
    wall.type = BodyType::fixed;
    wall.shape = box(arena_extents(0.5, 2, half + 1));
    wall.position = arena_point(side * (half + 0.5), 2, 0);
    make_body(recorder, wall);
    wall.shape = box(arena_extents(half + 1, 2, 0.5));
    wall.position = arena_point(0, 2, side * (half + 0.5));
    make_body(recorder, wall);
  }
}

}  // namespace

Arena::Arena(const WorldsScene& scene) : scene_(&scene), block_(new uint64_t[world_bytes(capacity(scene)) / 8]) {
  WorldDef def;
  def.capacity = capacity(scene);
  must(create_world(reinterpret_cast<uint8_t*>(block_.get()), world_bytes(def.capacity), def, {}, world));
}

Capacity Arena::capacity(const WorldsScene& scene) {
  return {.bodies = scene.bodies + 5, .contacts = 4 * scene.bodies};  // and the ground and four walls
}

void Arena::build(Recorder& recorder, const WorldsScene& scene) {
  for (uint32_t i = 0; i < scene.bodies; ++i) {
    BodyDef def;
    def.position = place_of(scene, i);
    if (i < scene.players) {
      def.shape = sphere(Real(0.5));
      def.mass = Scaled(60.0);
      def.linear_damping = Real(1.0);
      def.angular_damping = Real(1.0);
    } else {
      def.shape = box(arena_extents(0.45, 0.45, 0.45));
      def.mass = Scaled(20.0);
    }
    make_body(recorder, def);
  }
  make_ground(recorder);
  build_walls(recorder, scene);
}

void Arena::act(Recorder& recorder, const WorldsScene& scene, uint64_t seed) {
  const uint64_t tick = get_info(recorder.world()).tick;
  if (tick < detent_bench::k_worlds_settling) return;
  for (uint32_t player = 0; player < scene.players; ++player) {
    const uint64_t input =
        detent_rollback::mix((seed * scene.players + player) * 0x9e3779b97f4a7c15u + tick / k_input_ticks);
    const Scaled pushes[] = {Scaled(-40.0), Scaled(0.0), Scaled(40.0)};
    must(recorder.apply_impulse({player + 1, 1}, {pushes[input % 3], pushes[1], pushes[input / 3 % 3]}));
  }
}

void Arena::build() {
  Recorder recorder(world, {}, nullptr, 0);
  build(recorder, *scene_);
}

uint64_t Arena::play(uint64_t seed, uint32_t ticks) {
  Recorder recorder(world, {}, nullptr, 0);
  uint64_t awake = 0;
  for (uint32_t i = 0; i < ticks; ++i) {
    act(recorder, *scene_, seed);
    awake += step(world).awake;
  }
  return awake;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
