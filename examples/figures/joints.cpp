#include <detent/body.h>
#include <detent/world.h>
#include <math.h>

#include <algorithm>
#include <numbers>

#include "examples/figures/figures.h"
#include "examples/figures/host.h"

using namespace detent;

namespace figures {
namespace {

constexpr double k_panel_width = 256, k_panel_height = 226, k_margin = 16, k_header = 58;
constexpr double k_scale = 72;  // px / m
constexpr double k_pi = std::numbers::pi;

constexpr Unit k_half = Unit(0.70710678118);
constexpr Quat k_x_up = {Unit(0.0), Unit(0.0), k_half, k_half};  ///< the frame's x to the world's y, z stays

constexpr Vector k_x = {1, 0, 0}, k_y = {0, 1, 0}, k_z = {0, 0, 1};

/// Seen from the front, somewhat from the right and from above: x goes right, y up, z to the reader's left.
class Camera {
 public:
  explicit Camera(Point origin) : origin_(origin) {}
  Point at(const Vector& p) const {
    const double right = p.x * k_yaw_cos - p.z * k_yaw_sin, front = p.x * k_yaw_sin + p.z * k_yaw_cos;
    return {origin_.x + k_scale * right, origin_.y - k_scale * (p.y * k_pitch_cos - front * k_pitch_sin)};
  }
  /// How far a direction goes towards the reader.
  static double nearness(const Vector& d) {
    return d.y * k_pitch_sin + (d.x * k_yaw_sin + d.z * k_yaw_cos) * k_pitch_cos;
  }

 private:
  static constexpr double k_yaw_cos = 0.866, k_yaw_sin = 0.5, k_pitch_cos = 0.9135, k_pitch_sin = 0.4067;
  Point origin_;
};

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

/// The outline of what convex shape has these points. Source: Andrew, "Another efficient algorithm for convex hulls in
/// two dimensions", 1979.
std::vector<Point> outline_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> outline;
  for (const bool lower : {true, false}) {
    const size_t first = outline.size();
    for (const Point& point : points) {
      while (outline.size() > first + 1 &&
             cross(outline.back() - outline[outline.size() - 2], point - outline.back()) <= 0) {
        outline.pop_back();
      }
      outline.push_back(point);
    }
    outline.pop_back();
    if (lower) std::reverse(points.begin(), points.end());
  }
  return outline;
}

/// One type of joint: a world with two bodies and the joint between them.
class Diagram {
 public:
  Diagram(Svg& svg, int index, Point shift = {0, 0})
      : svg_(svg),
        corner_{k_margin + index % 3 * k_panel_width, k_header + index / 3 * k_panel_height},
        camera_(corner_ + Point{k_panel_width / 2, 102} + shift) {
    must(create_world(block_, sizeof block_, {.capacity = k_capacity, .gravity = {0.0, 0.0, 0.0}}, {}, world_));
  }

  /// `a` is fixed. The joint is made at this point of the world; `def` says the type and what else is set.
  void make(BodyDef a, const BodyDef& b, JointDef def, const Vector& point, const Quat& frame = k_unturned) {
    a.type = BodyType::fixed;
    must(create_body(world_, a, def.a));
    must(create_body(world_, b, def.b));
    must(place_joint(world_, position(point.x, point.y, point.z), frame, def));
    finish(def);
  }
  /// Likewise, with the anchors as they are set.
  void make_apart(BodyDef a, const BodyDef& b, JointDef def) {
    a.type = BodyType::fixed;
    must(create_body(world_, a, def.a));
    must(create_body(world_, b, def.b));
    finish(def);
  }

