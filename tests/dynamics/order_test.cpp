#include <string.h>

#include <algorithm>
#include <array>

#include "collision/broadphase.h"
#include "dynamics/contact_order.h"
#include "dynamics/contact_rows.h"
#include "dynamics/island.h"
#include "dynamics/predict.h"
#include "dynamics/solve.h"
#include "tests/oracle/bodies.h"
#include "tests/world/lab.h"
#include "world/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Graph {
  std::vector<BodyTraits> traits;
  std::vector<ContactWork> contacts;
  std::vector<ContactOrder> order;
  std::vector<Island> islands;
  std::vector<uint32_t> island_bodies;
  uint32_t overflows = 0;

  explicit Graph(uint32_t bodies) : traits(bodies) {
    for (uint32_t i = 0; i < bodies; ++i) {
      traits[i].type = static_cast<uint32_t>(BodyType::dynamic);
      traits[i].generation = 1 + i % 3;
    }
  }
  void connect(uint32_t a, uint32_t b) {
    ContactWork work{};
    work.state.body_a = std::min(a, b);
    work.state.body_b = std::max(a, b);
    contacts.push_back(work);
  }
  void colour() {
    const uint32_t body_count = static_cast<uint32_t>(traits.size()), count = static_cast<uint32_t>(contacts.size());
    std::vector<BodyWork> work(body_count, BodyWork{});
    std::vector<BodyActivity> activities(body_count, BodyActivity{});
    std::vector<ContactOrder> spare(count);
    order.resize(count);
    islands.resize(body_count);
    island_bodies.resize(body_count);
    const Span<const BodyTraits> all = {traits.data(), body_count};
    const Span<ContactWork> contact_span = {contacts.data(), count};
    for (ContactWork& contact : contacts)
      contact.static_pair = is_dynamic(contact.state.body_a) && is_dynamic(contact.state.body_b) ? 0 : 1;
    std::vector<uint32_t> slots(body_count);
    for (uint32_t slot = 0; slot < body_count; ++slot) slots[slot] = slot;
    islands.resize(find_islands({slots.data(), body_count}, all, {activities.data(), body_count}, contact_span, {},
                                {work.data(), body_count}, {islands.data(), body_count},
                                {island_bodies.data(), body_count}));
    overflows = order_contacts(all, contact_span, {islands.data(), static_cast<uint32_t>(islands.size())},
                               {work.data(), body_count}, {spare.data(), count}, {order.data(), count});
  }
  bool is_dynamic(uint32_t body) const { return traits[body].type == static_cast<uint32_t>(BodyType::dynamic); }
  /// Every contact once, sorted by (island, colour, key), no dynamic body twice in a colour but the overflow's, which
  /// is counted. Bodies in contact are of one island, and each awake one is listed once.
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
    std::vector<uint32_t> island(traits.size(), UINT32_MAX);
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
    for (uint32_t body = 0; body < traits.size(); ++body) EXPECT_EQ(island[body] != UINT32_MAX, is_dynamic(body));
  }
};

