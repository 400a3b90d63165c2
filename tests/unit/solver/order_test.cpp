#include <math.h>
#include <string.h>

#include <algorithm>
#include <array>

#include "broad_phase/broadphase.h"
#include "motion/predict.h"
#include "shape/shape_properties.h"
#include "solver/contact_order.h"
#include "solver/contact_rows.h"
#include "solver/island.h"
#include "solver/solve.h"
#include "solver/solve_lanes.h"
#include "solver/substeps.h"
#include "state/view.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Graph {
  std::vector<BodyProperties> properties;
  std::vector<ContactWork> contacts;
  std::vector<ContactOrder> order;
  std::vector<Island> islands;
  std::vector<uint32_t> island_bodies;
  uint32_t overflows = 0;

  explicit Graph(uint32_t bodies) : properties(bodies) {
    for (uint32_t i = 0; i < bodies; ++i) {
      properties[i].type = static_cast<uint32_t>(BodyType::dynamic);
      properties[i].generation = 1 + i % 3;
    }
  }
  void connect(uint32_t a, uint32_t b) {
    ContactWork work{};
    work.state.body_a = std::min(a, b);
    work.state.body_b = std::max(a, b);
    contacts.push_back(work);
  }
  void colour() {
    const uint32_t body_count = static_cast<uint32_t>(properties.size()),
                   count = static_cast<uint32_t>(contacts.size());
    std::vector<BodyWork> work(body_count, BodyWork{});
    std::vector<BodyActivity> activities(body_count, BodyActivity{});
    std::vector<ContactOrder> spare(count);
    order.resize(count);
    islands.resize(body_count);
    island_bodies.resize(body_count);
    const Span<const BodyProperties> all = {properties.data(), body_count};
    const Span<ContactWork> contact_span = {contacts.data(), count};
    for (ContactWork& contact : contacts)
      contact.static_pair = is_dynamic(contact.state.body_a) && is_dynamic(contact.state.body_b) ? 0 : 1;
    std::vector<uint32_t> slots(body_count);
    for (uint32_t slot = 0; slot < body_count; ++slot) slots[slot] = slot;
    islands.resize(find_islands({slots.data(), body_count}, all, {activities.data(), body_count}, contact_span, {},
                                {work.data(), body_count}, {islands.data(), body_count},
                                {island_bodies.data(), body_count}));
    overflows = order_contacts(nullptr, all, contact_span, {islands.data(), static_cast<uint32_t>(islands.size())},
                               {work.data(), body_count}, {spare.data(), count}, {order.data(), count});
  }
  bool is_dynamic(uint32_t body) const { return properties[body].type == static_cast<uint32_t>(BodyType::dynamic); }
  /// Checks that every contact is listed once, sorted by (island, colour, key); that a colour contains each dynamic
  /// body once, except the overflow colour, which is counted; that bodies in contact belong to one island; and that
  /// each awake body is listed once.
  void expect_right() const {
    std::vector<uint32_t> seen(contacts.size(), 0);
    std::vector<std::vector<uint32_t>> users(k_colour_overflow);
    uint32_t overflowed = 0;
    for (size_t i = 0; i < order.size(); ++i) {
      ++seen[order[i].contact];
      if (i > 0) {
        const auto rank = [](const ContactOrder& entry) {
          return std::array<uint32_t, 3>{entry.island, entry.colour, entry.key};
        };
        EXPECT_LE(rank(order[i - 1]), rank(order[i]));
      }
      if (order[i].colour == k_colour_overflow) {
        ++overflowed;
        continue;
      }
      const ContactState& state = contacts[order[i].contact].state;
      for (const uint32_t body : {state.body_a, state.body_b}) {
        if (!is_dynamic(body)) continue;
        std::vector<uint32_t>& taken = users[order[i].colour];
        EXPECT_EQ(std::count(taken.begin(), taken.end(), body), 0) << "colour " << order[i].colour;
        taken.push_back(body);
      }
    }
    for (const uint32_t times : seen) EXPECT_EQ(times, 1u);
    EXPECT_EQ(overflowed, overflows);
    std::vector<uint32_t> island(properties.size(), UINT32_MAX);
    for (uint32_t i = 0; i < islands.size(); ++i) {
      for (uint32_t k = 0; k < islands[i].body_count; ++k) {
        const uint32_t body = island_bodies[islands[i].first_body + k];
        EXPECT_TRUE(is_dynamic(body));
        EXPECT_EQ(island[body], UINT32_MAX);
        island[body] = i;
      }
      for (uint32_t k = 0; k < islands[i].contact_count; ++k) {
        const ContactState& state = contacts[order[islands[i].first_contact + k].contact].state;
        for (const uint32_t body : {state.body_a, state.body_b}) EXPECT_TRUE(!is_dynamic(body) || island[body] == i);
      }
    }
    for (uint32_t body = 0; body < properties.size(); ++body) EXPECT_EQ(island[body] != UINT32_MAX, is_dynamic(body));
  }
};