  void draw_titles(const char* name, const char* first, const char* second) {
    svg_.rect(corner_ + Point{4, 4}, k_panel_width - 8, k_panel_height - 8, {.stroke = k_faint, .fill = "#ffffff"}, 6);
    svg_.text(corner_ + Point{14, 24}, name, {.size = 14, .bold = true});
    svg_.text(corner_ + Point{14, k_panel_height - 32}, first);
    svg_.text(corner_ + Point{14, k_panel_height - 16}, second);
  }
  void draw_a() { draw(def_.a, "#8a96a0", k_solid, 0.85, nullptr); }
  void draw_b() { draw(def_.b, k_blue, k_sky, 0.5, nullptr); }
  /// B where it comes to with this velocity, m/s, and angular velocity, rad/s, in so many ticks.
  void draw_other_b(const Vector& linear_velocity, const Vector& angular_velocity, int ticks) {
    must(save(world_, snapshot_, sizeof snapshot_));
    must(set_velocity(world_, def_.b, vector(linear_velocity.x, linear_velocity.y, linear_velocity.z),
                      vector(angular_velocity.x, angular_velocity.y, angular_velocity.z)));
    for (int tick = 0; tick < ticks; ++tick) step(world_);
    draw(def_.b, k_blue, k_sky, 0.06, "4 3");
    must(restore(world_, snapshot_, sizeof snapshot_));
  }
  /// From each centre of mass to its anchor.
  void draw_anchors() {
    const Pose a = pose_of(def_.a), b = pose_of(def_.b);
    const Point anchor_a = camera_.at(host(to_world(a, def_.anchor_a))),
                anchor_b = camera_.at(host(to_world(b, def_.anchor_b)));
    svg_.line(camera_.at(host(a.position)), anchor_a, {.stroke = k_ink, .width = 1.2});
    svg_.line(camera_.at(host(b.position)), anchor_b, {.stroke = k_blue, .width = 1.2});
    svg_.circle(camera_.at(host(a.position)), 2.5, {.fill = k_ink});
    svg_.circle(camera_.at(host(b.position)), 2.5, {.fill = k_blue});
    svg_.circle(anchor_a, 3.5, {.stroke = k_ink, .width = 1.5, .fill = "#ffffff"});
    svg_.circle(anchor_b, 3.5, {.stroke = k_ink, .width = 1.5, .fill = "#ffffff"});
  }

  Vector anchor_a() const { return host(to_world(pose_of(def_.a), def_.anchor_a)); }
  Vector anchor_b() const { return host(to_world(pose_of(def_.b), def_.anchor_b)); }

  /// An axis of a frame.
  void axis(const Vector& from, const Vector& displacement, const char* name, Point label) {
    const Point end = camera_.at(from + displacement);
    svg_.arrow({camera_.at(from), end}, k_green, 1.8);
    svg_.text(end + label, name, {.colour = k_green, .bold = true, .halo = true});
  }
  /// A straight free motion.
  void slide(const Vector& from, const Vector& to) {
    svg_.arrow({camera_.at(from), camera_.at(to)}, k_orange, 2.5, true);
  }
  /// A free turn from u towards v, rad.
  void rotation_vector(const Vector& centre, const Vector& u, const Vector& v, double radius, double lower,
                       double upper) {
    svg_.arrow(arc(centre, u, v, radius, lower, upper), k_orange, 2.5, true);
  }
  void dashed(const std::vector<Point>& points, const char* colour, bool closed = false) {
    svg_.path(points, {.stroke = colour, .width = 1.5, .fill = closed ? colour : "none", .opacity = 0.1, .dash = "4 3"},
              closed);
  }
  void line(const Vector& from, const Vector& to, const Paint& paint) {
    svg_.line(camera_.at(from), camera_.at(to), paint);
  }
  std::vector<Point> arc(const Vector& centre, const Vector& u, const Vector& v, double radius, double lower,
                         double upper) const {
    constexpr int pieces = 36;
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) {
      const double angle = lower + (upper - lower) * i / pieces;
      points.push_back(camera_.at(centre + radius * cos(angle) * u + radius * sin(angle) * v));
    }
    return points;
  }
  void label(const Vector& at, Point shift, const char* words, const char* colour = k_ink,
             const char* anchor = "start") {
    svg_.text(camera_.at(at) + shift, words, {.colour = colour, .anchor = anchor, .halo = true});
  }
  const Camera& camera() const { return camera_; }

