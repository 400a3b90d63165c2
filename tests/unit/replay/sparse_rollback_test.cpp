#include <detent/body.h>
#include <detent/joint.h>
#include <detent/rollback.h>

#include <map>

#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/replay/match.h"
#include "tests/unit/world/lab.h"

#if DETENT_SPARSE

/// Two sessions play the same match, one with sparse rollback. Every step of both must have the same results.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Random = detent_queries::Random;

constexpr uint32_t k_players = 4, k_events_max = 1024;
constexpr Capacity k_match_capacity = {120, 600, 4, true, 40, 60}, k_scarce_capacity = {70, 70, 4, true, 9, 6};
/// Matches whose pools are full at times.
Capacity capacity_of_match(uint64_t seed) { return seed % 10 == 3 ? k_scarce_capacity : k_match_capacity; }

/// What a step returned and wrote.
struct Made {
  uint64_t digest = 0;
  StepReport report;
  std::vector<ContactEvent> contacts;
  std::vector<JointEvent> joints;
  std::vector<SensorEvent> sensors;
  std::vector<BodyEvent> bodies;
};

bool is_same(const ContactEvent& a, const ContactEvent& b) {
  return a.type == b.type && a.a == b.a && a.b == b.b && a.normal == b.normal && a.point.x == b.point.x &&
         a.point.y == b.point.y && a.point.z == b.point.z && a.approach_speed == b.approach_speed;
}
bool is_same(const JointEvent& a, const JointEvent& b) {
  return a.joint == b.joint && a.a == b.a && a.b == b.b && a.user_data == b.user_data &&
         a.reaction.force == b.reaction.force && a.reaction.torque == b.reaction.torque;
}
bool is_same(const SensorEvent& a, const SensorEvent& b) {
  return a.type == b.type && a.sensor == b.sensor && a.body == b.body;
}
bool is_same(const BodyEvent& a, const BodyEvent& b) { return a.type == b.type && a.body == b.body; }
template <class Event>
bool is_same(const std::vector<Event>& a, const std::vector<Event>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Event& one, const Event& other) { return is_same(one, other); });
}

#define DETENT_EXPECT_MEMBER(member) EXPECT_EQ(a.member, b.member) << #member
void expect_same(const StepReport& a, const StepReport& b) {
  DETENT_EXPECT_MEMBER(tick);
  DETENT_EXPECT_MEMBER(bodies);
  DETENT_EXPECT_MEMBER(awake);
  DETENT_EXPECT_MEMBER(islands);
  DETENT_EXPECT_MEMBER(substeps_max);
  DETENT_EXPECT_MEMBER(woke);
  DETENT_EXPECT_MEMBER(fell_asleep);
  DETENT_EXPECT_MEMBER(contacts.pairs);
  DETENT_EXPECT_MEMBER(contacts.count);
  DETENT_EXPECT_MEMBER(contacts.points);
  DETENT_EXPECT_MEMBER(contacts.recycled);
  DETENT_EXPECT_MEMBER(contacts.capped);
  DETENT_EXPECT_MEMBER(contacts.sweeps_saved);
  DETENT_EXPECT_MEMBER(contacts.substeps);
  DETENT_EXPECT_MEMBER(contacts.colour_overflows);
  DETENT_EXPECT_MEMBER(joints.count);
  DETENT_EXPECT_MEMBER(joints.broken);
  DETENT_EXPECT_MEMBER(joints.undecided);
  DETENT_EXPECT_MEMBER(saturations);
  DETENT_EXPECT_MEMBER(ccd.impacts);
  DETENT_EXPECT_MEMBER(ccd.undecided);
  DETENT_EXPECT_MEMBER(ccd.overlaps_left);
  DETENT_EXPECT_MEMBER(ccd.bodies_stopped);
  EXPECT_TRUE(a.ccd.lost_time == b.ccd.lost_time);
  DETENT_EXPECT_MEMBER(ccd.tests);
  DETENT_EXPECT_MEMBER(ccd.skipped);
  DETENT_EXPECT_MEMBER(ccd.kept_apart);
  DETENT_EXPECT_MEMBER(lost.pairs);
  DETENT_EXPECT_MEMBER(lost.contacts);
  DETENT_EXPECT_MEMBER(lost.contact_parts);
  DETENT_EXPECT_MEMBER(lost.joint_couplings);
  DETENT_EXPECT_MEMBER(lost.impacts);
  DETENT_EXPECT_MEMBER(lost.sensed);
  DETENT_EXPECT_MEMBER(lost.sensed_undecided);
  DETENT_EXPECT_MEMBER(events.contact);
  DETENT_EXPECT_MEMBER(events.joint);
  DETENT_EXPECT_MEMBER(events.sensor);
  DETENT_EXPECT_MEMBER(events.body);
  DETENT_EXPECT_MEMBER(events.capacity);
  DETENT_EXPECT_MEMBER(events.contact_dropped);
  DETENT_EXPECT_MEMBER(events.joint_dropped);
  DETENT_EXPECT_MEMBER(events.sensor_dropped);
  DETENT_EXPECT_MEMBER(events.body_dropped);
}
#undef DETENT_EXPECT_MEMBER

