#include <detent/mover.h>
#include <math.h>

#include <numbers>

#include "examples/figures/figures.h"
#include "examples/figures/host.h"

using namespace detent;

namespace figures {
namespace {

constexpr double k_tick = 1.0 / 60, k_speed = 3, k_radius = 0.3, k_half_length = 0.6, k_gap = 0.01;
constexpr double k_scale = 70;      // px / m
constexpr int k_ticks_shown = 14;   // from one outline to the next
constexpr double k_half_depth = 2;  // m, of what is seen from the side

constexpr double degrees(double angle) { return angle * std::numbers::pi / 180; }

/// Places in the plane of the drawing, m.
using Outline = std::vector<Vector>;

/// A world of fixed boxes, and who walks in it.
class Walk {
 public:
  explicit Walk(const Position& start) {
    must(create_world(block_, sizeof block_, {.capacity = k_capacity}, {}, world_));
    BodyId ground;
    must(create_body(world_, {.type = BodyType::fixed, .shape = half_space()}, ground));
    settings_.radius = real(k_radius);
    settings_.half_length = real(k_half_length);
    settings_.gap = real(k_gap);
    mover_.position = start;
  }

  /// A slab whose upper side goes from (x0, y0) to (x1, y1); that side.
  Outline add_slab(double x0, double y0, double x1, double y1) {
    constexpr double half_thickness = 0.5;
    const double half_length = hypot(x1 - x0, y1 - y0) / 2, angle = atan2(y1 - y0, x1 - x0);
    BodyDef def = {.type = BodyType::fixed, .rotation = turned(angle)};
    def.position =
        position((x0 + x1) / 2 + half_thickness * sin(angle), (y0 + y1) / 2 - half_thickness * cos(angle), 0);
    const Outline outline = add(def, half_length, half_thickness, k_half_depth);
    return {outline[3], outline[2]};
  }
  /// A wall, 2 m high, with these sides.
  Outline add_wall(double x0, double z0, double x1, double z1) {
    BodyDef def = {.type = BodyType::fixed, .position = position((x0 + x1) / 2, 1, (z0 + z1) / 2)};
    add(def, (x1 - x0) / 2, 1, (z1 - z0) / 2);
    return {{x0, 0, z0}, {x1, 0, z0}, {x1, 0, z1}, {x0, 0, z1}};
  }

  /// One tick with a wish along the ground, m/s.
  MoverReport move(double x, double z) {
    step(world_);
    fall_ += 9.81 * k_tick * k_tick;
    MoverReport report;
    must(move_mover(world_, settings_, vector(x * k_tick, -fall_, z * k_tick), mover_, report));
    if (report.on_ground) fall_ = 0;
    return report;
  }
  Vector place() const { return host(mover_.position); }

 private:
  static constexpr Capacity k_capacity = {.bodies = 16, .contacts = 16};

  Outline add(BodyDef& def, double half_x, double half_y, double half_z) {
    BodyId id;
    def.shape = box(vector(half_x, half_y, half_z));
    must(create_body(world_, def, id));
    Pose pose;
    must(get_pose(world_, id, pose));
    return {world_point(pose, -half_x, -half_y, 0), world_point(pose, half_x, -half_y, 0),
            world_point(pose, half_x, half_y, 0), world_point(pose, -half_x, half_y, 0)};
  }