 private:
  static constexpr Capacity k_capacity = {.bodies = 2, .contacts = 2, .joints = 1};

  void finish(const JointDef& def) {
    JointId id;
    must(create_joint(world_, def, id));
    must(get_joint(world_, id, def_));
    BodyDef made;
    must(get_body_def(world_, def.a, made));
    shape_a_ = made.shape;
    must(get_body_def(world_, def.b, made));
    shape_b_ = made.shape;
  }
  Pose pose_of(BodyId id) const {
    Pose pose;
    must(get_pose(world_, id, pose));
    return pose;
  }

  void draw(BodyId id, const char* stroke, const char* fill, double opacity, const char* dash) {
    const Shape& shape = id == def_.a ? shape_a_ : shape_b_;
    const Paint paint = {.stroke = stroke, .width = 1.2, .fill = fill, .opacity = opacity, .dash = dash};
    if (shape.type == ShapeType::cylinder) {
      draw_cylinder(pose_of(id), real_to_host(shape.radius), real_to_host(shape.half_length), paint);
    } else {
      draw_box(pose_of(id), host_vector(shape.half_extents), paint);
    }
  }
  void draw_box(const Pose& pose, const Vector& half, const Paint& paint) {
    const auto corner = [&](double x, double y, double z) {
      return camera_.at(world_point(pose, x * half.x, y * half.y, z * half.z));
    };
    const Vector centre = host(pose.position);
    for (const double side : {-1.0, 1.0}) {
      const std::vector<Point> faces[] = {
          {corner(side, -1, -1), corner(side, 1, -1), corner(side, 1, 1), corner(side, -1, 1)},
          {corner(-1, side, -1), corner(1, side, -1), corner(1, side, 1), corner(-1, side, 1)},
          {corner(-1, -1, side), corner(1, -1, side), corner(1, 1, side), corner(-1, 1, side)},
      };
      const Vector normals[] = {world_point(pose, side, 0, 0), world_point(pose, 0, side, 0),
                                world_point(pose, 0, 0, side)};
      for (int i = 0; i < 3; ++i) {
        if (Camera::nearness(normals[i] - centre) > 1e-6) svg_.path(faces[i], paint, true);
      }
    }
  }
  void draw_cylinder(const Pose& pose, double radius, double half_length, const Paint& paint) {
    std::vector<Point> near, all;
    const Vector up = world_point(pose, 0, 1, 0) - host(pose.position);
    const double front = Camera::nearness(up) > 0 ? half_length : -half_length;
    for (int i = 0; i < 48; ++i) {
      const double angle = 2 * k_pi * i / 48;
      near.push_back(camera_.at(world_point(pose, radius * cos(angle), front, radius * sin(angle))));
      all.push_back(camera_.at(world_point(pose, radius * cos(angle), -front, radius * sin(angle))));
    }
    all.insert(all.end(), near.begin(), near.end());
    if (paint.dash == nullptr) svg_.path(outline_of(all), paint, true);
    svg_.path(near, paint, true);
  }

  Svg& svg_;
  Point corner_;
  Camera camera_;
  alignas(8) uint8_t block_[world_bytes(k_capacity)];
  alignas(8) uint8_t snapshot_[snapshot_bytes(k_capacity)];
  World world_;
  JointDef def_;
  Shape shape_a_, shape_b_;
};

BodyDef body(const Vector& at, const Vector& half) {
  return {.position = position(at.x, at.y, at.z), .shape = box(vector(half.x, half.y, half.z))};
}
JointDef joint(JointType type) {
  JointDef def;
  def.type = type;
  return def;
}
JointDef limited(JointType type, double lower, double upper) {
  JointDef def = joint(type);
  def.axis.limited = true;
  def.axis.lower = real(lower);
  def.axis.upper = real(upper);
  return def;
}