void expect_same(const Made& a, const Made& b) {
  EXPECT_EQ(a.digest, b.digest);
  expect_same(a.report, b.report);
  EXPECT_TRUE(is_same(a.contacts, b.contacts));
  EXPECT_TRUE(is_same(a.joints, b.joints));
  EXPECT_TRUE(is_same(a.sensors, b.sensors));
  EXPECT_TRUE(is_same(a.bodies, b.bodies));
}

/// A world of separate heaps, chains, platforms and sensors, made from a seed.
class Playground {
 public:
  explicit Playground(uint64_t seed)
      : owned(settings(seed)), random_(seed), spacing_(seed % 3 == 1 ? 5.5 : 9), acts_after_(seed % 9 == 4) {
    for (uint32_t i = 0; i < k_match_capacity.assets; ++i) EXPECT_OK(bind_asset(owned.world, i));
    const uint32_t events = seed % 8 == 5 ? 20 : k_events_max;
    if (seed % 8 != 6) owned.world.hooks.contact_events = {contacts_, events};
    if (seed % 8 != 7) owned.world.hooks.joint_events = {joints_, events};
    if (seed % 16 != 7) owned.world.hooks.sensor_events = {sensors_, events};
    owned.world.hooks.body_events = {bodies_, events};
    if (seed % 12 == 5) ahead_ = std::make_unique<OwnedWorld>(settings(seed));
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    add(ground);
    for (uint32_t player = 0; player < k_players; ++player) add(ball(place(player, 0, 3, 0), 0.5));
    for (uint32_t spot = 0; spot < 9; ++spot) build(spot);
    // Some matches begin when most islands sleep.
    for (uint32_t tick = 0; seed % 10 == 2 && tick < 120; ++tick) step(owned.world);
  }
  Playground(const Playground&) = delete;

  static void make(void* context, World& world, const TickInputs& inputs) {
    Playground& self = *static_cast<Playground*>(context);
    for (uint32_t player = 0; player < inputs.players; ++player)
      self.act(world, inputs.tick, player, *inputs.of(player));
    if (self.ahead_) self.look_ahead(world);
    Made made;
    made.report = step(world);
    made.digest = digest(world);
    const EventReport& events = made.report.events;
    made.contacts.assign(self.contacts_, self.contacts_ + events.contact);
    made.joints.assign(self.joints_, self.joints_ + events.joint);
    made.sensors.assign(self.sensors_, self.sensors_ + events.sensor);
    made.bodies.assign(self.bodies_, self.bodies_ + events.body);
    self.made.push_back(made);
    if (self.acts_after_ && inputs.tick % 7 == 0) allow(wake_body(world, body_at(world, inputs.tick)));
  }

  OwnedWorld owned;
  std::vector<Made> made;

