#include <detent/world.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

bool friendly(const FilterBody& own, const FilterBody& other) { return own.user_data == other.user_data; }
constexpr FilterRule k_rules[] = {friendly};

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 3, .contacts = 6}> storage;
  World world;
  check(storage.create({.sleeping = false}, {.filter_rules = {k_rules, 1}}, world));

  // Two bodies of one team overlap and push each other apart. The third, of another team, collides with neither.
  BodyDef def = {.shape = sphere(0.5), .gravity_scale = 0.0, .user_data = 7};
  def.filter = {.category = 4, .rule = 1};
  BodyId id;
  check(create_body(world, def, id));
  check(create_body(world, def, id));
  def.user_data = 8;
  check(create_body(world, def, id));
  check(step(world).contacts.count == 1);
}
