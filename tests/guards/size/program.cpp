#include <detent/mover.h>
#include <detent/query.h>
#include <detent/recording.h>
#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

// A minimal program of some features (options.csv): one body of each of their shapes falls onto a plane. It prints what
// the table of sizes needs beside the linker's figures.

namespace {

using namespace detent;

void print_value(const char* name, uint32_t value) {
  machine_print(name);
  machine_print(" ");
  print_decimal(value);
  machine_print("\n");
}

#if DETENT_SIZE_WORLD
constexpr Features k_features = DETENT_SIZE_FEATURES;
constexpr bool k_recording = DETENT_SIZE_RECORDING;
constexpr bool has(Features feature) { return contains(k_features, feature); }

// So much fits a machine of 16 KB; a joint takes the place of two contacts and of the manifolds.
constexpr bool k_joint = has(Features::joints);
constexpr bool k_sensor = has(Features::sensors);
constexpr Capacity k_capacity = {8, k_joint ? 5 : 7, 1, !k_joint, k_joint ? 1 : 0, k_sensor ? 2 : 0};
constexpr Coord k_near = 0.75, k_above = 8.0;  ///< the ground: what lands within the ticks, and what does not
constexpr uint32_t k_ticks = 40;

WorldStorage<k_capacity> storage;

/// Where a recording goes: nobody keeps it, but it is made. A replay of it ends at once.
[[maybe_unused]] Status forget(void*, const uint8_t*, uint32_t) { return Status::ok; }
[[maybe_unused]] Status nothing(void*, uint8_t*, uint32_t, uint32_t& got) {
  got = 0;
  return Status::ok;
}

template <class Calls>
bool add(Calls& calls, const Shape& shape, Coord x, Coord y = k_near, bool sensor = false) {
  BodyDef def;
  def.shape = shape;
  def.position = {x, y, Coord(0.0)};
  def.sensor = sensor;
  BodyId id;
  return calls.create_body(def, id) == Status::ok;
}

/// The world's own calls, named as the recorder's are.
struct Direct {
  World& world;
  Status create_body(const BodyDef& def, BodyId& id) { return detent::create_body(world, def, id); }
  Status create_joint(const JointDef& def, JointId& id) { return detent::create_joint(world, def, id); }
  StepReport step() { return detent::step(world); }
};

#if DETENT_SIZE_QUERIES
bool ask(const World& world) {
  QueryHit hit;
  QueryReport report;
  const QueryHits out = {&hit, 1};
  const Position above = {0.0, 8.0, 0.0};
  const Vec3<Real> down = {0.0, -16.0, 0.0};
  CastQuery cast;
  cast.position = above;
  cast.displacement = down;
  return query_ray(world, {above, down}, out, report) == Status::ok && report.hits == 1 &&
         query_cast(world, cast, out, report) == Status::ok && report.hits == 1 &&
         query_overlap(world, {}, out, report) == Status::ok && report.hits == 1 &&
         query_bounds(world, {}, out, report) == Status::ok && report.hits == 1 &&
         query_closest(world, {}, out, report) == Status::ok && report.hits == 1;
}
#else
bool ask(const World&) { return true; }
#endif

/// A rod of 1.25 m between the two balls.
template <class Calls>
bool join(Calls& calls) {
  JointDef def;
  def.type = JointType::distance;
  def.a = {2, 1};
  def.b = {3, 1};
  def.axis.limited = true;
  def.axis.lower = def.axis.upper = Real(1.25);
  JointId id;
  return calls.create_joint(def, id) == Status::ok;
}

#if DETENT_SIZE_MOVER
bool walk(const World& world) {
  MoverReport report;
  Mover mover;
  mover.position = {Coord(0.0), Coord(8.0), Coord(4.0)};
  return move_mover(world, {}, {Real(0.0), Real(-8.0), Real(0.0)}, mover, report) == Status::ok && report.on_ground;
}
#else
bool walk(const World&) { return true; }
#endif

template <class Calls>
bool run(Calls& calls) {
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  BodyId id;
  bool good = calls.create_body(ground, id) == Status::ok;
  if constexpr (has(Features::sphere))
    good = good && add(calls, sphere(0.5), -3.75) && add(calls, sphere(0.5), -2.5, k_near, k_sensor && !k_joint);
  if constexpr (has(Features::capsule)) good = good && add(calls, capsule(0.25, 0.25), -1.25);
  if constexpr (has(Features::box)) good = good && add(calls, box({0.25, 0.25, 0.25}), -0.5);
  if constexpr (has(Features::cylinder)) good = good && add(calls, cylinder(0.25, 0.25), 0.5);
  if constexpr (has(Features::cone)) good = good && add(calls, cone(0.25, 0.25), 1.5, k_joint ? k_above : k_near);
  if constexpr (has(Features::rounding))
    good = good && add(calls, rounded(box({0.25, 0.25, 0.25}), 0.125), 2.5, k_joint ? k_above : k_near, k_sensor);
  if constexpr (has(Features::joints)) good = good && join(calls);
  for (uint32_t tick = 0; tick < k_ticks; ++tick) good = good && calls.step().complete();
  return good;
}

bool run() {
  World world;
  WorldDef def;
  def.continuous = has(Features::continuous);
  def.sleeping = has(Features::sleeping);
  if (storage.create(def, {}, feature_table<k_features>, world) != Status::ok) return false;
  if constexpr (has(Features::hull) || has(Features::terrain)) {
    if (bind_asset(world, 0) != Status::asset_missing) return false;  // there is none, but its code is linked
  }
  bool good = false;
  if constexpr (k_recording) {
    uint8_t buffer[k_recording_buffer_bytes];
    Recorder recorder(world, {forget, nullptr}, buffer, sizeof buffer);
    good = recorder.begin() == Status::ok && run(recorder) && recorder.end() == Status::ok;
    Player player({nothing, nullptr}, buffer, sizeof buffer);
#if DETENT_SIZE_QUERIES
    player.repeat_queries();
#endif
    TickResult result;
    good = good && player.open() == Status::truncated && player.start(world) == Status::truncated &&
           player.next_tick(world, result) == Status::truncated;
  } else {
    Direct direct = {world};
    good = run(direct);
  }
  return good && ask(world) && walk(world) && get_info(world).contacts != 0 && digest(world) != 0;
}
#else
bool run() { return true; }
#endif

}  // namespace

int machine_main(int, char**) {
  const bool good = run();
  print_value("stack", machine_stack_used());
  return good ? 0 : 1;
}