 private:
  static WorldDef settings(uint64_t seed) {
    WorldDef def;
    def.capacity = capacity_of_match(seed);
    def.sleeping = seed % 4 != 0;
    def.continuous = seed % 7 != 0;
    def.iterations = seed % 5 == 0 ? 3 : 1;
    def.substeps = seed % 6 == 0 ? 4 : 0;
    def.stabilisation = seed % 11 == 0 ? Stabilisation::post : Stabilisation::soft;
    def.contact_recycle_distance = seed % 3 == 0 ? Real(0.0) : Real(1.0 / 256);
    return def;
  }
  /// Null if there is no room.
  BodyId add(const BodyDef& def) {
    BodyId id;
    const Status status = create_body(owned.world, def, id);
    EXPECT_TRUE(status == Status::ok || status == Status::pool_full) << status_text(status);
    return id;
  }
  static BodyDef ball(const Position& at, double radius) {
    BodyDef def;
    def.shape = sphere(real(radius));
    def.position = at;
    return def;
  }
  static BodyDef block(const Position& at, double half) {
    BodyDef def;
    def.shape = box(reals(half, half, half));
    def.position = at;
    return def;
  }
  /// A place in a spot of a grid of 3 by 3.
  Position place(uint32_t spot, double x, double y, double z) const {
    return position(spacing_ * (spot % 3) + x, y, spacing_ * (spot / 3) + z);
  }
  void build(uint32_t spot) {
    switch (random_.below(9)) {
      case 0:
        for (uint32_t i = 0; i < 4 + random_.below(3); ++i) add(block(place(spot, 1.5, 0.4 + 0.8 * i, 0), 0.4));
        return;
      case 1:
        for (uint32_t i = 0; i < 8; ++i) {
          BodyDef def = ball(place(spot, random_.uniform(-1, 1), 1 + 0.7 * i, random_.uniform(-1, 1)), 0.35);
          def.material.restitution = real(i % 3 == 0 ? 0.7 : 0);
          def.sensor = i == 7 && random_.chance(0.3);
          add(def);
        }
        return;
      case 2:
      case 3:
        return chain(spot);
      case 4: {
        BodyDef platform = block(place(spot, 0, 1, 2), 0.5);
        platform.type = BodyType::kinematic;
        platform.shape = box(reals(2, 0.2, 1));
        platform.linear_velocity = reals(random_.chance(0.5) ? 0.5 : 0, 0, random_.uniform(-1, 1));
        platform.angular_velocity = reals(0, random_.chance(0.3) ? 0.5 : 0, 0);
        add(platform);
        for (uint32_t i = 0; i < 3; ++i) add(block(place(spot, i - 1.0, 1.6, 2), 0.35));
        return;
      }
      case 5: {
        BodyDef zone = block(place(spot, 0, 1, 0), 1);
        zone.type = random_.chance(0.5) ? BodyType::fixed : BodyType::kinematic;
        zone.shape = box(reals(2.5, 1, 2.5));
        zone.sensor = true;
        if (zone.type == BodyType::kinematic) zone.linear_velocity = reals(0.3, 0, 0);
        add(zone);
        for (uint32_t i = 0; i < 4; ++i) add(ball(place(spot, -1.5 + i, 0.6, 1), 0.3));
        return;
      }
      case 6: {
        BodyDef rough;
        rough.type = BodyType::fixed;
        rough.shape = terrain(random_.chance(0.5) ? k_asset_valley : k_asset_hills);
        rough.position = place(spot, 0, 0.5, 0);
        add(rough);
        for (uint32_t i = 0; i < 4; ++i) {
          BodyDef def = block(place(spot, -1 + 0.8 * i, 3 + i, 0.3), 0.3);
          if (i % 2 == 1) def.shape = hull(k_asset_round);
          add(def);
        }
        return;
      }
      case 7:  // a row of balls in which an impact reaches far within a tick
        for (uint32_t i = 0; i < 7; ++i) {
          BodyDef def = ball(place(spot, 0.9 * i - 3, 0.3, 1.5), 0.3);
          def.material.restitution = real(1);
          add(def);
        }
        return;
      default:
        for (uint32_t i = 0; i < 3; ++i) {
          BodyDef def;
          def.shape = i == 1 ? capsule(real(0.3), real(0.4)) : compound(k_asset_dumbbell);
          def.position = place(spot, 0.3 * i, 1 + 1.5 * i, -1);
          add(def);
        }
    }
  }
  void chain(uint32_t spot) {
    BodyDef post = block(place(spot, 0, 4, -1), 0.2);
    post.type = random_.chance(0.7) ? BodyType::fixed : BodyType::kinematic;
    if (post.type == BodyType::kinematic) post.linear_velocity = reals(0, 0, 0.4);
    BodyId last = add(post);
    const uint32_t links = 3 + random_.below(3);
    for (uint32_t i = 0; i < links; ++i) {
      BodyDef def = block(place(spot, 0.6 * (i + 1), 4, -1), 0.2);
      const BodyId link = add(def);
      JointDef joint;
      joint.type = i % 2 == 0 ? JointType::ball : JointType::hinge;
      joint.a = last;
      joint.b = link;
      joint.anchor_a = reals(i == 0 ? 0 : 0.3, 0, 0);
      joint.anchor_b = reals(i == 0 ? -0.6 : -0.3, 0, 0);
      if (random_.chance(0.3)) joint.break_force = scaled(120);
      JointId id;
      allow(create_joint(owned.world, joint, id));
      last = link;
    }
  }

