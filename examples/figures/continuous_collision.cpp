#include <detent/toi.h>
#include <detent/world.h>
#include <math.h>

#include "examples/figures/figures.h"
#include "examples/figures/host.h"

using namespace detent;

namespace figures {
namespace {

constexpr double k_tick = 1.0 / 60;
constexpr double k_scale = 170;                               // px / m
constexpr double k_radius = 0.1, k_speed = 54, k_wall = 2.3;  // m, m/s, m
constexpr double k_wall_half = 0.03;
constexpr size_t k_poses = 5;
constexpr double k_left = 60;

double x_of(double x) { return k_left + k_scale * x; }

/// Where the bullet is after each tick.
std::vector<double> shoot(bool continuous) {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 2}> storage;
  World world;
  must(storage.create({.gravity = {0.0, 0.0, 0.0}, .continuous = continuous}, world));
  BodyId wall, bullet;
  BodyDef plate = {.type = BodyType::fixed, .position = position(k_wall, 0, 0)};
  plate.shape = box(vector(k_wall_half, 1, 1));
  must(create_body(world, plate, wall));
  BodyDef ball = {.linear_velocity = vector(k_speed, 0, 0), .shape = sphere(real(k_radius))};
  ball.material.restitution = real(0.5);
  must(create_body(world, ball, bullet));
  std::vector<double> places;
  for (size_t tick = 0; tick < k_poses; ++tick) {
    Pose pose;
    must(get_pose(world, bullet, pose));
    places.push_back(host(pose.position).x);
    step(world);
  }
  return places;
}

/// The part of a tick's way, from x on, that the bullet flies before it meets the wall.
double impact_after(double x) {
  Convex ball, plate;
  must(make_convex(sphere(real(k_radius)), ball));
  must(make_convex(box(vector(k_wall_half, 1, 1)), plate));
  const Motion flight = {.start = {position(x, 0, 0), k_unturned}, .displacement = vector(k_speed * k_tick, 0, 0)};
  const Motion rest = {.start = {position(k_wall, 0, 0), k_unturned}};
  TimeOfImpact impact;
  must(time_of_impact(ball, flight, plate, rest, impact));
  if (impact.outcome != ToiOutcome::hit) abort();
  return fraction_to_host(impact.time);
}

/// What the ball covers from one place to another.
void draw_sweep(Svg& svg, double y, double from, double to, const char* colour) {
  const double r = k_scale * k_radius;
  svg.rect({x_of(from < to ? from : to) - r, y - r}, k_scale * fabs(to - from) + 2 * r, 2 * r,
           {.fill = colour, .opacity = 0.16}, r);
}

void draw_ball(Svg& svg, double y, double x, size_t tick) {
  svg.circle({x_of(x), y}, k_scale * k_radius, {.fill = "#ffffff"});
  svg.circle({x_of(x), y}, k_scale * k_radius, {.stroke = k_blue, .width = 1.5, .fill = k_sky, .opacity = 0.6});
  svg.text({x_of(x), y + 4}, number(static_cast<double>(tick), 0), {.anchor = "middle"});
}

void draw_wall(Svg& svg, double y) {
  svg.rect({x_of(k_wall - k_wall_half), y - 42}, 2 * k_scale * k_wall_half, 84, {.stroke = "#8a96a0", .fill = k_solid});
}

void draw_shots(Svg& svg) {
  constexpr double off = 88, on = 218;
  svg.text({24, 26}, "continuous = false: only the poses at the ends of ticks are tested", {.size = 14, .bold = true});
  const std::vector<double> through = shoot(false);
  draw_wall(svg, off);
  draw_sweep(svg, off, through.front(), through.back(), k_sky);
  for (size_t i = 0; i < k_poses; ++i) draw_ball(svg, off, through[i], i);
  svg.text({x_of(k_wall) + 14, off - 30}, "wall", {.colour = k_grey});

  svg.text({24, on - 62}, "continuous = true: the bullet hits the wall within the third tick",
           {.size = 14, .bold = true});
  const std::vector<double> back = shoot(true);
  const double before = back[2], part = impact_after(before);
  const double meeting = before + part * k_speed * k_tick;
  draw_wall(svg, on);
  draw_sweep(svg, on, back[0], meeting, k_sky);
  draw_sweep(svg, on + 40, meeting, back[4], k_orange);
  for (size_t i = 0; i < 3; ++i) draw_ball(svg, on, back[i], i);
  svg.circle({x_of(meeting), on}, k_scale * k_radius, {.stroke = k_red, .width = 2, .dash = "4 3"});
  for (size_t i = 3; i < k_poses; ++i) draw_ball(svg, on + 40, back[i], i);
  svg.text({x_of(k_wall) + 20, on - 8}, "time of impact: " + number(part, 3) + " of the tick", {.colour = k_red});
  svg.text({x_of(k_wall) + 20, on + 8}, "there the bullet bounces off the wall,", {.colour = k_ink});
  svg.text({x_of(k_wall) + 20, on + 24}, "and flies back for the rest of the tick", {.colour = k_ink});
  svg.text({x_of(back[4]) - 28, on + 44}, "the path back, drawn lower", {.colour = k_grey, .anchor = "end"});
}

Pose pose_at(const Motion& motion, double part) {
  const Vector start = host(motion.start.position), displacement = host_vector(motion.displacement),
               rotation_vector = host_vector(motion.rotation_vector);
  return {position(start.x + part * displacement.x, start.y + part * displacement.y, start.z + part * displacement.z),
          rotated_by(motion.start.rotation,
                     vector(part * rotation_vector.x, part * rotation_vector.y, part * rotation_vector.z))};
}

/// The door and the crate of the page.
void draw_swing(Svg& svg) {
  static constexpr Point origin = {190, 536};
  static constexpr double scale = 90;
  const auto at = [](const Vector& p) { return Point{origin.x + scale * p.x, origin.y - scale * p.y}; };
  svg.text({24, 318}, "time_of_impact, without a world: a door swings, a crate falls", {.size = 14, .bold = true});

  Convex door, crate;
  must(make_convex(box({0.5, 0.1, 0.5}), door));
  must(make_convex(rounded(box({0.2, 0.2, 0.2}), 0.05), crate));
  const Motion swing = {.rotation_vector = {0.0, 0.0, 3.0}};
  const Motion fall = {.start = {{0.0, 2.0, 0.0}, k_unturned}, .displacement = {0.0, -3.0, 0.0}};
  TimeOfImpact impact;
  must(time_of_impact(door, swing, crate, fall, impact));
  const double time = fraction_to_host(impact.time);

  const auto draw = [&](double part, bool last) {
    const auto draw_box = [&](const Pose& pose, double half_x, double half_y, double rounding, const char* colour) {
      const double x = half_x, y = half_y, r = rounding;
      std::vector<Point> points;
      // The corners, each a quarter of a circle in six pieces.
      const double corners[][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
      for (int corner = 0; corner < 4; ++corner) {
        for (int piece = 0; piece <= (r > 0 ? 6 : 0); ++piece) {
          const double angle = (corner + piece / 6.0) * 1.5707963267948966;
          points.push_back(at(
              world_point(pose, corners[corner][0] * x + r * cos(angle), corners[corner][1] * y + r * sin(angle), 0)));
        }
      }
      svg.path(points, {.stroke = colour, .width = last ? 2.0 : 1.0, .fill = colour, .opacity = last ? 0.35 : 0.08},
               true);
    };
    draw_box(pose_at(swing, part), 0.5, 0.1, 0, k_green);
    draw_box(pose_at(fall, part), 0.2, 0.2, 0.05, k_blue);
  };
  for (int i = 0; i < 4; ++i) draw(time * i / 4, false);
  draw(time, true);
  const Vector point = host(pose_at(swing, time).position) + host_vector(impact.point);
  svg.circle(at(point), 4, {.stroke = "#fbfcfd", .fill = k_red});
  const Point words = {at(point).x + 90, at(point).y - 60};
  svg.text(words, "the shapes touch at " + number(time, 3) + " of the step, at the dot", {.colour = k_red});
  svg.text(words + Point{0, 20}, "bold: both at that time");
  svg.text(words + Point{0, 40}, "thin: both at 0, 1/4, 1/2, 3/4 of that time");
}

}  // namespace

Svg draw_continuous_collision() {
  Svg svg(604, "A bullet and a thin wall, and the time of impact of a door and a crate");
  draw_shots(svg);
  draw_swing(svg);
  return svg;
}

}  // namespace figures
