#include "examples/scenes/changes.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace changes {

namespace {

constexpr uint32_t k_platform = 1;  ///< the body indices, in slot order
constexpr uint32_t k_first = 2;
constexpr uint32_t k_bodies = 9;

void ask(Recorder& recorder, BodyId ignored) {
  QueryHit hits[4];
  QueryReport report;
  RayQuery ray;
  ray.origin = {-4.0, 0.5, 0.0};
  ray.displacement = {Real(8.0), Real(0.0), Real(0.0)};
  ray.filter.ignore = ignored;
  ray.all = true;
  must(recorder.query_ray(ray, {hits, 4}, report));
  CastQuery cast;
  cast.shape = capsule(0.25, 0.25);
  cast.position = {0.0, 5.0, 0.0};
  cast.displacement = {Real(0.0), Real(-5.0), Real(0.0)};
  cast.rotation_vector = {Real(0.0), Real(0.0), Real(2.0)};
  must(recorder.query_cast(cast, {hits, 4}, report));
}

/// A change of one body, of which there is one a tick.
void change(Recorder& recorder, BodyId id, uint32_t tick) {
  switch (tick / 2 % 10) {
    case 0:
      must(recorder.set_shape(id, tick % 40 < 20 ? box({0.375, 0.25, 0.3125}) : sphere(0.375)));
      break;
    case 1:
      must(recorder.set_density(id, 1500.0));
      break;
    case 2:
      must(recorder.set_material(id, {Real(0.25), Real(0.5), Real(0.0625), RestitutionRule::larger}));
      break;
    case 3:
      must(recorder.set_damping(id, 0.25, 0.5));
      break;
    case 4:
      must(recorder.set_gravity_scale(id, tick % 40 < 20 ? Real(0.5) : Real(1.0)));
      break;
    case 5:
      must(recorder.set_rotation_locks(id, tick % 40 < 20 ? k_rotation_lock_x | k_rotation_lock_z : 0));
      break;
    case 6:
      must(recorder.set_filter(id, {tick % 40 < 20 ? 2u : 1u, ~0u, 0, 0}));
      break;
    case 7:
      must(recorder.set_type(id, tick % 40 < 20 ? BodyType::fixed : BodyType::dynamic));
      break;
    case 8:
      must(recorder.set_type(id, BodyType::dynamic));
      must(recorder.apply_force_at(id, {Scaled(600.0), Scaled(300.0), Scaled(0.0)},
                                   {Real(0.0), Real(0.125), Real(0.0)}));
      break;
    default:
      must(recorder.set_mass(id, 150.0));
      break;
  }
}

}  // namespace

WorldDef world() { return world_of(12, 60); }

void build(Recorder& recorder) {
  make_ground(recorder);
  BodyDef platform;
  platform.type = BodyType::kinematic;
  platform.shape = box({1.0, 0.125, 1.0});
  platform.position = {0.0, 0.5, 0.0};
  make_body(recorder, platform);
  BodyDef def;
  def.filter.mask = 0xfffffffdu;
  const Coord places[3] = {-1.5, 0.0, 1.5};
  const Coord heights[3] = {1.0, 2.0, 3.0};
  for (const Coord x : places) {
    for (const Coord y : heights) {
      def.shape = box({0.375, 0.375, 0.375});
      def.position = {x, y, 0.0};
      make_body(recorder, def);
    }
  }
}

void before_tick(Recorder& recorder, uint32_t tick) {
  const World& state = recorder.world();
  const BodyId platform = nth_body(state, k_platform);
  // To and fro between two poses, in steps of a quarter of the way.
  const Coord height[4] = {0.5, 0.625, 0.75, 0.625};
  const Quat rotation_vector[2] = {{0.0, 0.28, 0.0, 0.96}, {0.0, 0.0, 0.0, 1.0}};
  must(recorder.move_kinematic(platform, {0.0, height[tick / 8 % 4], 0.0}, rotation_vector[tick / 32 % 2]));
  if (tick % 2 == 1) change(recorder, nth_body(state, k_first + tick / 20 % k_bodies), tick);
  if (tick % 16 == 4) ask(recorder, platform);
  if (tick % 70 == 60) {
    Explosion explosion;
    explosion.centre = {0.25, 0.25, 0.5};
    explosion.radius = 4.0;
    explosion.impulse = 400.0;
    must(recorder.explode(explosion));
  }
  if (tick == 120) {
    WorldDef settings = get_settings(state);
    settings.gravity = {Real(0.5), Real(-6.0), Real(0.0)};
    settings.substeps = 4;
    settings.contact_recycle_distance = 0.0;
    must(recorder.set_settings(settings));
  }
}

}  // namespace changes
}  // namespace DETENT_NAMESPACE
}  // namespace detent
