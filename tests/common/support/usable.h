#pragma once
#include <detent/contact.h>
#include <detent/query.h>
#include <detent/world.h>

#include "tests/unit/replay/match.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Checks that another world of the same kind can load this state and gets the same digest.
inline void expect_loadable(const World& world) {
  const WorldDef def = get_settings(world);
  std::vector<uint64_t> bytes(snapshot_bytes(def.capacity) / 8);
  EXPECT_OK(save(world, bytes_of(bytes), byte_count(bytes)));
  OwnedWorld other(def, world.hooks.assets);
  other.world.hooks.filter_rules = world.hooks.filter_rules;
  EXPECT_OK(load(other.world, bytes_of(bytes), byte_count(bytes)));
  EXPECT_EQ(digest(other.world), digest(world));
}

/// Checks a state that `load` has accepted: every query returns an answer, and steps lead to states that can be loaded.
inline void expect_usable(World& world) {
  for (BodyId id = next_body(world, {}); !(id == BodyId{}); id = next_body(world, id)) {
    BodyDef def;
    EXPECT_OK(get_body_def(world, id, def));
  }
  for (JointId id = next_joint(world, {}); !(id == JointId{}); id = next_joint(world, id)) {
    JointDef def;
    EXPECT_OK(get_joint(world, id, def));
  }
  for (uint32_t i = 0; i < get_info(world).contacts; ++i) {
    Contact contact;
    EXPECT_OK(get_contact(world, i, contact));
  }
  QueryHit hit[4];
  QueryReport report;
  EXPECT_OK(query_ray(world, {position(0.25, 4, 0.25), reals(0, -8, 0.5), {}, true}, {hit, 4}, report));
  ClosestQuery closest;
  closest.position = position(0, 1, 0);
  closest.all = true;
  EXPECT_OK(query_closest(world, closest, {hit, 4}, report));
  expect_loadable(world);
  const uint64_t tick = get_info(world).tick;
  step(world);
  EXPECT_EQ(step(world).tick, tick + 2);
  expect_loadable(world);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
