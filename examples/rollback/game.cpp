#include "examples/rollback/game.h"

#include "examples/rollback/seeded.h"
#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {
namespace {

constexpr uint32_t k_shot_ticks = 90;  ///< lifetime of a shot
constexpr uint32_t k_ball_category = 2;

constexpr double k_goal_half_width = 2, k_wall_half_height = 2, k_wall_half_thickness = 0.25;

uint32_t data_of(Kind kind, uint32_t owner, uint32_t value) {
  return static_cast<uint32_t>(kind) << 24 | owner << 16 | (value & 0xffff);
}

uint32_t data_of(const World& world, BodyId body) {
  uint32_t data = 0;
  must(get_user_data(world, body, data));
  return data;
}

/// Converts literals at compile time, in every configuration.
consteval Position point(double x, double y, double z) {
  return {static_cast<Coord>(x), static_cast<Coord>(y), static_cast<Coord>(z)};
}
consteval Vec3<Real> vector(double x, double y, double z) {
  return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)};
}

struct Wall {
  Position centre;
  Vec3<Real> half_extents;
  bool lets_ball_through;
};

consteval Wall side_wall(double side) {
  return {point(0, k_wall_half_height, side * (k_half_width + k_wall_half_thickness)),
          vector(k_half_length, k_wall_half_height, k_wall_half_thickness), false};
}
/// A wall at one end, from z = `from` to `to`.
consteval Wall end_wall(double end, double from, double to) {
  return {point(end * (k_half_length + k_wall_half_thickness), k_wall_half_height, (from + to) / 2),
          vector(k_wall_half_thickness, k_wall_half_height, (to - from) / 2),
          from == -k_goal_half_width && to == k_goal_half_width};
}
constexpr Wall k_walls[] = {
    side_wall(-1),
    side_wall(1),
    end_wall(-1, -k_half_width, -k_goal_half_width),
    end_wall(-1, -k_goal_half_width, k_goal_half_width),
    end_wall(-1, k_goal_half_width, k_half_width),
    end_wall(1, -k_half_width, -k_goal_half_width),
    end_wall(1, -k_goal_half_width, k_goal_half_width),
    end_wall(1, k_goal_half_width, k_half_width),
};

constexpr Position k_crates[] = {point(-4, 0.4, -3), point(-4, 0.4, 3), point(4, 0.4, -3), point(4, 0.4, 3),
                                 point(-4, 1.2, -3), point(-4, 1.2, 3), point(4, 1.2, -3), point(4, 1.2, 3)};

constexpr Position k_starts[k_players_max] = {point(-6, 0.5, -1), point(6, 0.5, 1), point(-6, 0.5, 1),
                                              point(6, 0.5, -1)};

/// The direction -1, 0 or 1, plus 1: an index into the tables below. A table needs no multiplication, so no rounding.
uint32_t way_x(uint8_t input) { return 1 + (input & k_right ? 1u : 0u) - (input & k_left ? 1u : 0u); }
uint32_t way_z(uint8_t input) { return 1 + (input & k_near ? 1u : 0u) - (input & k_far ? 1u : 0u); }
constexpr Scaled k_pushes[] = {-20.0, 0.0, 20.0};                     // impulse in a tick, N s
constexpr Real k_speeds[] = {Real(-12.0), Real(0.0), Real(12.0)};     // speed of a shot, m/s
constexpr Coord k_steps[] = {Coord(-0.75), Coord(0.0), Coord(0.75)};  // offset of a new shot from the player, m

BodyId make_round(Recorder& recorder, const Position& position, Real radius, Scaled mass, uint32_t data) {
  BodyDef def;
  def.position = position;
  def.shape = sphere(radius);
  def.mass = mass;
  def.material = {Real(0.6), Real(0.5), Real(0.02)};
  def.user_data = data;
  if (data == data_of(Kind::ball, 0, 0)) def.filter.category = k_ball_category;
  return make_body(recorder, def);
}

void make_player(Recorder& recorder, uint32_t player) {
  BodyDef def;
  def.position = k_starts[player];
  def.shape = sphere(Real(0.5));
  def.mass = Scaled(60.0);
  def.linear_damping = Real(2.0);
  def.angular_damping = Real(2.0);
  def.user_data = data_of(Kind::player, player, 0);
  make_body(recorder, def);
}

void make_ball(Recorder& recorder) {
  make_round(recorder, point(0, 0.75, 0), Real(0.35), Scaled(6.0), data_of(Kind::ball, 0, 0));
}

/// The bodies that the rules of the game use.
struct Cast {
  BodyId ground, ball, players[k_players_max], shots[k_players_max];
};

Cast cast_of(const World& world) {
  Cast cast;
  cast.ground = next_body(world, {});  // the first body made, and never destroyed
  for (BodyId body = cast.ground; !is_null(body); body = next_body(world, body)) {
    const Kind kind = kind_of(world, body);
    if (kind == Kind::ball) cast.ball = body;
    if (kind == Kind::player) cast.players[owner_of(world, body)] = body;
    if (kind == Kind::shot) cast.shots[owner_of(world, body)] = body;
  }
  return cast;
}