  /// Makes a step of a copy of the world, as a game does that shows where a shot would go.
  void look_ahead(const World& world) {
    World copy = world;
    copy.block = ahead_->world.block;
    EXPECT_OK(copy_world(world, copy));
    step(copy);
  }

  /// In slot order, beginning with the first after the players.
  static BodyId body_at(const World& world, uint64_t index) {
    const uint32_t bodies = get_info(world).bodies;
    BodyId id = next_body(world, {});
    for (uint32_t i = static_cast<uint32_t>(index % bodies); i != 0; --i) id = next_body(world, id);
    return id;
  }
  static void allow(Status) {}

  /// Lets a ball begin 2 m from a body, above or beside it, and fly towards it at 300 m/s.
  static void aim_at(const World& world, BodyId target, BodyDef& shot) {
    Pose pose;
    if (get_pose(world, target, pose) != Status::ok) return;
    const bool above = target.slot % 3 == 0;
    shot.position = pose.position;
    if (above)
      shot.position.y = shot.position.y + coord(2);
    else
      shot.position.x = shot.position.x - coord(2);
    shot.linear_velocity = above ? reals(0, -300, 0) : reals(300, 0, 0);
    shot.material.restitution = real(1);
  }

  /// The action of a player. It depends on the world, the tick and the input alone.
  void act(World& world, uint64_t tick, uint32_t player, uint8_t input) {
    const BodyId own = {player + 2, 1};
    Random random(tick * 1000 + player * 100 + input);
    const double pushes[4] = {-600, 0, 0, 600};
    if (is_valid(world, own))
      allow(apply_impulse(world, own, scaleds(pushes[input & 3], (input & 15) == 5 ? 900 : 0, pushes[input >> 2 & 3])));
    Pose pose;
    if (get_pose(world, own, pose) != Status::ok) return;
    BodyId id;
    const BodyId any = body_at(world, random.next() >> 8);
    switch (input >> 4) {
      case 1: {  // a fast ball
        BodyDef shot = ball(pose.position, 0.15);
        shot.position.y = shot.position.y + coord(1);
        shot.linear_velocity = reals(random.uniform(-150, 150), random.uniform(-20, 20), random.uniform(-150, 150));
        if (random.chance(0.7)) aim_at(world, any, shot);
        return allow(create_body(world, shot, id));
      }
      case 2:
        if (!(any == body_at(world, 0)) && any.slot > k_players + 1) allow(destroy_body(world, any));
        return;
      case 3:
        return allow(apply_impulse(world, any, scaleds(random.uniform(-900, 900), 700, random.uniform(-900, 900))));
      case 4:
        return allow(sleep_body(world, any));
      case 5: {
        JointDef joint;
        joint.a = own;
        joint.b = any;
        JointId joined;
        if (place_joint(world, pose.position, pose.rotation, joint) == Status::ok)
          allow(create_joint(world, joint, joined));
        return;
      }
      case 6: {
        const JointId first = next_joint(world, {});
        return is_null(first) ? void() : allow(destroy_joint(world, first));
      }
      case 7:
        if (any.slot > 1)
          allow(set_pose(world, any, place(random.below(9), 0, random.uniform(1, 4), 0), {0.0, 0.0, 0.0, 1.0}));
        return;
      case 8:
        if (any.slot > 1) allow(set_velocity(world, any, reals(random.uniform(-3, 3), 0, 1), {}));
        return;
      case 9:
        if (random.chance(0.1)) allow(set_gravity(world, reals(0, random.uniform(-12, -8), 0)));
        return;
      case 10:
        if (any.slot > 1) allow(set_sensor(world, any, random.chance(0.5)));
        return;
      case 11:
        if (any.slot > 1) allow(set_type(world, any, random.chance(0.5) ? BodyType::kinematic : BodyType::dynamic));
        return;
      case 12: {
        Filter filter;
        filter.group = random.chance(0.5) ? -1 : 0;
        return any.slot > 1 ? allow(set_filter(world, any, filter)) : void();
      }
      default:
        return;
    }
  }

  Random random_;
  const double spacing_;
  const bool acts_after_;
  std::unique_ptr<OwnedWorld> ahead_;
  ContactEvent contacts_[k_events_max];
  JointEvent joints_[k_events_max];
  SensorEvent sensors_[k_events_max];
  BodyEvent bodies_[k_events_max];
};