DETENT_TEST(order, contacts_of_one_colour_share_no_dynamic_body) {
  Samples samples = {61};
  for (uint32_t round = 0; round < detent_oracle::rounds(30); ++round) {
    Graph graph(2 + samples.below(60));
    const uint32_t bodies = static_cast<uint32_t>(graph.properties.size());
    for (BodyProperties& properties : graph.properties) {
      if (samples.below(8) == 0) properties.type = static_cast<uint32_t>(BodyType::fixed);
    }
    std::vector<uint64_t> pairs;
    for (uint32_t i = 0; i < samples.below(400); ++i) {
      const uint32_t a = samples.below(bodies), b = samples.below(bodies);
      if (a != b && (graph.is_dynamic(a) || graph.is_dynamic(b)))
        pairs.push_back(pair_key(std::min(a, b), std::max(a, b)));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const uint64_t key : pairs) graph.connect(pair_low(key), pair_high(key));
    graph.colour();
    graph.expect_right();
  }
}

DETENT_TEST(order, a_body_that_touches_a_hundred_others_overflows_by_thirty_seven) {
  Graph graph(101);
  for (uint32_t i = 1; i <= 100; ++i) graph.connect(0, i);
  graph.colour();
  graph.expect_right();
  EXPECT_EQ(graph.overflows, 37u);
}

DETENT_TEST(order, a_fixed_body_that_touches_a_hundred_others_needs_one_colour) {
  Graph graph(101);
  graph.properties[0].type = static_cast<uint32_t>(BodyType::fixed);
  for (uint32_t i = 1; i <= 100; ++i) graph.connect(0, i);
  graph.colour();
  graph.expect_right();
  EXPECT_EQ(graph.order.back().colour, 0u);
}

DETENT_TEST(order, depends_on_the_ids_alone) {
  Samples samples = {62};
  Graph graph(20);
  for (uint32_t a = 0; a < 20; ++a) {
    for (uint32_t b = a + 1; b < 20; ++b) {
      if (samples.below(3) == 0) graph.connect(a, b);
    }
  }
  const auto places = [](const Graph& g) {
    std::vector<uint64_t> pairs;
    for (const ContactOrder& entry : g.order) {
      const ContactState& state = g.contacts[entry.contact].state;
      pairs.push_back(pair_key(state.body_a, state.body_b) << 8 | entry.colour);
    }
    return pairs;
  };
  graph.colour();
  const std::vector<uint64_t> before = places(graph);
  std::reverse(graph.contacts.begin(), graph.contacts.end());
  graph.colour();
  EXPECT_EQ(places(graph), before);
  graph.properties[3].generation += 1;
  graph.colour();
  EXPECT_NE(places(graph), before);
}

/// Everything that a solve reads and writes.
struct Scene {
  std::vector<BodyProperties> properties;
  std::vector<BodyPose> poses;
  std::vector<BodyMotion> motions;
  std::vector<BodyWork> work;
  std::vector<ContactWork> contacts;
  std::vector<ContactOrder> order;
  std::vector<LaneSpace> lanes;
  std::vector<BodyActivity> activities;
  std::vector<uint32_t> slots;  ///< of all islands
  StepSettings settings;

  uint32_t body_count() const { return static_cast<uint32_t>(properties.size()); }
  uint32_t contact_count() const { return static_cast<uint32_t>(contacts.size()); }

