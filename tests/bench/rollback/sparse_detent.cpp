#include <detent/body.h>
#include <detent/numbers.h>
#include <detent/rollback.h>

#include <algorithm>
#include <string>

#include "tests/bench/heap.h"
#include "tests/bench/rollback/engine.h"
#include "tests/campaigns/stress/run_detent.h"
#include "tests/common/queries/random.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;
using SparseRandom = detent_queries::Random;

constexpr uint32_t k_sparse_players = 16, k_sparse_bodies = 1000, k_sparse_settling = 200, k_sparse_window = 8;
constexpr Capacity k_sparse_capacity = {1024, 6144, 0, true, 0, 0};

// Every number here is in range.
Real real(double value) {
  Real result = 0.0;
  static_cast<void>(real_from_host(value, result));
  return result;
}
Coord coord(double value) {
  Coord result = 0.0;
  static_cast<void>(coord_from_host(value, result));
  return result;
}
Vec3<Real> reals(double x, double y, double z) { return {real(x), real(y), real(z)}; }
Position position(double x, double y, double z) { return {coord(x), coord(y), coord(z)}; }

/// The world of a session, with its memory.
struct SparseSeat {
  std::vector<uint64_t> block, memory;
  World world;
  RollbackSession session;
  RollbackReport report;
  bool good = true;

  void require(Status status) { good = good && status == Status::ok; }
  void add(const BodyDef& def) {
    BodyId id;
    require(create_body(world, def, id));
  }
  void add_block(SparseRandom& random, double x, double z, double reach, uint32_t layer) {
    BodyDef def;
    def.shape = box(reals(0.3, 0.25, 0.35));
    const double dx = random.uniform(-reach, reach), dz = random.uniform(-reach, reach);
    def.position = position(x + dx, 0.4 + 0.75 * layer, z + dz);
    def.linear_damping = 0.5;
    def.angular_damping = 2.0;
    add(def);
  }
  void add_wall(double x, double z, double half_x, double half_z) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(half_x, 10, half_z));
    def.position = position(x, 10, z);
    add(def);
  }
  /// Heaps of 50 bodies each, 12 m apart, or one heap between walls. The players' balls, in the heaps, have the first
  /// slots.
  void build(bool apart) {
    block.resize(world_bytes(k_sparse_capacity) / 8);
    WorldDef def;
    def.capacity = k_sparse_capacity;
    def.sleeping = false;
    require(create_world(reinterpret_cast<uint8_t*>(block.data()), static_cast<uint32_t>(block.size() * 8), def, {},
                         world));
    SparseRandom random(7);
    for (uint32_t player = 0; player < k_sparse_players; ++player) {
      BodyDef ball;
      ball.position = apart ? position(12.0 * (player % 5), 0.5, 12.0 * (player / 5))
                            : position(player % 4 - 1.5, 10 + player / 4, 0);
      ball.linear_damping = 1.0;
      add(ball);
    }
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    add(ground);
    if (!apart) {
      for (const double side : {-1.0, 1.0}) {
        add_wall(4.5 * side, 0, 1, 5);
        add_wall(0, 4.5 * side, 5, 1);
      }
    }
    const uint32_t heaps = apart ? 20 : 1;
    for (uint32_t i = k_sparse_players; i < k_sparse_bodies; ++i) {
      const uint32_t heap = i % heaps, layer = i / heaps / (apart ? 9 : 64);
      add_block(random, apart ? 12.0 * (heap % 5) : 0, apart ? 12.0 * (heap / 5) : 0, apart ? 1.2 : 3, layer);
    }
    for (uint32_t tick = 0; tick < k_sparse_settling; ++tick) step(world);
  }
  void begin(bool sparse) {
    RollbackDef def;
    def.players = k_sparse_players;
    def.local = 0;
    def.window = k_sparse_window;
    def.sparse = sparse;
    memory.resize(rollback_bytes(k_sparse_capacity, def) / 8);
    require(session.begin(world, def, {make, this}, reinterpret_cast<uint8_t*>(memory.data()),
                          static_cast<uint32_t>(memory.size() * 8)));
  }
  static void make(void* context, World& world, const TickInputs& inputs) {
    SparseSeat& self = *static_cast<SparseSeat*>(context);
    for (uint32_t player = 0; player < inputs.players; ++player) {
      const Scaled back = -20.0, ahead = 20.0, none = 0.0;
      const Vec3<Scaled> push = {inputs.of(player)[0] == 0 ? back : ahead, none, none};
      self.require(apply_impulse(world, {player + 1, 1}, push));
    }
    step(world);
  }
};

double median_of(std::vector<double>& us) {
  std::sort(us.begin(), us.end());
  return us.empty() ? 0 : us[us.size() / 2];
}

}  // namespace

/// Two sessions, of which one is sparse, play the same match. In each frame the input of one player arrives eight ticks
/// late and is not the predicted one.
SparseRow measure_sparse(bool apart, uint32_t repetitions, const Clock& clock) {
  SparseRow row;
  static const std::string name = stress_engine().config;
  row.config = name.c_str();
  row.scene = apart ? "apart" : "one island";
  SparseSeat seats[2];
  std::vector<double> again[2], forward[2];
  for (uint32_t i = 0; i < 2; ++i) {
    seats[i].build(apart);
    seats[i].begin(i == 0);
    again[i].reserve(repetitions);
    forward[i].reserve(repetitions + k_sparse_window);
    row.bytes_per_tick[i] = static_cast<uint32_t>(seats[i].memory.size() * 8 / k_sparse_window);
  }
  const uint64_t start = seats[0].session.tick(), allocations = heap_use().calls;
  uint64_t ticks_again = 0, whole = 0, bodies = 0;
  for (uint32_t frame = 0; frame < repetitions + k_sparse_window - 1; ++frame) {
    const uint64_t tick = start + frame;
    for (uint32_t i = 0; i < 2; ++i) {
      SparseSeat& seat = seats[i];
      for (uint32_t player = 1; player < k_sparse_players; ++player) {
        const uint8_t input = static_cast<uint8_t>((frame / 5 + player) % 2);
        seat.require(seat.session.add_input(player, tick, &input));
      }
      const uint64_t from = ticks();
      seat.require(seat.session.advance(seat.world, seat.report));
      forward[i].push_back(clock.ns(ticks() - from) / 1000);
      if (frame + 1 < k_sparse_window) continue;
      const uint8_t late = static_cast<uint8_t>(1 - frame % 2);
      seat.require(seat.session.add_input(0, tick + 1 - k_sparse_window, &late));
      const uint64_t back = ticks();
      seat.require(seat.session.correct(seat.world, seat.report));
      if (seat.report.ticks_again == k_sparse_window) again[i].push_back(clock.ns(ticks() - back) / 1000);
      if (i != 0) continue;
      ticks_again += seat.report.ticks_again;
      whole += seat.report.ticks_whole;
      bodies += seat.report.bodies_again;
    }
    row.exact = row.exact && digest(seats[0].world) == digest(seats[1].world);
  }
  row.allocations = heap_use().calls - allocations;
  row.exact = row.exact && seats[0].good && seats[1].good;
  row.bodies = static_cast<double>(bodies) / static_cast<double>(ticks_again);
  row.whole = static_cast<double>(whole) / static_cast<double>(ticks_again);
  for (uint32_t i = 0; i < 2; ++i) {
    row.again[i] = median_of(again[i]);
    row.forward[i] = median_of(forward[i]);
  }
  return row;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