DETENT_TEST(order, contacts_of_one_colour_share_no_dynamic_body) {
  Samples samples = {61};
  for (uint32_t round = 0; round < detent_oracle::rounds(30); ++round) {
    Graph graph(2 + samples.below(60));
    const uint32_t bodies = static_cast<uint32_t>(graph.traits.size());
    for (BodyTraits& traits : graph.traits) {
      if (samples.below(8) == 0) traits.type = static_cast<uint32_t>(BodyType::fixed);
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

DETENT_TEST(order, a_body_that_touches_a_hundred_others_overflows_by_thirty_six) {
  Graph graph(101);
  for (uint32_t i = 1; i <= 100; ++i) graph.connect(0, i);
  graph.colour();
  graph.expect_right();
  EXPECT_EQ(graph.overflows, 36u);
}

DETENT_TEST(order, a_fixed_body_that_touches_a_hundred_others_needs_one_colour) {
  Graph graph(101);
  graph.traits[0].type = static_cast<uint32_t>(BodyType::fixed);
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
  graph.traits[3].generation += 1;
  graph.colour();
  EXPECT_NE(places(graph), before);
}

/// Everything that a solve reads and writes.
struct Scene {
  std::vector<BodyTraits> traits;
  std::vector<BodyPose> poses;
  std::vector<BodyMotion> motions;
  std::vector<BodyWork> work;
  std::vector<ContactWork> contacts;
  std::vector<ContactOrder> order;
  std::vector<BodyActivity> activities;
  std::vector<uint32_t> slots;  ///< of all islands
  StepSettings settings;

  uint32_t body_count() const { return static_cast<uint32_t>(traits.size()); }
  uint32_t contact_count() const { return static_cast<uint32_t>(contacts.size()); }

  explicit Scene(Lab& lab) {
    const auto state = view_of(lab.world);
    const uint32_t used = state.world.slots_used;
    traits.assign(state.traits.data, state.traits.data + used);
    poses.assign(state.poses.data, state.poses.data + used);
    motions.assign(state.motions.data, state.motions.data + used);
    work.resize(used, BodyWork{});
    settings = step_settings(state.world);
    set_substeps(4, settings);
    activities.assign(state.activities.data, state.activities.data + used);
    for (uint32_t slot = 0; slot < used; ++slot)
      start_body(settings, traits[slot], poses[slot], motions[slot], work[slot]);
    for (uint32_t i = 0; i < state.world.contact_count; ++i) {
      const ContactState& before = state.contacts[i];
      const uint32_t a = before.body_a, b = before.body_b;
      const Matrix3 rotation_a = matrix_from(poses[a].rotation), rotation_b = matrix_from(poses[b].rotation);
      ContactGeometry geometry;
      collide({poses[a], traits[a], rotation_a}, {poses[b], traits[b], rotation_b}, real(0.01), geometry);
      if (geometry.count == 0) continue;
      ContactWork contact{};
      contact.state = before;
      contact.state.point_count = static_cast<uint8_t>(geometry.count);
      make_rows(settings,
                {traits[a], poses[a], motions[a], work[a].gyration, work[a].spin, work[a].extent, work[a].fall},
                {traits[b], poses[b], motions[b], work[b].gyration, work[b].spin, work[b].extent, work[b].fall},
                geometry, contact);
      contacts.push_back(contact);
    }
    order.resize(contacts.size());
    std::vector<ContactOrder> spare(contacts.size());
    std::vector<Island> islands(used);
    slots.resize(used);
    std::vector<uint32_t> every(used);
    for (uint32_t slot = 0; slot < used; ++slot) every[slot] = slot;
    const Span<const BodyTraits> all = {traits.data(), used};
    const Span<ContactWork> contact_span = {contacts.data(), contact_count()};
    const uint32_t count = find_islands({every.data(), used}, all, {activities.data(), used}, contact_span, {},
                                        {work.data(), used}, {islands.data(), used}, {slots.data(), used});
    EXPECT_EQ(order_contacts(all, contact_span, {islands.data(), count}, {work.data(), used},
                             {spare.data(), contact_count()}, {order.data(), contact_count()}),
              0u);
    slots.resize(islands[count - 1].first_body + islands[count - 1].body_count);
    predict(settings, all, {slots.data(), static_cast<uint32_t>(slots.size())}, {motions.data(), used},
            {work.data(), used});
  }
  /// All islands at once: they do not touch.
  void run() {
    const SolverBodies bodies = {
        {traits.data(), body_count()}, {motions.data(), body_count()}, {work.data(), body_count()}};
    solve(settings, bodies, {slots.data(), static_cast<uint32_t>(slots.size())}, {order.data(), contact_count()},
          {contacts.data(), contact_count()}, {});
  }
  /// The motions and the contacts' states, all bytes.
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

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
