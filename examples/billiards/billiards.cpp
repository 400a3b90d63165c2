#include "examples/billiards/billiards.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {
namespace {

constexpr uint32_t k_ball_mark = 0x100;  ///< user data of a ball: this + its number; fixed bodies have less

/// A ball slower than this is at rest. The limits are well above the speed that gravity leaves in a resting ball.
constexpr Real k_still_speed = Real(0.02);            // m/s
constexpr Real k_still_angular_velocity = Real(0.7);  // rad/s: 0.02 m/s at the ball's surface

struct Cushion {
  Position centre;
  Vec3<Real> half_extents;
};

constexpr double k_corner_gap = k_corner_mouth * 0.70710678118654752;  ///< from the corner to each nose's end

/// Half of a cushion's height above its nose. Higher than a real rail, so that a hopping ball stays on the table.
constexpr double k_cushion_half_height = 0.02;
constexpr double k_cushion_y = k_nose_height + k_cushion_half_height;

/// `end` is -1 at the head and 1 at the foot, `side` -1 or 1 across. The cushions end square; real ones are cut back at
/// the pockets.
consteval Cushion end_cushion(double end) {
  return {point(end * (k_half_length + k_cushion_width / 2), k_cushion_y, 0.0),
          vector(k_cushion_width / 2, k_cushion_half_height, k_half_width - k_corner_gap)};
}
consteval Cushion side_cushion(double end, double side) {
  const double from = k_side_mouth / 2;
  const double to = k_half_length - k_corner_gap;
  return {point(end * (from + to) / 2, k_cushion_y, side * (k_half_width + k_cushion_width / 2)),
          vector((to - from) / 2, k_cushion_half_height, k_cushion_width / 2)};
}
constexpr Cushion k_cushions[] = {end_cushion(-1),     end_cushion(1),      side_cushion(-1, -1),
                                  side_cushion(1, -1), side_cushion(-1, 1), side_cushion(1, 1)};

/// A ball of the rack: `row` 0 is the apex on the foot spot; `place` counts across, from 0 to `row`.
/// No rack is perfect: the pitch leaves 0.15 mm between balls, and each lies up to 0.05 mm from its place.
consteval Position rack_place(int row, int place, int offset_x, int offset_z) {
  const double pitch = 2 * k_ball_radius + 0.00015;
  return point(k_string + row * pitch * 0.86602540378443865 + offset_x * 1e-6, k_ball_radius,
               (place - row / 2.0) * pitch + offset_z * 1e-6);
}

struct RackedBall {
  uint32_t number;
  Position position;
};
/// Eight-ball: the 8 in the middle, a solid and a stripe in the rear corners, the others at random. Offsets in um.
constexpr RackedBall k_rack[] = {
    {1, rack_place(0, 0, 0, 0)},    {11, rack_place(1, 0, -21, 34)}, {5, rack_place(1, 1, 40, -8)},
    {2, rack_place(2, 0, 13, -47)}, {8, rack_place(2, 1, -36, 22)},  {10, rack_place(2, 2, 5, 29)},
    {9, rack_place(3, 0, 31, 17)},  {7, rack_place(3, 1, -44, -12)}, {14, rack_place(3, 2, 26, -39)},
    {4, rack_place(3, 3, -9, 48)},  {6, rack_place(4, 0, 18, 3)},    {15, rack_place(4, 1, -28, -25)},
    {13, rack_place(4, 2, 45, 11)}, {3, rack_place(4, 3, -2, -43)},  {12, rack_place(4, 4, 37, 20)},
};

/// Places on the head string for a pocketed cue ball. It is put on the first place that no ball is near, or else on the
/// last.
constexpr Position k_cue_places[] = {
    point(-k_string, k_ball_radius, 0.0), point(-k_string, k_ball_radius, 0.15), point(-k_string, k_ball_radius, -0.15),
    point(-k_string, k_ball_radius, 0.3), point(-k_string, k_ball_radius, -0.3),
};

constexpr uint32_t k_cue_place_count = sizeof(k_cue_places) / sizeof(k_cue_places[0]);

constexpr Coord k_nose_x = static_cast<Coord>(k_half_length);
constexpr Coord k_nose_z = static_cast<Coord>(k_half_width);
constexpr Coord k_near = static_cast<Coord>(2.1 * k_ball_radius);

template <class T>
bool within(T value, T limit) {
  return value <= limit && -value <= limit;
}

BodyId create_ball(Recorder& recorder, uint32_t number, const Position& position) {
  BodyDef ball;
  ball.position = position;
  ball.shape = sphere(Real(k_ball_radius));
  ball.material = {Real(k_ball_friction), Real(k_ball_restitution), Real(k_ball_rolling)};
  ball.mass = static_cast<Scaled>(k_ball_mass);
  ball.user_data = k_ball_mark + number;
  return make_body(recorder, ball);
}

Position position_of(const World& world, BodyId ball) {
  Pose pose;
  must(get_pose(world, ball, pose));
  return pose.position;
}

/// A ball is pocketed when its centre passes the line of the noses, which is possible only between the cushions. The
/// slate of a table with common shelves (1 5/8 to 1 7/8 in behind a corner's mouth, 0 to 3/8 in behind a side's:
/// Billiard Congress of America, "Equipment Specifications") ends within 20 mm of that line.
bool is_pocketed(const World& world, BodyId ball) {
  const Position position = position_of(world, ball);
  return !(within(position.x, k_nose_x) && within(position.z, k_nose_z));
}

/// A ball that only angular velocities in place counts as still.
bool is_still(const World& world, BodyId ball) {
  Vec3<Real> linear_velocity, angular_velocity;
  must(get_velocity(world, ball, linear_velocity, angular_velocity));
  return within(linear_velocity.x, k_still_speed) && within(linear_velocity.y, k_still_speed) &&
         within(linear_velocity.z, k_still_speed) && within(angular_velocity.x, k_still_angular_velocity) &&
         within(angular_velocity.z, k_still_angular_velocity);
}

bool is_free(const World& world, const Position& place) {
  for (BodyId ball = next_ball(world, {}); ball.slot != 0; ball = next_ball(world, ball)) {
    const Position position = position_of(world, ball);
    if (within(position.x - place.x, k_near) && within(position.z - place.z, k_near)) return false;
  }
  return true;
}

/// The cue ball, or null if it is pocketed.
BodyId cue_ball(const World& world) {
  BodyId ball = next_ball(world, {});
  while (ball.slot != 0 && ball_number(world, ball) != 0) ball = next_ball(world, ball);
  return ball;
}

BodyId cloth(const World& world) { return next_body(world, {}); }  // the first body made, and never destroyed

}  // namespace