  explicit Scene(Lab& lab) {
    const auto state = view_of(lab.world);
    const uint32_t used = state.world.slots_used;
    properties.assign(state.properties.data, state.properties.data + used);
    poses.assign(state.poses.data, state.poses.data + used);
    motions.assign(state.motions.data, state.motions.data + used);
    work.resize(used, BodyWork{});
    settings = step_settings(state.world);
    set_substeps(4, false, settings);
    activities.assign(state.activities.data, state.activities.data + used);
    for (uint32_t slot = 0; slot < used; ++slot)
      start_body(settings, properties[slot], poses[slot], motions[slot], work[slot]);
    for (uint32_t i = 0; i < state.world.contact_count; ++i) {
      const ContactState& before = state.contacts[i];
      const uint32_t a = before.body_a, b = before.body_b;
      const Matrix3 rotation_a = matrix_from(poses[a].rotation), rotation_b = matrix_from(poses[b].rotation);
      ContactGeometry geometry;
      collide({poses[a], properties[a], rotation_a}, {poses[b], properties[b], rotation_b}, real(0.01), geometry);
      if (geometry.count == 0) continue;
      ContactWork contact{};
      contact.state = before;
      contact.state.point_count = static_cast<uint8_t>(geometry.count);
      for (uint32_t k = geometry.count; k < k_manifold_points_max; ++k) contact.state.normal_impulse[k] = k_zero;
      make_rows(settings,
                {properties[a], poses[a], motions[a], work[a].inverse_inertia, work[a].angular_velocity, work[a].extent,
                 work[a].fall},
                {properties[b], poses[b], motions[b], work[b].inverse_inertia, work[b].angular_velocity, work[b].extent,
                 work[b].fall},
                geometry, k_zero, contact);
      contacts.push_back(contact);
    }
    order.resize(contacts.size());
    std::vector<ContactOrder> spare(contacts.size());
    std::vector<Island> islands(used);
    slots.resize(used);
    std::vector<uint32_t> every(used);
    for (uint32_t slot = 0; slot < used; ++slot) every[slot] = slot;
    const Span<const BodyProperties> all = {properties.data(), used};
    const Span<ContactWork> contact_span = {contacts.data(), contact_count()};
    const uint32_t count = find_islands({every.data(), used}, all, {activities.data(), used}, contact_span, {},
                                        {work.data(), used}, {islands.data(), used}, {slots.data(), used});
    EXPECT_EQ(order_contacts(nullptr, all, contact_span, {islands.data(), count}, {work.data(), used},
                             {spare.data(), contact_count()}, {order.data(), contact_count()}),
              0u);
    slots.resize(islands[count - 1].first_body + islands[count - 1].body_count);
    predict(settings, all, {slots.data(), static_cast<uint32_t>(slots.size())}, {motions.data(), used},
            {work.data(), used});
  }
  /// Solves all islands at once: they do not touch.
  void run() {
    const SolverBodies bodies = {
        {properties.data(), body_count()}, {motions.data(), body_count()}, {work.data(), body_count()}};
    lanes.resize(contact_count() / 4);
    const IslandContacts all = {{order.data(), contact_count()},
                                {contacts.data(), contact_count()},
                                {lanes.data(), static_cast<uint32_t>(lanes.size())}};
    solve(settings, bodies, {slots.data(), static_cast<uint32_t>(slots.size())}, all, {});
  }
  /// All bytes of the motions and of the contact states.
  std::vector<uint8_t> result() const {
    std::vector<uint8_t> bytes(motions.size() * sizeof(BodyMotion) + contacts.size() * sizeof(ContactState));
    memcpy(bytes.data(), motions.data(), motions.size() * sizeof(BodyMotion));
    uint8_t* next = bytes.data() + motions.size() * sizeof(BodyMotion);
    for (const ContactWork& contact : contacts) {
      memcpy(next, &contact.state, sizeof(ContactState));
      next += sizeof(ContactState);
    }
    return bytes;
  }
};

