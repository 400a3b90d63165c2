#include <detent/numbers.h>
#include <detent/query.h>
#include <stdio.h>
using namespace detent;

// Filter categories: a ray that tests for guards passes through ghosts.
constexpr uint32_t k_wall = 1, k_guard = 2, k_ghost = 4;

// A ghost touches only bodies with the same user data. The function must be pure, because replays call it again.
bool haunts(const FilterBody& own, const FilterBody& other) { return own.user_data == other.user_data; }
constexpr FilterRule k_rules[] = {haunts};

int main() {
  static WorldStorage<Capacity{.bodies = 8, .contacts = 16}> storage;
  World world;
  BodyId ground, wall, guard, ghost;
  if (storage.create({}, {.filter_rules = {k_rules, 1}}, world) != Status::ok) return 1;
  BodyDef def = {.type = BodyType::fixed, .shape = half_space()};
  if (create_body(world, def, ground) != Status::ok) return 1;
  def = {.type = BodyType::fixed, .position = {4.0, 1.0, 0.0}, .shape = box({0.25, 1.0, 2.0})};
  if (create_body(world, def, wall) != Status::ok) return 1;
  def = {.position = {8.0, 1.0, 0.0}, .shape = capsule(0.5, 0.5), .filter = {.category = k_guard}};
  if (create_body(world, def, guard) != Status::ok) return 1;
  def = {.position = {2.0, 2.0, 0.0},
         .shape = sphere(0.5),
         .gravity_scale = 0.0,
         .user_data = 13,
         .filter = {.category = k_ghost, .rule = 1}};
  if (create_body(world, def, ghost) != Status::ok) return 1;
  step(world);

  // The first hit in sight, without ghosts.
  QueryHit hit;
  QueryReport report;
  RayQuery sight = {.origin = {0.0, 1.5, 0.0}, .displacement = {16.0, 0.0, 0.0}, .filter = {.mask = k_wall | k_guard}};
  if (query_ray(world, sight, {&hit, 1}, report) != Status::ok || report.hits == 0) return 1;
  printf("in sight: body %u at %.2f m\n", hit.body.slot, 16 * fraction_to_host(hit.fraction));

  // All bodies in the path of a bullet, nearest first. An undecided hit would count as a hit.
  QueryHit hits[4];
  sight.all = true;
  sight.origin.y = 1.75;
  sight.filter = {};
  if (query_ray(world, sight, {hits, 4}, report) != Status::ok) return 1;
  for (uint32_t i = 0; i < report.hits; ++i)
    printf("  %u. body %u at %.2f m\n", i + 1, hits[i].body.slot, 16 * fraction_to_host(hits[i].fraction));

  // How far a rotating crate can be thrown before it hits the wall.
  const CastQuery crate = {.shape = box({0.3, 0.2, 0.4}),
                           .position = {0.0, 1.0, 1.0},
                           .displacement = {8.0, 0.0, 0.0},
                           .rotation_vector = {0.0, 0.0, 5.0},
                           .filter = {.mask = k_wall}};
  if (query_cast(world, crate, {&hit, 1}, report) != Status::ok || report.hits == 0) return 1;
  printf("the crate meets body %u after %.2f m, normal (%.1f, %.1f, %.1f)\n", hit.body.slot,
         8 * fraction_to_host(hit.fraction), unit_to_host(hit.normal.x), unit_to_host(hit.normal.y),
         unit_to_host(hit.normal.z));

  // The bodies within the radius of a blast, and the guard nearest to a point.
  const OverlapQuery blast = {.shape = sphere(4.5), .position = {5.0, 5.0, 0.0}, .all = true};
  if (query_overlap(world, blast, {hits, 4}, report) != Status::ok) return 1;
  printf("the blast reaches %u bodies\n", report.hits);
  const ClosestQuery nearest = {
      .shape = sphere(0.0), .position = {7.0, 3.0, 0.0}, .distance_max = 8.0, .filter = {.mask = k_guard}};
  if (query_closest(world, nearest, {&hit, 1}, report) != Status::ok || report.hits == 0) return 1;
  printf("the nearest guard is %.2f m away\n", real_to_host(hit.distance));

  // What can be seen in four directions: a batch of rays, with room for one hit of each.
  RayQuery rays[4];
  for (RayQuery& ray : rays) ray.origin = {6.0, 1.0, 0.0};
  rays[0].displacement = {16.0, 0.0, 0.0};
  rays[1].displacement = {-16.0, 0.0, 0.0};
  rays[2].displacement = {0.0, 0.0, 16.0};
  rays[3].displacement = {0.0, -16.0, 0.0};
  QueryHit seen[4];
  QueryAnswer answers[4];
  if (query_batch(world, rays, 4, seen, 1, answers) != Status::ok) return 1;
  for (uint32_t i = 0; i < 4; ++i) {
    if (answers[i].report.hits != 0) printf("ray %u hits body %u\n", i, seen[i].body.slot);
  }
}