Position position_of(const World& world, BodyId body) {
  Pose pose;
  must(get_pose(world, body, pose));
  return pose.position;
}

/// When the ball has passed an end, counts the goal and makes a new ball in the middle.
void judge(Recorder& recorder, const Cast& cast) {
  constexpr Coord k_end = static_cast<Coord>(k_half_length + 2 * k_wall_half_thickness);
  const Coord x = position_of(recorder.world(), cast.ball).x;
  const bool right = x >= k_end, left = -x >= k_end;
  if (!right && !left) return;
  const Score before = score(recorder.world());
  const uint32_t goals = ((before.right + (right ? 1 : 0)) & 0xff) << 8 | ((before.left + (left ? 1 : 0)) & 0xff);
  must(recorder.set_user_data(cast.ground, data_of(Kind::pitch, 0, goals)));
  must(recorder.destroy_body(cast.ball));
  make_ball(recorder);
}

void throw_shot(Recorder& recorder, BodyId body, uint32_t player, uint8_t input) {
  uint32_t x = way_x(input);
  const uint32_t z = way_z(input);
  if (x == 1 && z == 1) x = player % 2 == 0 ? 2 : 0;  // a player that does not move throws at the opponents' goal
  Position position = position_of(recorder.world(), body);
  position = {position.x + k_steps[x], position.y + Coord(0.25), position.z + k_steps[z]};
  const uint32_t tick = static_cast<uint32_t>(get_info(recorder.world()).tick);
  const BodyId shot = make_round(recorder, position, Real(0.2), Scaled(8.0), data_of(Kind::shot, player, tick));
  must(recorder.set_velocity(shot, {k_speeds[x], Real(2.0), k_speeds[z]}, {Real(0.0), Real(0.0), Real(0.0)}));
}

void act(Recorder& recorder, const Cast& cast, uint32_t player, uint8_t input) {
  const BodyId shot = cast.shots[player];
  if (!is_null(shot)) {
    const uint32_t tick = static_cast<uint32_t>(get_info(recorder.world()).tick);
    if (((tick - data_of(recorder.world(), shot)) & 0xffff) >= k_shot_ticks) must(recorder.destroy_body(shot));
  } else if ((input & k_throw) != 0) {
    throw_shot(recorder, cast.players[player], player, input);
  }
  const uint32_t x = way_x(input), z = way_z(input);
  if (x != 1 || z != 1) must(recorder.apply_impulse(cast.players[player], {k_pushes[x], Scaled(0.0), k_pushes[z]}));
}

}  // namespace

WorldDef world() {
  WorldDef def;
  def.capacity = k_capacity;
  return def;
}

void build(Recorder& recorder, uint32_t players) {
  make_ground(recorder);
  for (const Wall& wall : k_walls) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.position = wall.centre;
    def.shape = box(wall.half_extents);
    if (wall.lets_ball_through) def.filter.mask = ~k_ball_category;
    make_body(recorder, def);
  }
  for (const Position& place : k_crates) {
    BodyDef def;
    def.position = place;
    def.shape = box(vector(0.4, 0.4, 0.4));
    def.mass = Scaled(15.0);
    def.user_data = data_of(Kind::crate, 0, 0);
    make_body(recorder, def);
  }
  make_ball(recorder);
  for (uint32_t player = 0; player < players; ++player) make_player(recorder, player);
}

void play(Recorder& recorder, const uint8_t* inputs, uint32_t players) {
  const Cast cast = cast_of(recorder.world());
  for (uint32_t player = 0; player < players; ++player) act(recorder, cast, player, inputs[player]);
  judge(recorder, cast);
}

Kind kind_of(const World& world, BodyId body) { return static_cast<Kind>(data_of(world, body) >> 24); }

uint32_t owner_of(const World& world, BodyId body) { return data_of(world, body) >> 16 & 0xff; }

Score score(const World& world) {
  const uint32_t goals = data_of(world, next_body(world, {}));
  return {goals >> 8 & 0xff, goals & 0xff};
}

uint8_t bot_input(uint64_t seed, uint32_t player, uint64_t tick) {
  if (tick < 60) return 0;
  const uint64_t whim = detent_rollback::mix((seed * k_players_max + player) * 0x9e3779b97f4a7c15u + tick / 16);
  const uint8_t ways = static_cast<uint8_t>(whim & 15);
  return static_cast<uint8_t>(ways | (whim >> 4 & 3 ? 0 : k_throw));
}

void build_for_bots(Recorder& recorder) { build(recorder, k_players_max); }

void play_bots(Recorder& recorder, uint32_t tick) {
  uint8_t inputs[k_players_max];
  for (uint32_t player = 0; player < k_players_max; ++player) inputs[player] = bot_input(1, player, tick);
  play(recorder, inputs, k_players_max);
}

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