DETENT_TEST(order, contacts_of_one_colour_may_be_solved_in_any_order) {
  Lab lab({40, 300, 0});
  lab.add_ground();
  for (int i = 0; i < 30; ++i)
    lab.add_box(0.5, 0.9 * (i % 3) + 0.05 * (i / 9), 0.5 + 0.99 * (i / 9), 0.9 * (i / 3 % 3));
  lab.run(5);
  const Scene start(lab);
  ASSERT_GT(start.contacts.size(), 40u);
  Scene forward = start;
  forward.run();
  Samples samples = {63};
  for (int round = 0; round < 10; ++round) {
    Scene shuffled = start;
    std::vector<uint64_t> rank(start.contacts.size());
    for (uint64_t& value : rank) value = samples.bits();
    std::sort(shuffled.order.begin(), shuffled.order.end(), [&](const ContactOrder& a, const ContactOrder& b) {
      return a.colour < b.colour || (a.colour == b.colour && rank[a.contact] < rank[b.contact]);
    });
    shuffled.run();
    EXPECT_EQ(shuffled.result(), forward.result());
  }
  Scene backward = start;
  std::reverse(backward.order.begin(), backward.order.end());
  backward.run();
  EXPECT_NE(backward.result(), forward.result()) << "the order of the colours does matter, so the test can tell";
}

/// Contacts of a colour are solved in groups, as many at once as there are lanes. Each group has lanes of its own.
DETENT_TEST(order, contacts_are_grouped_as_the_lanes_permit) {
  if (lanes_of_machine() == 1) GTEST_SKIP() << "this machine, or this build, takes one contact at a time";
  Lab lab({80, 500, 0});
  lab.add_ground();
  for (int i = 0; i < 63; ++i)
    lab.add_box(0.5, 0.9 * (i % 3) + 0.05 * (i / 9), 0.5 + 0.99 * (i / 9), 0.9 * (i / 3 % 3));
  lab.run(5);
  const Scene start(lab);
  Scene one = start;
  one.run();
  for (uint32_t lanes = 4; lanes <= lanes_of_machine(); lanes *= 2) {
    Scene grouped = start;
    grouped.settings.lanes = lanes;
    grouped.run();
    EXPECT_EQ(grouped.result(), one.result()) << lanes;
    const std::vector<ContactOrder>&before = start.order, &order = grouped.order;
    uint32_t full = 0, partial = 0, alone = 0, spaces = 0;
    for (size_t i = 0; i < order.size();) {
      const uint32_t size = group_size(order[i]);
      if (size == 0) {
        ++alone, ++i;
        continue;
      }
      ASSERT_TRUE(size >= 2 && size <= lanes && i + size <= order.size()) << i;
      EXPECT_EQ(order[i].key, spaces) << i;
      spaces += lane_spaces(size);
      for (size_t k = i + 1; k < i + size; ++k) {
        EXPECT_EQ(group_size(order[k]), k_in_group) << k;
        EXPECT_EQ(before[k].colour, before[i].colour) << k;
        EXPECT_EQ(before[k].kind >> k_rows_shift, before[i].kind >> k_rows_shift) << k;
        EXPECT_EQ((before[k].kind & k_point_mask) == 1, (before[i].kind & k_point_mask) == 1) << k;
      }
      ++(size == lanes ? full : partial);
      i += size;
    }
    EXPECT_LE(spaces, order.size() / 4);
    EXPECT_GT(full, 5u) << lanes;
    EXPECT_GT(partial, 0u) << lanes;
    EXPECT_GT(alone, 0u) << lanes;
  }
}

/// One island of boxes, as choose_substeps() sees it.
struct Pile {
  std::vector<BodyProperties> properties;
  std::vector<BodyWork> work;
  std::vector<BodyActivity> activities;
  std::vector<ContactWork> contacts;
  std::vector<ContactOrder> order;
  std::vector<uint32_t> slots;
  Island island{};
  StepSettings settings;

