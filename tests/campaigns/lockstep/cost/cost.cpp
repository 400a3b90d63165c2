#include <detent/distance.h>
#include <detent/toi.h>
#include <ports/machine.h>
#include <ports/print.h>

#include "float_gjk.h"
#include "math/float_bits.h"
#include "math/rotation.h"
#include "round_hull.h"
#include "shape/hull.h"
#include "tests/campaigns/lockstep/narrow_phase_pairs.h"

/// The cost of queries on a Cortex-M3, in instructions, compared with a float GJK on the same pairs. QEMU runs it with
/// `-icount shift=6` (CMakeLists.txt), so that the board's timer counts instructions. Prints one line of CSV for each
/// query: name, pairs, mean, maximum. Exit code 1 if the two disagree about a distance.

namespace {

using namespace detent;
using detent_lockstep::Random;

constexpr int k_pairs = 64;
constexpr uint64_t k_seed = 7;

/// The board's CMSDK timer counts down at 25 MHz, and an instruction takes 64 ns: 1.6 ticks.
volatile uint32_t* const k_timer = reinterpret_cast<volatile uint32_t*>(0x40000000);
void start_timer() {
  k_timer[2] = 0xffffffff;  // reload
  k_timer[1] = 0xffffffff;  // value
  k_timer[0] = 1;           // on
}

class Cost {
 public:
  template <class Call>
  void measure(const Call& call) {
    const uint32_t ticks = ticks_of(call), none = ticks_of([] {});
    const uint32_t instructions = ((ticks - none) * 5 + 4) / 8;
    sum_ += instructions;
    ++count_;
    if (instructions > most_) most_ = instructions;
  }
  uint32_t most() const { return most_; }
  void print(const char* question) const {
    machine_print(question);
    const uint32_t values[3] = {count_, count_ == 0 ? 0 : (sum_ + count_ / 2) / count_, most_};
    for (const uint32_t value : values) {
      machine_print(",");
      print_decimal(value);
    }
    machine_print("\n");
  }

 private:
  template <class Call>
  static __attribute__((noinline)) uint32_t ticks_of(const Call& call) {
    const uint32_t before = k_timer[1];
    __asm__ volatile("" ::: "memory");
    call();
    __asm__ volatile("" ::: "memory");
    return before - k_timer[1];
  }

  uint32_t sum_ = 0, count_ = 0, most_ = 0;
};

float exact(int32_t numerator, int shift) { return float_from_integer<float>(numerator, -shift); }

Real real_of(int32_t numerator, int shift) {
#if DETENT_FIXED
  return Real::from_raw(int64_t{numerator} << (Real::k_frac - shift));
#else
  return exact(numerator, shift);
#endif
}

/// The same pose for both libraries, in integers.
struct Body {
  int32_t position[3];  ///< 2^-10 m
  Pose pose;
  float_gjk::Pose float_pose;
};

#if DETENT_FIXED
float float_of(Unit value) { return exact(value.raw, Unit::k_frac); }
Unit unit_of(int32_t numerator, int shift) { return Unit::from_raw(numerator * (1 << (Unit::k_frac - shift))); }
float float_of(Real value) { return float_from_integer<float>(value.raw, -Real::k_frac); }
#else
float float_of(float value) { return value; }
Unit unit_of(int32_t numerator, int shift) { return exact(numerator, shift); }
#endif

void set_position(Body& body) {
  const auto coordinate = [&](int i) {
    return Coord::from_raw(static_cast<Coord::Raw>(int64_t{body.position[i]} * (int64_t{1} << (Coord::k_frac - 10))));
  };
  body.pose.position = {coordinate(0), coordinate(1), coordinate(2)};
  body.float_pose.position = {exact(body.position[0], 10), exact(body.position[1], 10), exact(body.position[2], 10)};
}

Body draw_body(Random& random, int32_t far) {
  Body body;
  for (int32_t& coordinate : body.position) coordinate = random.within(far);
  set_position(body);
  int32_t q[4];
  for (int32_t& component : q) component = random.within(7) * 2 + 1;  // odd: never 0
  int32_t square = 0;
  for (const int32_t component : q) square += component * component;
  int shift = 0;
  while (square >> (2 * shift) >= 4) ++shift;
  const Quat rotation =
      normalise_any({unit_of(q[0], shift), unit_of(q[1], shift), unit_of(q[2], shift), unit_of(q[3], shift)});
  body.pose.rotation = rotation;
  body.float_pose.x = float_of(rotation.x);
  body.float_pose.y = float_of(rotation.y);
  body.float_pose.z = float_of(rotation.z);
  body.float_pose.w = float_of(rotation.w);
  return body;
}

struct Solid {
  Convex convex;
  float_gjk::Solid climbing, searching;  ///< the same for a box
};

Solid draw_box(Random& random) {
  const int32_t x = 64 + random.below(960), y = 64 + random.below(960), z = 64 + random.below(960);
  Solid solid;
  if (make_convex(box({real_of(x, 10), real_of(y, 10), real_of(z, 10)}), solid.convex) != Status::ok) {
    machine_panic("a box is refused");
  }
  solid.searching.half_extents = {exact(x, 10), exact(y, 10), exact(z, 10)};
  solid.climbing = solid.searching;
  return solid;
}

float_gjk::Vector float_vertices[64];
uint16_t neighbour_offsets[65];

Solid make_round_hull() {
  Solid solid;
  if (make_hull({k_round_hull, sizeof k_round_hull}, Real(0.0), solid.convex) != Status::ok) {
    machine_panic("the hull is refused");
  }
  const HullView hull = hull_view(k_round_hull);
  const int shift = 30 - hull.exponent();
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    float_vertices[i] = {exact(hull.x(i), shift), exact(hull.y(i), shift), exact(hull.z(i), shift)};
    neighbour_offsets[i + 1] = static_cast<uint16_t>(neighbour_offsets[i] + hull.neighbours(i).count);
  }
  solid.searching.is_box = false;
  solid.searching.vertices = float_vertices;
  solid.searching.vertex_count = hull.vertex_count;
  solid.climbing = solid.searching;
  solid.climbing.neighbour_offsets = neighbour_offsets;
  solid.climbing.neighbours = hull.neighbours(0).index;
  return solid;
}