  alignas(8) uint8_t block_[world_bytes(k_capacity)];
  World world_;
  MoverSettings settings_;
  Mover mover_;
  double fall_ = 0;  ///< m, of the next tick
};

constexpr Paint k_ground = {.stroke = "#8a96a0", .width = 1, .fill = k_solid};
constexpr Paint k_outline = {.stroke = k_blue, .width = 1, .fill = k_sky, .opacity = 0.15};
constexpr Paint k_path = {.stroke = k_blue, .width = 2};

void draw_side(Svg& svg) {
  static constexpr Point origin = {40, 246};
  const auto at = [](double x, double y) { return Point{origin.x + k_scale * x, origin.y - k_scale * y}; };
  svg.text({24, 26}, "From the side: steps, slopes", {.size = 14, .bold = true});

  Walk walk(position(0, k_radius + k_half_length + k_gap, 0));
  const Outline outlines[] = {
      walk.add_slab(1.5, 0.3, 2.3, 0.3), walk.add_slab(2.3, 0.6, 4.2, 0.6),    walk.add_slab(4.2, 0.6, 5.7, 0),
      walk.add_slab(7, 0, 8.2, 0.84),    walk.add_slab(8.2, 0.84, 9.3, 2.745),
  };
  std::vector<Point> path, places;
  std::vector<Point> steps;
  for (int tick = 0; tick < 190; ++tick) {
    const MoverReport report = walk.move(k_speed, 0);
    const Vector place = walk.place();
    path.push_back(at(place.x, place.y));
    if (tick % k_ticks_shown == 0 && (places.empty() || places.back().x + 2 < path.back().x))
      places.push_back(path.back());
    if (report.stepped) steps.push_back(at(place.x, place.y));
  }
  const double width = 2 * k_scale * k_radius, height = 2 * k_scale * (k_radius + k_half_length);
  for (const Point& place : places)
    svg.rect({place.x - width / 2, place.y - height / 2}, width, height, k_outline, width / 2);
  svg.rect({24, origin.y}, k_width - 48, 16, {.fill = k_solid});
  for (const Outline& top : outlines) {
    const Point from = at(top[0].x, top[0].y), to = at(top[1].x, top[1].y);
    svg.path({{from.x, origin.y}, from, to, {to.x, origin.y}}, {.stroke = k_solid, .fill = k_solid}, true);
  }
  svg.path(path, k_path);
  for (const Point& step : steps) svg.circle(step, 3.5, {.stroke = "#fbfcfd", .fill = k_red});

  const Lettering label = {.anchor = "middle"};
  const double foot = origin.y + 34;
  svg.text({at(1.95, 0).x, foot}, "steps of 0.3 m:", label);
  svg.text({at(1.95, 0).x, foot + 16}, "stepped (dots)", label);
  svg.text({at(4.95, 0).x, foot}, "22 degrees down:", label);
  svg.text({at(4.95, 0).x, foot + 16}, "stays on it, by snap", label);
  svg.text({at(7.4, 0).x, foot}, "35 degrees up:", label);
  svg.text({at(7.4, 0).x, foot + 16}, "a floor", label);
  svg.text({at(9.4, 0).x, foot}, "60 degrees:", label);
  svg.text({at(9.4, 0).x, foot + 16}, "a wall (slope_cosine)", label);
}

void draw_top(Svg& svg) {
  static constexpr Point origin = {40, 344};
  const auto at = [](const Vector& p) { return Point{origin.x + k_scale * p.x, origin.y + k_scale * p.z}; };
  svg.text({24, 336}, "From above: along a wall", {.size = 14, .bold = true});

  Walk walk(position(0.3, k_radius + k_half_length + k_gap, 2.3));
  const Outline walls[] = {walk.add_wall(1.2, 0.7, 7.2, 1.1), walk.add_wall(9.2, -0.3, 9.6, 2)};
  const double angle = degrees(30);
  const Vector wish = {k_speed * cos(angle), 0, -k_speed * sin(angle)};
  std::vector<Vector> places;
  std::vector<Point> path;
  for (int tick = 0; tick < 222; ++tick) {
    walk.move(wish.x, wish.z);
    path.push_back(at(walk.place()));
    if (tick % k_ticks_shown == 0) places.push_back(walk.place());
  }
  for (const Outline& wall : walls) {
    std::vector<Point> points;
    for (const Vector& corner : wall) points.push_back(at(corner));
    svg.path(points, k_ground, true);
  }
  for (const Vector& place : places) svg.circle(at(place), k_scale * k_radius, k_outline);
  svg.path(path, k_path);
  for (const Vector& place : places) {
    const Point from = at(place);
    svg.arrow({from, from + 9 * Point{wish.x, wish.z}}, k_orange);
  }
  svg.arrow({{250, 515}, Point{250, 515} + 9 * Point{wish.x, wish.z}}, k_orange);
  svg.text({284, 512}, "the wanted velocity, the same in each tick");
  svg.line({500, 508}, {530, 508}, k_path);
  svg.text({538, 512}, "the path of the capsule's centre");
}

}  // namespace

Svg draw_mover() {
  Svg svg(540, "The path of a mover over steps and slopes, and along a wall");
  draw_side(svg);
  draw_top(svg);
  return svg;
}

}  // namespace figures