  /// Each body touches the next one. `run`: the run_length of all bodies.
  Pile(uint32_t contact_count, uint32_t run) {
    Lab lab({1, 1, 0});
    lab.add_box(0.5, 0, 0, 0);
    const auto state = view_of(lab.world);
    settings = step_settings(state.world);
    properties.assign(contact_count + 1, state.properties[0]);
    work.assign(properties.size(), BodyWork{});
    activities.assign(properties.size(), BodyActivity{});
    for (uint32_t i = 0; i < properties.size(); ++i) slots.push_back(i);
    for (BodyWork& body : work) {
      body.run_length = run;
      body.extent = shape_extent(properties[0]);
    }
    for (uint32_t i = 0; i < contact_count; ++i) {
      ContactWork contact{};
      contact.state.body_a = i;
      contact.state.body_b = i + 1;
      contact.state.point_count = 4;
      for (Unit& mass : contact.normal_mass) mass = unit(0.25);
      contacts.push_back(contact);
      order.push_back({});
      order.back().contact = i;
    }
    island.body_count = static_cast<uint32_t>(properties.size());
    island.contact_count = contact_count;
  }
  /// The square of the number of substeps that a contact with this load needs, without regard to buckling.
  double needed(double load) const {
    const double sag = load * scaled_to_host(settings.substeps_per_rate) / real_to_host(shape_extent(properties[0]));
    return sag / scaled_to_host(settings.resting_penetration);
  }
  double load_for(double substeps) const { return substeps * substeps / needed(1); }
  uint32_t choose(double load) {
    island.substeps = 0;  // without joints
    for (ContactWork& contact : contacts) contact.state.load = real(load);
    const uint32_t bodies = static_cast<uint32_t>(properties.size()), count = static_cast<uint32_t>(contacts.size());
    choose_substeps(settings, {properties.data(), bodies}, {work.data(), bodies}, {slots.data(), bodies},
                    {order.data(), count}, {&island, 1}, {contacts.data(), count}, {activities.data(), bodies});
    return island.substeps;
  }
};

DETENT_TEST(substeps, are_the_fewest_of_a_few_numbers_that_hold_the_load_and_two_where_there_are_contacts) {
  const uint32_t numbers[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
  EXPECT_EQ(Pile(1, 1).choose(0), 2u);
  EXPECT_EQ(Pile(0, 1).choose(0), 1u) << "nothing touches";
  EXPECT_EQ(Pile(1, 1).choose(Pile(1, 1).load_for(0.5)), 2u);
  for (size_t i = 0; i + 1 < sizeof numbers / sizeof numbers[0]; ++i) {
    Pile light(1, 1), heavy(1, 1);
    light.settings.substeps_max = heavy.settings.substeps_max = 64;
    EXPECT_EQ(light.choose(light.load_for(0.999 * numbers[i])), numbers[i]);
    EXPECT_EQ(heavy.choose(heavy.load_for(1.001 * numbers[i])), numbers[i + 1]);
  }
}

DETENT_TEST(substeps, of_a_row_of_more_than_twelve_prevent_buckling) {
  for (const uint32_t run : {1u, 2u, 3u, 4u, 11u, 13u, 24u}) {
    Pile pile(1, run);
    pile.settings.substeps_max = 64;
    // Buckling decides if the squared length of the row exceeds 144, the inverse of the permitted sag.
    const double buckles = run < 12 ? 1 : run / 12.0;
    EXPECT_EQ(pile.choose(pile.load_for(7.9 / buckles)), 8u) << run;
    EXPECT_EQ(Pile(1, run).choose(pile.load_for(8.1 / buckles)), 12u) << run;
  }
}

/// The limit of the number is inversely proportional to the number of contacts, and lower for contacts with one point.
DETENT_TEST(substeps, of_many_contacts_are_few) {
  for (const uint32_t points : {4u, 3u, 2u, 1u}) {
    const SubstepLimit limit = points < 2 ? k_rolling_limit : k_face_limit;
    const uint32_t room = limit.contact_substeps;
    const auto most = [points](uint32_t contacts) {
      Pile pile(contacts, 1);
      for (ContactWork& contact : pile.contacts) contact.state.point_count = static_cast<uint8_t>(points);
      return pile.choose(Pile(1, 1).load_for(40));
    };
    const uint32_t all = Pile(1, 1).settings.substeps_max;
    EXPECT_EQ(most(1), all);
    EXPECT_EQ(most(room / all), all);
    EXPECT_EQ(most(room / (all / 2)), all / 2);
    EXPECT_EQ(most(room / (limit.always + 1)), limit.always + 1);
    EXPECT_EQ(most(room / limit.always), limit.always);
    EXPECT_EQ(most(room), limit.always);
  }
}

DETENT_TEST(substeps, become_fewer_by_one_notch_after_a_second_in_which_fewer_would_have_done) {
  Pile pile(1, 1);
  pile.settings.substeps_max = 64;
  ASSERT_EQ(pile.choose(pile.load_for(31)), 32u);
  // The number falls from 32 to 24 only if the need is less than 0.6 times the need that 24 substeps satisfy.
  const double light = pile.load_for(23 * sqrt(0.6)), heavier = pile.load_for(25 * sqrt(0.6));
  for (int tick = 0; tick < 200; ++tick) ASSERT_EQ(pile.choose(heavier), 32u);
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(light), 32u) << tick;
  ASSERT_EQ(pile.choose(heavier), 32u) << "the count of calm ticks starts again";
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(light), 32u) << tick;
  EXPECT_EQ(pile.choose(light), 24u);
  EXPECT_EQ(pile.activities[1].substeps, 24u);
  EXPECT_EQ(pile.activities[1].calm_ticks, 0u);
  const double lighter = pile.load_for(15 * sqrt(0.6));
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(lighter), 24u) << tick;
  EXPECT_EQ(pile.choose(lighter), 16u);
  EXPECT_EQ(pile.choose(pile.load_for(31)), 32u) << "more are taken at once";
}

