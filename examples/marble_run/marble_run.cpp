#include <detent/numbers.h>
#include <detent/query.h>
#include <stdio.h>

using namespace detent;

// Made by: detent cook --kind mesh track.obj track.mesh. The world reads the asset in place, also from flash. Several
// worlds may share it.
alignas(8) const uint8_t track[] = {
#include "track.inc"
};
constexpr Asset k_assets[] = {{track, sizeof track}};

int main() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 16, .assets = 1}> storage;
  World world;
  BodyId run, marble;
  if (storage.create({}, {.assets = {k_assets, 1}}, world) != Status::ok) return 1;
  // bind_asset checks every byte of the asset.
  if (bind_asset(world, 0) != Status::ok) return 1;
  // Friction and rolling resistance of a pair are means of both materials, so both bodies get this material.
  const Material smooth = {.friction = 0.3, .rolling_resistance = 0.01};
  BodyDef def = {.type = BodyType::fixed, .shape = terrain(0), .material = smooth};
  if (create_body(world, def, run) != Status::ok) return 1;
  def = {.position = {1.0, 2.1, 0.1}, .shape = sphere(0.08), .material = smooth};
  if (create_body(world, def, marble) != Status::ok) return 1;

  Pose pose;
  for (uint32_t tick = 1; tick <= 900; ++tick) {
    if (!step(world).complete() || get_pose(world, marble, pose) != Status::ok) return 1;
    if (tick % 90 != 0) continue;
    printf("%4.1f s: x %5.2f, y %5.2f, z %5.2f\n", tick / 60.0, coord_to_host(pose.position.x),
           coord_to_host(pose.position.y), coord_to_host(pose.position.z));
  }

  // The triangle under the marble. Material 0 is the track, 1 the cup, as track.obj names them.
  const RayQuery down = {.origin = pose.position, .displacement = {0.0, -1.0, 0.0}, .filter = {.ignore = marble}};
  QueryHit hit;
  QueryReport report;
  if (query_ray(world, down, {&hit, 1}, report) != Status::ok || report.hits == 0) return 1;
  bool awake = true;
  if (is_awake(world, marble, awake) != Status::ok) return 1;
  printf("it %s on triangle %u, of %s\n", awake ? "rolls" : "rests", hit.triangle,
         hit.material == 1 ? "the cup" : "the track");
}