constexpr Vector k_none = {0, 0, 0};
const Vector k_arm = {0.45, 0.12, 0.2};

void draw_ball(Svg& svg, int index) {
  Diagram diagram(svg, index);
  diagram.draw_titles("ball", "rotates about the common anchor;", "axis: a spring from B's frame to A's");
  diagram.make(body({-0.65, 0, 0}, k_arm), body({0.65, 0, 0}, k_arm), joint(JointType::ball), k_none);
  diagram.draw_a();
  diagram.draw_other_b({0, 1.95, 0}, {0, 0, 3}, 14);
  diagram.draw_other_b({0, 0, 1.95}, {0, -3, 0}, 14);
  diagram.draw_b();
  diagram.draw_anchors();
  diagram.rotation_vector(k_none, k_x, k_y, 1.3, 0.1, 0.75);
  diagram.rotation_vector(k_none, k_x, k_z, 1.3, 0.1, 0.8);
  diagram.label({-0.65, 0.12, 0}, {-20, -14}, "anchor_a");
  diagram.label({0.3, -0.12, 0.2}, {-16, 26}, "anchor_b", k_blue, "end");
}

void draw_hinge(Svg& svg, int index) {
  Diagram diagram(svg, index, {-46, -4});
  diagram.draw_titles("hinge", "rotates about x, the common axis;", "axis: the angle about x");
  diagram.make(body({-0.15, 0, 0}, {0.1, 0.7, 0.1}), body({0.6, 0, 0}, {0.55, 0.6, 0.05}),
               limited(JointType::hinge, -0.4, 1.2), {0, 0, 0}, k_x_up);
  diagram.draw_other_b({0, 0, -1.2}, {0, 2, 0}, 90);
  diagram.draw_a();
  diagram.draw_b();
  diagram.draw_other_b({0, 0, 1.2}, {0, -2, 0}, 90);
  diagram.axis({0, -0.7, 0}, {0, 1.75, 0}, "x", {6, 6});
  diagram.rotation_vector({0, -0.6, 0}, k_x, {0, 0, -1}, 1.15, -0.4, 1.2);
  diagram.label({1.15 * cos(1.2), -0.6, -1.15 * sin(1.2)}, {14, 2}, "upper");
  diagram.label({1.15 * cos(-0.4), -0.6, -1.15 * sin(-0.4)}, {-8, 8}, "lower", k_ink, "end");
}

void draw_slider(Svg& svg, int index) {
  Diagram diagram(svg, index);
  diagram.draw_titles("slider", "slides along A's x, no rotation;", "axis: the displacement along x");
  diagram.make(body({0, -0.3, 0}, {1.2, 0.08, 0.2}), body({-0.1, 0.02, 0}, {0.22, 0.22, 0.22}),
               limited(JointType::slider, -0.7, 0.8), {-0.1, -0.2, 0});
  diagram.draw_a();
  diagram.draw_other_b({-2, 0, 0}, k_none, 60);
  diagram.draw_other_b({2, 0, 0}, k_none, 60);
  diagram.draw_b();
  diagram.axis({-0.1, -0.2, 0}, {1.55, 0, 0}, "x", {4, 12});
  diagram.slide({-0.8, 0.5, 0}, {0.7, 0.5, 0});
  diagram.label({-0.8, 0.5, 0}, {0, -8}, "lower", k_ink, "middle");
  diagram.label({0.7, 0.5, 0}, {0, -8}, "upper", k_ink, "middle");
}

