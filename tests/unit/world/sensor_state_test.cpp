#include <detent/body.h>
#include <detent/distance.h>
#include <detent/recording.h>
#include <detent/world.h>
#include <math.h>
#include <stdlib.h>

#include <random>

#include "broad_phase/pair_filter.h"
#include "contact/body_convex.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/view.h"
#include "tests/unit/world/sensor_lab.h"
#include "world/step_probe.h"

/// The part of the state that sensors use, and tests that no path through a sensor is missed.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Sensors above a ground, and bodies of all kinds that fall and fly through them.
struct Fair {
  Lab lab;
  std::vector<BodyId> solids;

  Fair(bool with_sensors, uint32_t seed) : lab({40, 160, 0, true, 0, 256}, {}, true) {
    std::mt19937 random(seed);
    const auto draw = [&](double low, double high) {
      return low + (high - low) * (static_cast<double>(random()) * 0x1p-32);
    };
    solids.push_back(lab.add_ground());
    for (int i = 0; i < 24; ++i) {
      const double size = draw(0.1, 0.3), x = draw(-3, 3), y = draw(0.5, 5), z = draw(-3, 3);
      BodyDef def = ball_def(size, x, y, z);
      if (i % 3 == 1) def.shape = box(reals(size, size / 2, size));
      if (i % 3 == 2) def.shape = capsule(real(size / 2), real(size));
      const double vx = draw(-40, 40), vy = draw(-20, 20), vz = draw(-40, 40), angular_velocity = draw(-20, 20);
      def.linear_velocity = i % 4 == 0 ? reals(10 * vx, vy, 10 * vz) : reals(vx / 20, vy / 20, vz / 20);
      def.angular_velocity = reals(angular_velocity, angular_velocity / 2, -angular_velocity);
      def.material.restitution = real(0.5);
      def.linear_damping = real(0.25);
      solids.push_back(lab.add(def));
    }
    if (!with_sensors) return;
    for (int i = 0; i < 6; ++i) {
      const double x = draw(-3, 3), y = draw(0, 2), z = draw(-3, 3), thin = draw(0.005, 0.5), wide = draw(1, 3);
      const BodyType types[] = {BodyType::fixed, BodyType::kinematic, BodyType::dynamic};
      BodyDef def = sensor_def(box(reals(thin, wide, 2)), x, y, z, types[i % 3]);
      if (i % 3 == 1) def.angular_velocity = reals(0, 3, 1);
      if (i % 3 == 1) def.linear_velocity = reals(-x, 0.25, -z);
      if (i == 2) def.gravity_scale = real(0);
      lab.add(def);
    }
  }
};

DETENT_TEST(sensor, no_other_body_is_moved_by_one_by_a_bit) {
  Fair with(true, 7), without_sensors(false, 7);
  for (int tick = 0; tick < 240; ++tick) {
    with.lab.run(1);
    without_sensors.lab.run(1);
    for (const BodyId id : with.solids) {
      Pose a, b;
      Vec3<Real> velocity_a, velocity_b, angular_velocity_a, angular_velocity_b;
      ASSERT_OK(get_pose(with.lab.world, id, a));
      ASSERT_OK(get_pose(without_sensors.lab.world, id, b));
      ASSERT_OK(get_velocity(with.lab.world, id, velocity_a, angular_velocity_a));
      ASSERT_OK(get_velocity(without_sensors.lab.world, id, velocity_b, angular_velocity_b));
      ASSERT_TRUE(a.position == b.position && a.rotation == b.rotation && velocity_a == velocity_b &&
                  angular_velocity_a == angular_velocity_b)
          << "tick " << tick << " slot " << id.slot;
      bool awake_a = false, awake_b = false;
      ASSERT_OK(is_awake(with.lab.world, id, awake_a));
      ASSERT_OK(is_awake(without_sensors.lab.world, id, awake_b));
      ASSERT_EQ(awake_a, awake_b);
    }
  }
}