float magnitude(float value) { return value < 0 ? -value : value; }

/// Pairs that are apart, by metres at most. `draw`: makes a solid. The warm queries use pairs that moved by some
/// millimetres. `searching_name`: null if no float support searches.
template <class Draw>
bool measure_distance(const char* const (&names)[4], const char* searching_name, const Draw& draw) {
  Random random(k_seed);
  Cost cold, warm, farther, climbing, searching;
  bool good = true;
  for (int i = 0; i < k_pairs;) {
    const Solid a = draw(random), b = draw(random);
    const Body body_a = draw_body(random, 1 << 10);
    Body body_b = draw_body(random, 1 << 11);
    Closest closest;
    DistanceCache cache;
    if (closest_points(a.convex, body_a.pose, b.convex, body_b.pose, closest, &cache) != Status::ok) return false;
    if (closest.overlap) continue;
    ++i;
    Status status = Status::ok;
    float_gjk::Result result;
    cold.measure([&] { status = closest_points(a.convex, body_a.pose, b.convex, body_b.pose, closest); });
    climbing.measure(
        [&] { result = float_gjk::distance(a.climbing, body_a.float_pose, b.climbing, body_b.float_pose); });
    good = good && status == Status::ok && magnitude(result.distance - float_of(closest.distance)) < 1e-3f;
    searching.measure(
        [&] { result = float_gjk::distance(a.searching, body_a.float_pose, b.searching, body_b.float_pose); });
    good = good && magnitude(result.distance - float_of(closest.distance)) < 1e-3f;
    bool is_farther = false;
    farther.measure(
        [&] { status = farther_than(a.convex, body_a.pose, b.convex, body_b.pose, real_of(1, 5), is_farther); });
    good = good && status == Status::ok;
    for (int32_t& coordinate : body_b.position) coordinate += random.within(8);
    set_position(body_b);
    warm.measure([&] { status = closest_points(a.convex, body_a.pose, b.convex, body_b.pose, closest, &cache); });
    good = good && status == Status::ok;
  }
  cold.print(names[0]);
  warm.print(names[1]);
  farther.print(names[2]);
  climbing.print(names[3]);
  if (searching_name != nullptr) searching.print(searching_name);
  return good;
}

/// Boxes of which B moves towards A; both rotate by up to a radian.
bool measure_toi() {
  Random random(k_seed);
  Cost hits, misses;
  for (int i = 0; i < k_pairs; ++i) {
    const Solid a = draw_box(random), b = draw_box(random);
    const Body body_a = draw_body(random, 1 << 10), body_b = draw_body(random, 1 << 12);
    Motion motion_a, motion_b;
    motion_a.start = body_a.pose;
    motion_b.start = body_b.pose;
    const int32_t aside[3] = {random.within(1 << 10), random.within(1 << 10), random.within(1 << 10)};
    const auto displacement = [&](int k) { return real_of(body_a.position[k] - body_b.position[k] + aside[k], 10); };
    const Real zero = 0.0;
    motion_a.displacement = {zero, zero, zero};
    motion_b.displacement = {displacement(0), displacement(1), displacement(2)};
    const auto draw_turn = [&] {
      const int32_t rotation_vector[3] = {random.within(148), random.within(148), random.within(148)};
      return Vec3<Real>{real_of(rotation_vector[0], 8), real_of(rotation_vector[1], 8), real_of(rotation_vector[2], 8)};
    };
    motion_a.rotation_vector = draw_turn();
    motion_b.rotation_vector = draw_turn();
    TimeOfImpact impact;
    if (time_of_impact(a.convex, motion_a, b.convex, motion_b, impact) != Status::ok) return false;
    Status status = Status::ok;
    (impact.outcome == ToiOutcome::hit ? hits : misses).measure([&] {
      status = time_of_impact(a.convex, motion_a, b.convex, motion_b, impact);
    });
    if (status != Status::ok) return false;
  }
  hits.print("rotating boxes: time_of_impact of a hit");
  misses.print("rotating boxes: time_of_impact of a miss");
  return true;
}

}  // namespace

int machine_main(int, char**) {
  start_timer();
  machine_print("question,pairs,mean,most\n");
  Cost loop;
  loop.measure([] {
    int32_t left = 1000;  // one instruction, then two each
    __asm__ volatile("1: subs %0, #1\n bne 1b" : "+r"(left)::"cc");
  });
  if (loop.most() != 2001) machine_panic("the timer does not count instructions");
  const Solid hull = make_round_hull();
  bool good = measure_distance(
      {"boxes: closest_points", "boxes: closest_points, warm", "boxes: farther_than 1/32 m", "boxes: float GJK"},
      nullptr, draw_box);
  good = measure_distance({"hulls of 64: closest_points", "hulls of 64: closest_points, warm",
                           "hulls of 64: farther_than 1/32 m", "hulls of 64: float GJK, climbing"},
                          "hulls of 64: float GJK, searching", [&](Random&) { return hull; }) &&
         good;
  good = measure_toi() && good;
  if (!good) machine_print("the answers differ\n");
  return good ? 0 : 1;
}