void draw_distance(Svg& svg, int index) {
  Diagram diagram(svg, index, {6, -30});
  diagram.draw_titles("distance", "axis: how far the anchors are apart;", "rod: lower = upper, rope: lower = 0");
  JointDef def = limited(JointType::distance, 0, 1.2);
  def.anchor_a = {0.0, -0.1, 0.0};
  def.anchor_b = {0.0, real(0.22), 0.0};
  diagram.make_apart(body({0, 0.3, 0}, {0.6, 0.1, 0.3}), body({0, -1.22, 0}, {0.22, 0.22, 0.22}), def);
  diagram.draw_a();
  diagram.draw_other_b({1.3, 0, 0}, k_none, 40);
  diagram.draw_other_b({-1.3, 1.4, 0}, k_none, 26);
  diagram.draw_b();
  diagram.draw_anchors();
  diagram.line(diagram.anchor_a(), diagram.anchor_b(), {.stroke = k_orange, .width = 2.5});
  diagram.label(0.5 * (diagram.anchor_a() + diagram.anchor_b()), {8, 4}, "upper");
  diagram.label(diagram.anchor_b(), {-26, 14}, "anchor_b", k_blue, "end");
  diagram.label(diagram.anchor_a(), {54, 8}, "anchor_a");
}

void draw_fixed(Svg& svg, int index) {
  Diagram diagram(svg, index);
  diagram.draw_titles("fixed", "the two frames are one:", "nothing is free");
  diagram.make(body({-0.45, 0, 0}, {0.45, 0.25, 0.25}), body({0.45, 0, 0}, {0.45, 0.25, 0.25}), joint(JointType::fixed),
               k_none);
  diagram.draw_a();
  diagram.draw_b();
  diagram.draw_anchors();
  diagram.axis(k_none, {0.55, 0, 0}, "x", {-3, 15});
  diagram.axis(k_none, {0, 0.65, 0}, "y", {6, 4});
  diagram.axis(k_none, {0, 0, 0.75}, "z", {-14, 4});
}

void draw_cone_twist(Svg& svg, int index) {
  constexpr double cone = 0.6, twist = 1;
  Diagram diagram(svg, index, {-24, 6});
  diagram.draw_titles("cone_twist", "second: how far B's x leans off A's x;", "axis: the twist about x");
  JointDef def = limited(JointType::cone_twist, -twist, twist);
  def.second.limited = true;
  def.second.upper = real(cone);
  diagram.make(body({-0.5, 0, 0}, {0.3, 0.3, 0.3}), body({0.55, 0, 0}, {0.4, 0.1, 0.14}), def, k_none);
  diagram.draw_a();
  std::vector<Point> cone_points = diagram.arc({1.15 * cos(cone), 0, 0}, k_y, k_z, 1.15 * sin(cone), 0, 2 * k_pi);
  diagram.dashed(cone_points, k_orange, true);
  cone_points.push_back(diagram.camera().at(k_none));
  diagram.dashed(outline_of(cone_points), k_orange, true);
  diagram.draw_other_b({0, 1.1, 0}, {0, 0, 2}, 60);
  diagram.draw_b();
  diagram.axis(k_none, {1.5, 0, 0}, "x", {4, 12});
  diagram.rotation_vector({1.1, 0, 0}, k_y, k_z, 0.3, -0.4, 2.2);
  diagram.label({1.15 * cos(cone), 1.15 * sin(cone), 0}, {10, -14}, "second.upper", k_ink, "middle");
  diagram.label({1.1, -0.3, 0}, {12, 24}, "axis", k_ink, "middle");
}

void draw_wheel(Svg& svg, int index) {
  Diagram diagram(svg, index, {10, -18});
  diagram.draw_titles("wheel", "axis: the suspension along A's x;", "second: the angle about z, the axle");
  BodyDef tyre = {.position = position(0, -0.5, 0.3)};
  tyre.rotation = rotated_by(k_unturned, vector(k_pi / 2, 0, 0));
  tyre.shape = cylinder(real(0.42), real(0.1));
  diagram.make(body({0.1, 0.25, -0.35}, {1, 0.2, 0.35}), tyre, limited(JointType::wheel, -0.3, 0.2), {0, -0.5, 0.3},
               k_x_up);
  diagram.draw_a();
  diagram.draw_other_b({0, -1.5, 0}, k_none, 60);
  diagram.draw_b();
  diagram.axis({0, -0.5, 0.3}, {0, 1.35, 0}, "x", {6, 6});
  diagram.axis({0, -0.5, 0.3}, {0, 0, 0.95}, "z", {-12, 6});
  diagram.rotation_vector({0, -0.5, 0.42}, k_x, k_y, 0.3, -0.9, 1.1);
  diagram.slide({0.9, -0.8, 0.3}, {0.9, -0.3, 0.3});
  diagram.label({0.9, -0.3, 0.3}, {10, 8}, "upper");
  diagram.label({0.9, -0.8, 0.3}, {10, 2}, "lower");
}