struct Seat {
  std::unique_ptr<Playground> ground;
  std::vector<uint64_t> memory;
  RollbackSession session;
  RollbackReport report;
  uint64_t bodies_again = 0;
  uint32_t ticks_again = 0, ticks_whole = 0;

  Seat(uint64_t seed, bool sparse) : ground(new Playground(seed)) {
    RollbackDef def;
    def.players = k_players;
    def.window = 8;
    def.sparse = sparse;
    memory.resize(rollback_bytes(capacity_of_match(seed), def) / 8);
    EXPECT_OK(session.begin(world(), def, {Playground::make, ground.get()}, reinterpret_cast<uint8_t*>(memory.data()),
                            static_cast<uint32_t>(memory.size() * 8)));
  }
  World& world() { return ground->owned.world; }
  Status advance() {
    ground->made.clear();
    const Status status = session.advance(world(), report);
    if (status != Status::ok) return status;
    bodies_again += report.bodies_again;
    ticks_again += report.ticks_again;
    ticks_whole += report.ticks_whole;
    return status;
  }
};

uint8_t draw_input(Random& random, uint8_t held) {
  if (random.chance(0.06)) return static_cast<uint8_t>(random.below(256));
  return random.chance(0.15) ? static_cast<uint8_t>(random.below(16)) : static_cast<uint8_t>(held & 15);
}

/// Counts of all matches.
struct Sum {
  uint64_t ticks = 0, whole = 0, bodies = 0, bodies_of_all = 0;
};

void play(uint64_t seed, uint32_t ticks, Sum& sum) {
  Seat sparse(seed, true), whole(seed, false);
  Random random(seed * 77 + 5);
  struct Late {
    uint32_t player;
    uint64_t tick;
    uint8_t input;
  };
  std::multimap<uint64_t, Late> late;  // by the frame of arrival
  uint8_t held[k_players] = {5, 5, 5, 5};
  uint64_t given = sparse.session.tick();
  const uint64_t end = given + ticks;
  for (uint64_t frame = 0; sparse.session.tick() < end; ++frame) {
    ASSERT_LT(frame, 3 * ticks) << "the match stands still";
    if (given == sparse.session.tick()) {
      for (uint32_t player = 0; player < k_players; ++player) {
        held[player] = draw_input(random, held[player]);
        // A lost input is sent again.
        const uint64_t delay = random.chance(0.5) ? 0 : random.below(random.chance(0.2) ? 7 : 3);
        if (player != 0) late.insert({frame + delay, {player, given, held[player]}});
      }
      uint64_t tick = 0;
      EXPECT_OK(sparse.session.add_local_input(0, &held[0], tick));
      EXPECT_OK(whole.session.add_local_input(0, &held[0], tick));
      ++given;
    }
    while (!late.empty() && late.begin()->first <= frame) {
      const Late now = late.begin()->second;
      late.erase(late.begin());
      EXPECT_OK(sparse.session.add_input(now.player, now.tick, &now.input));
      EXPECT_OK(whole.session.add_input(now.player, now.tick, &now.input));
    }
    const Status status = sparse.advance();
    ASSERT_EQ(whole.advance(), status);
    if (status == Status::waiting) continue;
    ASSERT_OK(status);
    ASSERT_EQ(sparse.report.ticks_again, whole.report.ticks_again);
    TickChecksum sums[2][20];
    const uint32_t summed = sparse.session.checksums(sums[0], 20);
    ASSERT_EQ(whole.session.checksums(sums[1], 20), summed);
    for (uint32_t i = 0; i < summed; ++i) {
      ASSERT_EQ(sums[0][i].tick, sums[1][i].tick);
      ASSERT_EQ(sums[0][i].checksum, sums[1][i].checksum);
    }
    ASSERT_EQ(sparse.ground->made.size(), whole.ground->made.size());
    for (size_t i = 0; i < sparse.ground->made.size(); ++i) {
      expect_same(sparse.ground->made[i], whole.ground->made[i]);
      if (i + 1 < whole.ground->made.size()) sum.bodies_of_all += whole.ground->made[i].report.awake;
      if (testing::Test::HasFailure()) {
        FAIL() << "match " << seed << ", tick " << whole.ground->made[i].report.tick << ", made again "
               << whole.ground->made.size() - 1 - i;
      }
    }
  }
  sum.ticks += sparse.ticks_again;
  sum.whole += sparse.ticks_whole;
  sum.bodies += sparse.bodies_again;
}