DETENT_TEST(substeps, of_which_half_would_do_become_fewer_by_one_notch_after_eight_ticks) {
  Pile pile(1, 1);
  pile.settings.substeps_max = 64;
  ASSERT_EQ(pile.choose(pile.load_for(31)), 32u);
  // 16 would be enough.
  const double light = pile.load_for(15.9 * sqrt(0.6)), heavier = pile.load_for(16.1 * sqrt(0.6));
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(heavier), 32u) << "more than half is needed: " << tick;
  ASSERT_EQ(pile.choose(pile.load_for(31)), 32u) << "the count of calm ticks starts again";
  for (int tick = 0; tick < 7; ++tick) ASSERT_EQ(pile.choose(light), 32u) << tick;
  EXPECT_EQ(pile.choose(light), 24u);
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(light), 24u) << "more than half is needed: " << tick;
  EXPECT_EQ(pile.choose(light), 16u);
  for (const uint32_t fewer : {12u, 8u, 6u, 4u, 3u}) {
    for (int tick = 0; tick < 7; ++tick) ASSERT_GT(pile.choose(0), fewer) << tick;
    EXPECT_EQ(pile.choose(0), fewer);
  }
  for (int tick = 0; tick < 59; ++tick) ASSERT_EQ(pile.choose(0), 3u) << "two are the least: " << tick;
  EXPECT_EQ(pile.choose(0), 2u);
}

/// Whether choose_substeps() lets the solver limit the warm start of this island.
bool is_limited(Pile pile) {
  pile.choose(0);
  for (const BodyWork& body : pile.work) EXPECT_EQ(body.supports, pile.work[0].supports);
  return pile.work[0].supports != 0;
}

DETENT_TEST(substeps, limit_the_warm_start_where_masses_differ_by_a_factor_of_eight) {
  Pile pile(2, 1);
  for (BodyProperties& body : pile.properties) body.mass = scaled(8);
  EXPECT_FALSE(is_limited(pile));
  pile.properties[1].mass = scaled(1.0625);
  EXPECT_FALSE(is_limited(pile));
  pile.properties[1].mass = scaled(1);
  EXPECT_TRUE(is_limited(pile));
  pile.properties[1].mass = scaled(64);
  EXPECT_TRUE(is_limited(pile)) << "one is heavier, not lighter";
  // The kinematic body is in no island, and is the second body of a contact.
  Pile on_lift = pile;
  on_lift.island.body_count = 2;
  on_lift.properties[2].type = static_cast<uint32_t>(BodyType::kinematic);
  EXPECT_FALSE(is_limited(on_lift));
  Pile pair(1, 1);
  pair.properties[1].mass = scaled(100);
  EXPECT_FALSE(is_limited(pair)) << "one contact";
}