void draw_parallel(Svg& svg, int index) {
  Diagram diagram(svg, index, {-10, 16});
  diagram.draw_titles("parallel", "holds the x axes parallel, no more;", "axis: the angle about x");
  diagram.make(body({-0.75, 0, 0}, {0.3, 0.2, 0.3}), body({0.35, 0, 0}, {0.25, 0.25, 0.25}), joint(JointType::parallel),
               {0.35, 0, 0}, k_x_up);
  diagram.draw_a();
  diagram.draw_b();
  diagram.draw_other_b({2, 0.9, 0}, {0, 2, 0}, 26);
  diagram.axis({-0.75, 0, 0}, {0, 0.95, 0}, "x", {6, 6});
  diagram.axis({0.35, 0, 0}, {0, 0.95, 0}, "x", {6, 6});
  diagram.rotation_vector({0.35, 0.6, 0}, k_x, {0, 0, -1}, 0.3, -2.6, 1.0);
  diagram.slide({0.7, -0.5, 0}, {1.4, -0.5, 0});
  diagram.slide({0.35, -0.3, 0.45}, {0.35, -0.3, 1.1});
}

void draw_filter(Svg& svg, int index) {
  Diagram diagram(svg, index, {-14, 20});
  diagram.draw_titles("filter", "all is free; A and B do not collide,", "they may be in each other");
  diagram.make(body({-0.3, 0, 0}, {0.55, 0.3, 0.3}), body({0.45, 0.1, 0.1}, {0.45, 0.25, 0.25}),
               joint(JointType::filter), k_none);
  diagram.draw_a();
  diagram.draw_b();
  diagram.draw_other_b({0.7, 1.3, 0}, {0, 0.4, 1}, 26);
  diagram.label({-0.85, 0.3, 0.3}, {0, -8}, "A");
  diagram.label({0.9, -0.15, 0.35}, {4, 14}, "B", k_blue);
}

}  // namespace

Svg draw_joints() {
  Svg svg(k_header + 3 * k_panel_height + 12, "What each type of joint leaves free");
  svg.text({24, 26}, "What each JointType leaves free", {.size = 14, .bold = true});
  double x = 24;
  const auto swatch = [&](const Paint& paint, const char* words, double width) {
    svg.rect({x, 36}, 13, 13, paint);
    svg.text({x + 19, 47}, words);
    x += width;
  };
  swatch({.stroke = "#8a96a0", .fill = k_solid}, "A, here fixed", 120);
  swatch({.stroke = k_blue, .fill = k_sky, .opacity = 0.5}, "B", 50);
  swatch({.stroke = k_blue, .fill = k_sky, .opacity = 0.06, .dash = "4 3"}, "B where the joint lets it go (simulated)",
         280);
  svg.arrow({{x, 43}, {x + 30, 43}}, k_orange, 2.5, true);
  svg.text({x + 37, 47}, "free motion");
  svg.arrow({{x + 130, 43}, {x + 156, 43}}, k_green, 1.8);
  svg.text({x + 163, 47}, "axis of the frames");
  using Draw = void (*)(Svg&, int);
  constexpr Draw k_diagrams[] = {draw_ball,       draw_hinge, draw_slider,   draw_distance, draw_fixed,
                                 draw_cone_twist, draw_wheel, draw_parallel, draw_filter};
  int index = 0;
  for (const Draw draw : k_diagrams) draw(svg, index++);
  return svg;
}

}  // namespace figures