DETENT_TEST(sensor, a_world_put_back_in_mid_overlap_goes_on_with_the_same_events) {
  Fair fair(true, 11);
  std::vector<SensorEvent> events(64), again_events(64);
  fair.lab.world.hooks.sensor_events = {events.data(), 64};
  Lab other(get_info(fair.lab.world).capacity, {}, true);
  other.world.hooks.sensor_events = {again_events.data(), 64};
  uint32_t told = 0;
  for (int tick = 0; tick < 300; ++tick) {
    std::vector<uint64_t> bytes = fair.lab.snapshot();
    ASSERT_OK(tick % 2 == 0 ? load(other.world, bytes_of(bytes), byte_count(bytes))
                            : restore(other.world, bytes_of(bytes), byte_count(bytes)));
    const StepReport report = fair.lab.run(1), again = other.run(1);
    ASSERT_EQ(digest(fair.lab.world), digest(other.world)) << "tick " << tick;
    ASSERT_EQ(report.events.sensor, again.events.sensor);
    told += report.events.sensor;
    for (uint32_t i = 0; i < report.events.sensor; ++i)
      EXPECT_TRUE(is_event(events[i], again_events[i].type, again_events[i].sensor, again_events[i].body));
  }
  EXPECT_GT(told, 40u);
}

/// The bodies within a sensor, from a test of all pairs at their poses.
std::vector<BodyId> near_by_force(const World& world, BodyId sensor) {
  const StateView<const uint8_t> state = view_of(world);
  std::vector<BodyId> found;
  const auto of = [&](uint32_t slot, Convex& convex, Pose& pose) {
    EXPECT_TRUE(body_convex(state.properties[slot], {}, convex));
    pose = {state.poses[slot].position, state.poses[slot].rotation};
  };
  const uint32_t slot = sensor.slot - 1;
  const BodyProperties& properties = state.properties[slot];
  const PairFilter filter = {state.properties, {}};
  for (uint32_t other = 0; other < state.properties.count; ++other) {
    const BodyProperties& body = state.properties[other];
    const bool senses_fixed = static_cast<BodyType>(properties.type) == BodyType::dynamic;
    if (body.type == 0 || body.sensor != 0 || !filter.lets_through(slot, other)) continue;
    if (static_cast<BodyType>(body.type) == BodyType::fixed && !senses_fixed) continue;
    Convex a, b;
    Pose pose_a, pose_b;
    of(slot, a, pose_a);
    of(other, b, pose_b);
    const Real distance_max = scale_by_power(min(shape_extent(properties), shape_extent(body)), -14);
    bool farther = true;
    EXPECT_OK(farther_than(a, pose_a, b, pose_b, distance_max, farther));
    if (!farther) found.push_back({other + 1, body.generation});
  }
  return found;
}

DETENT_TEST(sensor, whatever_is_called_who_is_within_is_who_overlaps_also_after_a_load) {
  Fair fair(true, 23);
  World& world = fair.lab.world;
  Lab other(get_info(world).capacity, {}, true);
  std::mt19937 random(3);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) * 0x1p-32);
  };
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random()) % end; };
  const int ticks = getenv("DETENT_EMULATED") == nullptr ? 600 : 150;
  uint32_t most = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    for (uint32_t calls = below(3); calls != 0; --calls) {
      const uint32_t slot = below(31), kind = below(9);
      const double x = draw(-3, 3), y = draw(0, 2), z = draw(-3, 3), size = draw(0.1, 0.6);
      const uint32_t choice = below(3) + 1;
      const StateView<const uint8_t> state = view_of(static_cast<const World&>(world));
      const BodyId id = {slot + 1, state.properties[slot].generation};
      const bool ground = slot == 0, sensor = state.properties[slot].sensor != 0;
      Status status = Status::ok;  // what is refused changes nothing
      if (kind == 0 && !ground) status = set_pose(world, id, position(x, y, z), {0.0, 0.0, 0.0, 1.0});
      if (kind == 1) status = set_velocity(world, id, reals(20 * x, 20 * y, 20 * z), reals(x, y, z));
      if (kind == 2 && !ground) status = set_sensor(world, id, !sensor);
      if (kind == 3 && !ground) status = set_type(world, id, static_cast<BodyType>(choice));
      if (kind == 4 && !ground) status = set_shape(world, id, box(reals(size, size / 2, size)));
      if (kind == 5) status = set_filter(world, id, {choice, choice == 1 ? ~0u : 3u, 0, 0});
      if (kind == 6 && !ground) status = destroy_body(world, id);
      if (kind == 7) status = sleep_body(world, id);
      if (kind == 8) {
        BodyDef def = ball_def(size, x, y, z);
        def.sensor = choice == 1;
        BodyId made;
        status = create_body(world, def, made);
      }
      EXPECT_NE(status, Status::feature_missing);
    }
    std::vector<uint64_t> bytes = fair.lab.snapshot();
    ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes))) << tick;
    const StepReport report = fair.lab.run(1);
    other.run(1);
    ASSERT_EQ(digest(world), digest(other.world)) << "tick " << tick;
    EXPECT_EQ(report.lost.sensed, 0u);
    if (view_of(static_cast<const World&>(world)).world.idle != 0) continue;
    for (BodyId id = next_body(world, {}); !(id == BodyId{}); id = next_body(world, id)) {
      bool sensor = false;
      ASSERT_OK(get_sensor(world, id, sensor));
      if (!sensor) continue;
      BodyId within[40];
      uint32_t count = 0;
      ASSERT_OK(get_sensed(world, id, within, 40, count));
      EXPECT_EQ(std::vector<BodyId>(within, within + count), near_by_force(world, id)) << "tick " << tick;
      most = count > most ? count : most;
    }
  }
  EXPECT_GE(most, 5u);
}