/// The permitted depth decides, except in a row that would buckle.
DETENT_TEST(substeps, follow_the_penetration_that_is_permitted_at_rest) {
  for (const double permitted : {1.0 / 2048, 1.0 / 512, 1.0 / 150, 1.0 / 30, 1.0 / 8}) {
    Pile pile(1, 1), row(1, 24);
    pile.settings.substeps_max = row.settings.substeps_max = 64;
    const double load = pile.load_for(10);
    pile.settings.resting_penetration = row.settings.resting_penetration = scaled(permitted);
    const double needed = 10 * sqrt(1 / (144 * permitted)), buckles = 10 * 24 / 12.0;
    const auto least = [](double need) {
      for (const uint32_t notch : {2u, 3u, 4u, 6u, 8u, 12u, 16u, 24u, 32u, 48u, 64u}) {
        if (notch >= need) return notch;
      }
      return 64u;
    };
    EXPECT_EQ(pile.choose(load), least(needed)) << permitted;
    EXPECT_EQ(row.choose(load), least(fmax(needed, buckles))) << permitted;
  }
}

DETENT_TEST(substeps, of_an_island_with_joints_are_at_most_six_for_the_sag_but_prevent_buckling) {
  for (const double number : {3.9, 5.9, 7.9, 31.0}) {
    Pile sinks(1, 1), buckles(1, 24);
    for (Pile* pile : {&sinks, &buckles}) {
      pile->settings.substeps_max = 64;
      pile->island.joint_count = 1;
    }
    const double load = sinks.load_for(number);
    EXPECT_EQ(sinks.choose(load), number < 4 ? 4u : 6u) << number;
    EXPECT_EQ(buckles.choose(load), number < 4 ? 8u : number < 6 ? 12u : number < 8 ? 16u : 64u) << number;
  }
  Pile large(20480, 1);
  large.island.joint_count = 1;
  EXPECT_EQ(large.choose(large.load_for(31)), 6u) << "six are permitted for any number of contacts";
  for (ContactWork& contact : large.contacts) contact.state.point_count = 1;
  EXPECT_EQ(large.choose(large.load_for(31)), 6u);
}

DETENT_TEST(substeps, contacts_with_joints_are_as_stiff_as_with_24) {
  Pile pile(1, 1);
  StepSettings& settings = pile.settings;
  const auto phase_of = [](double frequency, uint32_t substeps) {
    return 2 * 3.14159265358979 * frequency * (substeps < 24 ? 24.0 / substeps : 1);
  };
  for (const uint32_t substeps : {1u, 2u, 4u, 6u, 12u, 23u, 24u, 64u}) {
    for (const bool jointed : {true, false}) {
      set_substeps(substeps, jointed, settings);
      const struct {
        const Softness& softness;
        double frequency, damping_ratio;
      } kinds[] = {{settings.dynamic_softness, 0.14, 7}, {settings.static_softness, 0.28, 5}};
      for (const auto& kind : kinds) {
        const double phase = phase_of(kind.frequency, jointed ? substeps : 24), sum = 2 * kind.damping_ratio + phase;
        EXPECT_NEAR(unit_to_host(kind.softness.rate), phase / sum, 1e-6) << substeps;
        EXPECT_NEAR(8 * unit_to_host(kind.softness.spring_eighth), 1 / (phase * sum), 1e-6) << substeps;
      }
    }
  }
}

DETENT_TEST(substeps, scale_the_impulses_that_are_carried_over) {
  Pile pile(2, 1);
  pile.settings.substeps_max = 64;
  pile.choose(pile.load_for(7.9));
  for (ContactWork& contact : pile.contacts) {
    contact.state.normal_impulse[3] = real(6);
    contact.friction_impulse[1] = real(-3);
    contact.angular_impulse[2] = real(1.5);
  }
  ASSERT_EQ(pile.choose(pile.load_for(23.9)), 24u);
  for (const ContactWork& contact : pile.contacts) {
    EXPECT_NEAR(real_to_host(contact.state.normal_impulse[3]), 2, 1e-4);
    EXPECT_NEAR(real_to_host(contact.friction_impulse[1]), -1, 1e-4);
    EXPECT_NEAR(real_to_host(contact.angular_impulse[2]), 0.5, 1e-4);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