WorldDef world() {
  WorldDef def;
  def.capacity = k_capacity;
  def.tick = Real(0.001);  // a break of 9 m/s moves the cue ball by a third of its radius
  def.substeps = 1;
  return def;
}

void build(Recorder& recorder) {
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = half_space();
  def.material = {Real(k_cloth_friction), Real(k_cloth_restitution), Real(k_cloth_rolling), RestitutionRule::smaller};
  make_body(recorder, def);
  def.material = {Real(k_cushion_friction), Real(k_cushion_restitution), Real(0.0), RestitutionRule::smaller};
  for (const Cushion& cushion : k_cushions) {
    def.position = cushion.centre;
    def.shape = box(cushion.half_extents);
    make_body(recorder, def);
  }
  create_ball(recorder, 0, k_cue_places[0]);
  for (const RackedBall& ball : k_rack) create_ball(recorder, ball.number, ball.position);
}

void before_tick(Recorder& recorder, uint32_t) {
  const World& world = recorder.world();
  bool all_still = true;
  BodyId next;
  for (BodyId ball = next_ball(world, {}); ball.slot != 0; ball = next) {
    next = next_ball(world, ball);
    if (is_pocketed(world, ball)) {
      must(recorder.destroy_body(ball));
    } else {
      all_still = all_still && is_still(world, ball);
    }
  }
  const uint32_t shots = shots_played(world);
  if (!all_still || shots == k_shot_count) return;

  BodyId cue = cue_ball(world);
  if (cue.slot == 0) {
    const Position* place = k_cue_places;
    while (!is_free(world, *place) && place + 1 != k_cue_places + k_cue_place_count) ++place;
    cue = create_ball(recorder, 0, *place);
  }
  must(recorder.set_velocity(cue, k_shots[shots].linear_velocity, k_shots[shots].angular_velocity));
  must(recorder.set_user_data(cloth(world), shots + 1));
}

uint32_t shots_played(const World& world) {
  uint32_t shots = 0;
  must(get_user_data(world, cloth(world), shots));
  return shots;
}

BodyId next_ball(const World& world, BodyId previous) {
  BodyId body = next_body(world, previous);
  uint32_t data = 0;
  while (!is_null(body) && get_user_data(world, body, data) == Status::ok && data < k_ball_mark) {
    body = next_body(world, body);
  }
  return body;
}

uint32_t ball_number(const World& world, BodyId ball) {
  uint32_t data = k_ball_mark;
  must(get_user_data(world, ball, data));
  return data - k_ball_mark;
}

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