/// Plays `count` short matches. If DETENT_MATCHES is set, this number of longer matches; DETENT_MATCH is the only one.
void play_all(uint32_t count, Sum& sum) {
  const char *const only = getenv("DETENT_MATCH"), *const all = getenv("DETENT_MATCHES");
  uint64_t first = 1, last = all != nullptr ? strtoull(all, nullptr, 10) : count;
  if (only != nullptr) first = last = strtoull(only, nullptr, 10);
  for (uint64_t seed = first; seed <= last && !testing::Test::HasFailure(); ++seed)
    play(seed, only != nullptr || all != nullptr ? 150 : 50, sum);
}

DETENT_TEST(sparse_rollback, has_the_results_of_simulating_all_bodies_again) {
  Sum sum;
  play_all(detent_oracle::rounds(200), sum);
  if (getenv("DETENT_MATCH") != nullptr) return;
  EXPECT_LT(sum.whole * 3, sum.ticks) << "most ticks are made in part";
  EXPECT_LT(sum.bodies * 2, sum.bodies_of_all);
}

/// A row of heaps, far from each other, with a player's ball in each.
struct Heaps {
  static constexpr uint32_t k_count = 8;
  static constexpr Capacity k_capacity = {100, 400, 0, true, 0, 0};
  OwnedWorld owned = OwnedWorld(k_capacity);
  std::vector<uint64_t> memory;
  RollbackSession session;
  RollbackReport report;

  explicit Heaps(RollbackDef def) {
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    BodyId id;
    EXPECT_OK(create_body(owned.world, ground, id));
    for (uint32_t i = 0; i < k_count; ++i) {
      BodyDef ball;
      ball.position = position(20.0 * i, 0.5, 0);
      EXPECT_OK(create_body(owned.world, ball, id));
      for (uint32_t k = 0; k < 6; ++k) {
        BodyDef block;
        block.shape = box(reals(0.4, 0.4, 0.4));
        block.position = position(20.0 * i + 1, 0.4 + 0.8 * k, 0);
        EXPECT_OK(create_body(owned.world, block, id));
      }
    }
    memory.resize(rollback_bytes(k_capacity, def) / 8);
    EXPECT_OK(session.begin(owned.world, def, {make, nullptr}, reinterpret_cast<uint8_t*>(memory.data()),
                            static_cast<uint32_t>(memory.size() * 8)));
  }
  static void make(void*, World& world, const TickInputs& inputs) {
    Status status = Status::ok;
    if (*inputs.of(1) == 1) status = apply_impulse(world, {2, 1}, scaleds(200, 0, 0));
    if (*inputs.of(1) == 2) status = set_gravity(world, reals(0, -5, 0));
    EXPECT_OK(status);
    step(world);
  }
  /// Makes 6 ticks, of which the second gets its input at last, and makes this one and the later ones again.
  void play(uint8_t input) {
    for (uint64_t tick = 0; tick < 6; ++tick) {
      const uint8_t none = 0;
      uint64_t given = 0;
      ASSERT_OK(session.add_local_input(0, &none, given));
      ASSERT_OK(session.advance(owned.world, report));
    }
    const uint8_t none = 0;
    ASSERT_OK(session.add_input(1, 0, &none));
    ASSERT_OK(session.add_input(1, 1, &input));
    ASSERT_OK(session.correct(owned.world, report));
  }
};

RollbackDef sparse_def() {
  RollbackDef def;
  def.sparse = true;
  return def;
}

DETENT_TEST(sparse_rollback, simulates_the_bodies_that_the_input_reaches) {
  Heaps heaps(sparse_def());
  heaps.play(1);
  EXPECT_EQ(heaps.report.ticks_again, 5u);
  EXPECT_EQ(heaps.report.ticks_whole, 0u);
  EXPECT_GE(heaps.report.bodies_again, 5u);
  EXPECT_LE(heaps.report.bodies_again, 5 * 7u) << "of 56 in each tick";
}

DETENT_TEST(sparse_rollback, simulates_all_bodies_if_a_setting_differs) {
  Heaps heaps(sparse_def());
  heaps.play(2);
  EXPECT_EQ(heaps.report.ticks_whole, 5u);
  EXPECT_EQ(heaps.report.bodies_again, 5 * 56u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