DETENT_TEST(sensor, no_bit_of_who_is_within_can_be_flipped_into_a_crash) {
  Fair fair(true, 11);
  fair.lab.run(40);
  ASSERT_GE(get_info(fair.lab.world).sensed, 3u);
  const std::vector<uint64_t> good = fair.lab.snapshot();
  Lab other(get_info(fair.lab.world).capacity, {}, true);
  bool fits = false;
  const Layout layout = layout_of(get_info(fair.lab.world).capacity, fits);
  uint32_t refused = 0, bits = 8 * sizeof(SensedState) * 6;
  for (uint32_t bit = 0; bit < bits; ++bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[layout.sensed + bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    const Status status = load(other.world, bytes_of(bytes), byte_count(bytes));
    refused += status == Status::ok ? 0u : 1u;
    if (status == Status::ok) other.run(2);
  }
  EXPECT_GT(refused, bits / 2);
}

/// A sink that stores a recording in memory.
struct Tape {
  std::vector<uint8_t> bytes;
  size_t at = 0;
  static Status write(void* tape, const uint8_t* from, uint32_t count) {
    static_cast<Tape*>(tape)->bytes.insert(static_cast<Tape*>(tape)->bytes.end(), from, from + count);
    return Status::ok;
  }
  static Status read(void* context, uint8_t* to, uint32_t count, uint32_t& got) {
    Tape& tape = *static_cast<Tape*>(context);
    for (got = 0; got < count && tape.at < tape.bytes.size(); ++got) to[got] = tape.bytes[tape.at++];
    return Status::ok;
  }
};

DETENT_TEST(sensor, a_replay_makes_and_unmakes_the_same_sensors) {
  Tape tape;
  uint8_t buffer[k_recording_buffer_bytes];
  Lab lab(room_for(4));
  Recorder recorder(lab.world, {Tape::write, &tape}, buffer, sizeof buffer);
  ASSERT_OK(recorder.begin());
  BodyId gate, ball;
  ASSERT_OK(recorder.create_body(sensor_def(box(reals(1, 1, 1))), gate));
  ASSERT_OK(recorder.create_body(ball_def(0.25, 0, 0.5, 0), ball));
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  EXPECT_EQ(get_info(lab.world).sensed, 1u);
  ASSERT_OK(recorder.set_sensor(gate, false));
  ASSERT_OK(recorder.set_sensor(ball, true));
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  ASSERT_OK(recorder.end());
  Player player({Tape::read, &tape}, buffer, sizeof buffer);
  ASSERT_OK(player.open());
  EXPECT_EQ(player.info().capacity.sensed, 16u);
  Lab other(player.info().capacity);
  ASSERT_OK(player.start(other.world));
  TickResult result;
  while (!result.finished) ASSERT_OK(player.next_tick(other.world, result));
  EXPECT_EQ(digest(other.world), digest(lab.world));
}

/// Whether the rounded bodies overlap by at least `depth`, for certain.
bool overlap_by(const BodyProperties& a, const BodyPose& pose_a, const BodyProperties& b, const BodyPose& pose_b,
                double depth) {
  Convex convex_a, convex_b;
  EXPECT_TRUE(body_convex(a, {}, convex_a) && body_convex(b, {}, convex_b));
  // Reduces the radius of the ball; for rounded shapes only.
  convex_a.radius -= static_cast<int32_t>(ldexp(depth, 30 - convex_a.radius_exponent));
  if (convex_a.radius < 0) return false;
  bool farther = true;
  EXPECT_OK(farther_than(convex_a, {pose_a.position, pose_a.rotation}, convex_b, {pose_b.position, pose_b.rotation},
                         Real(0.0), farther));
  return !farther;
}

DETENT_TEST(sensor, no_throw_whose_way_overlaps_goes_unnoticed) {
  std::mt19937 random(5);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) * 0x1p-32);
  };
  const int rounds = getenv("DETENT_EMULATED") == nullptr ? 240 : 60;
  int passes = 0, grazes = 0;
  for (int round = 0; round < rounds; ++round) {
    Trap trap(room_for(4));
    BodyDef gate = sensor_def(rounded(box(reals(0.02, 0.4, 0.4)), real(0.01)), 0, 0, 0,
                              round % 2 == 0 ? BodyType::fixed : BodyType::kinematic);
    if (round % 2 != 0) {
      const double angular_velocity = draw(-60, 60), vy = draw(-30, 30);
      gate.angular_velocity = reals(angular_velocity, angular_velocity / 3, -angular_velocity / 2);
      gate.linear_velocity = reals(0, vy, 0);
    }
    const BodyId sensor = trap.lab.add(gate);
    // A plate that reflects the bodies, so that their paths have a bend.
    BodyDef wall;
    wall.type = BodyType::fixed;
    wall.shape = box(reals(0.05, 3, 3));
    wall.position = position(1.2, 0, 0);
    trap.lab.add(wall);
    const double y = draw(-0.8, 0.8), z = draw(-0.8, 0.8), vx = draw(20, 300), vy = draw(-40, 40), vz = draw(-40, 40);
    const double rotation_vector = draw(-80, 80);
    BodyDef def = ball_def(0.05, -1, y, z, reals(vx, vy, vz));
    if (round % 3 != 0) def.shape = capsule(real(0.03), real(0.2));
    def.angular_velocity = reals(rotation_vector, -rotation_vector / 2, rotation_vector / 3);
    def.material.restitution = real(1);
    const BodyId body = trap.lab.add(def);
    SweepSegment segments[64];
    for (int tick = 0; tick < 3; ++tick) {
      StepProbe probe;
      probe.segments = {segments, 64};
      const bool was = !trap.within(sensor).empty();
      const StepReport report = step_probed(trap.lab.world, probe);
      const StateView<const uint8_t> state = view_of(static_cast<const World&>(trap.lab.world));
      const uint32_t slots[2] = {sensor.slot - 1, body.slot - 1};
      const auto pose_then = [&](uint32_t slot, Fraction time) {
        const SweepSegment* last = nullptr;
        for (uint32_t i = 0; i < probe.segment_count; ++i) {
          if (segments[i].body == slot && segments[i].from <= time) last = &segments[i];
        }
        if (last == nullptr) return state.poses[slot];
        BodySweep rest{};
        const double whole = fraction_to_host(k_whole_step - last->from);
        // A segment covers the rest of the tick from its start; this is the part of it up to `time`.
        const double part = whole == 0 ? 0 : fraction_to_host(time - last->from) / whole;
        rest.displacement = last->displacement;
        rest.rotation_vector = last->rotation_vector;
        BodyPose pose = last->start;
        advance_along({rest.displacement, rest.rotation_vector},
                      Fraction::from_raw(static_cast<int64_t>(ldexp(part, 62))), pose);
        return pose;
      };
      bool overlaps = was;
      for (int i = 0; i <= 1000 && !overlaps; ++i) {
        const Fraction time = Fraction::from_raw((int64_t{1} << 62) / 1000 * i);
        overlaps = overlap_by(state.properties[slots[1]], pose_then(slots[1], time), state.properties[slots[0]],
                              pose_then(slots[0], time), sizeof(Coord) == 4 ? 1e-4 : 2e-6);
      }
      const bool noticed = was || report.events.sensor != 0;
      if (overlaps) {
        EXPECT_TRUE(noticed) << "round " << round << " tick " << tick;
      }
      passes += overlaps && !was ? 1 : 0;
      grazes += noticed && !overlaps ? 1 : 0;
      EXPECT_EQ(report.lost.sensed_undecided, 0u);
    }
  }
  EXPECT_GT(passes, rounds / 4);
  EXPECT_LE(grazes, rounds / 20) << "what only comes near is not told";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
