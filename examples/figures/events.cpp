#include <detent/world.h>

#include "examples/figures/figures.h"
#include "examples/figures/host.h"

using namespace detent;

namespace figures {
namespace {

constexpr int k_ticks = 180;
constexpr double k_mass = 1, k_radius = 0.25, k_gravity = 9.81, k_tick = 1.0 / 60;
constexpr uint32_t k_types = 4;

/// What a tick was like.
struct Sample {
  int tick = 0;                  ///< completed
  double height = 0;             ///< m, of the ball's lowest point above the table
  bool on_table = true;          ///< the ball's centre is above it
  double impulse = 0;            ///< N s, upwards, by which its momentum changed but for its weight
  double speed = 0;              ///< m/s, of a hit
  bool heard[k_types + 1] = {};  ///< events, by type
};

double rise_of(const World& world, BodyId ball) {
  Vec3<Real> linear_velocity, angular_velocity;
  must(get_velocity(world, ball, linear_velocity, angular_velocity));
  return real_to_host(linear_velocity.y);
}

/// A ball falls on a table, bounces, rolls over its edge.
std::vector<Sample> play() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
  World world;
  static ContactEvent events[8];
  must(storage.create({}, {.contact_events = {events, 8}}, world));
  BodyId table, ball;
  must(create_body(world, {.type = BodyType::fixed, .position = {-3.0, -0.5, 0.0}, .shape = box({3.0, 0.5, 1.0})},
                   table));
  BodyDef def = {.position = position(-2.4, 1.2 + k_radius, 0), .linear_velocity = vector(1.2, 0, 0)};
  def.shape = sphere(real(k_radius));
  def.material.restitution = real(0.6);
  def.mass = Scaled(k_mass);
  must(create_body(world, def, ball));

  std::vector<Sample> samples;
  for (int tick = 0; tick < k_ticks; ++tick) {
    const double before = rise_of(world, ball);
    const StepReport report = step(world);
    Pose pose;
    must(get_pose(world, ball, pose));
    Sample sample;
    sample.tick = tick + 1;
    sample.height = host(pose.position).y - k_radius;
    sample.on_table = host(pose.position).x < 0;
    sample.impulse = k_mass * (rise_of(world, ball) - before + k_gravity * k_tick);
    for (uint32_t i = 0; i < report.events.contact; ++i) {
      sample.heard[static_cast<uint32_t>(events[i].type)] = true;
      if (events[i].type == ContactEventType::hit) sample.speed = real_to_host(events[i].approach_speed);
    }
    samples.push_back(sample);
  }
  return samples;
}

constexpr double k_left = 120, k_right = k_width - 30;
constexpr double k_plot_top = 40, k_plot_bottom = 240, k_height_max = 1.3, k_height_min = -0.5;
constexpr double k_lane = 34, k_lanes_top = 268;
constexpr double k_impulse_foot = 468, k_impulse_scale = 6;  // px, px / N s

double x_of(double tick) { return k_left + (k_right - k_left) * tick / k_ticks; }
double y_of(double height) {
  return k_plot_bottom - (k_plot_bottom - k_plot_top) * (height - k_height_min) / (k_height_max - k_height_min);
}

struct Lane {
  ContactEventType type;
  const char* words;
  const char* colour;
};
constexpr Lane k_lanes[k_types] = {
    {ContactEventType::begin, "begin", k_green},
    {ContactEventType::touch, "touch", k_sky},
    {ContactEventType::end, "end", k_pink},
    {ContactEventType::hit, "hit, m/s", k_red},
};

void draw_axes(Svg& svg) {
  svg.text({24, 26}, "A ball falls on a table, bounces, rolls over its edge: contact events of each tick",
           {.size = 14, .bold = true});
  for (int tick = 0; tick <= k_ticks; tick += 30) {
    svg.line({x_of(tick), k_plot_top}, {x_of(tick), k_impulse_foot}, {.stroke = k_faint});
    svg.text({x_of(tick), k_impulse_foot + 18}, number(tick, 0), {.colour = k_grey, .anchor = "middle"});
  }
  svg.text({24, k_impulse_foot + 18}, "tick of 1/60 s", {.colour = k_grey});
  for (const double height : {-0.5, 0.0, 0.5, 1.0}) {
    svg.line({k_left, y_of(height)}, {k_right, y_of(height)}, {.stroke = k_faint});
    svg.text({k_left - 8, y_of(height) + 4}, number(height), {.colour = k_grey, .anchor = "end"});
  }
  svg.text({24, k_plot_top + 14}, "height, m");
}

}  // namespace

Svg draw_events() {
  const std::vector<Sample> samples = play();
  Svg svg(k_impulse_foot + 34, "Contact events of a ball, tick by tick");
  draw_axes(svg);

  int edge = 0;
  std::vector<Point> displacement;
  for (const Sample& sample : samples) {
    if (sample.height > k_height_min) displacement.push_back({x_of(sample.tick), y_of(sample.height)});
    if (sample.on_table) edge = sample.tick;
  }
  svg.rect({k_left, y_of(0)}, x_of(edge) - k_left, 10, {.fill = k_solid});
  svg.text({x_of(4), y_of(0) + 25}, "table", {.colour = k_grey});
  svg.path(displacement, {.stroke = k_blue, .width = 2});

  double foot = k_lanes_top;
  for (const Lane& lane : k_lanes) {
    const uint32_t type = static_cast<uint32_t>(lane.type);
    svg.line({k_left, foot}, {k_right, foot}, {.stroke = k_faint});
    svg.text({24, foot + 4}, lane.words, {.colour = k_ink});
    for (const Sample& sample : samples) {
      if (!sample.heard[type]) continue;
      const Point at = {x_of(sample.tick), foot};
      if (lane.type == ContactEventType::touch) {
        svg.rect({at.x - 1.2, at.y - 7}, 2.4, 14, {.fill = lane.colour});
        continue;
      }
      svg.circle(at, 4.5, {.stroke = "#fbfcfd", .fill = lane.colour});
      if (lane.type != ContactEventType::hit) continue;
      svg.circle({at.x, y_of(sample.height)}, 4.5, {.stroke = "#fbfcfd", .fill = lane.colour});
      svg.text({at.x, at.y + 19}, number(sample.speed), {.colour = lane.colour, .anchor = "middle", .halo = true});
    }
    foot += k_lane;
  }

  svg.text({24, k_impulse_foot - 16}, "impulse on");
  svg.text({24, k_impulse_foot - 1}, "the ball, N s");
  svg.line({k_left, k_impulse_foot}, {k_right, k_impulse_foot}, {.stroke = k_grey});
  for (const Sample& sample : samples) {
    const double length = k_impulse_scale * sample.impulse;
    if (length < 0.05) continue;
    svg.rect({x_of(sample.tick) - 1.2, k_impulse_foot - length}, 2.4, length, {.fill = k_orange});
    if (sample.speed > 0) {
      svg.text({x_of(sample.tick), k_impulse_foot - length - 5}, number(sample.impulse),
               {.anchor = "middle", .halo = true});
    }
  }
  return svg;
}

}  // namespace figures
