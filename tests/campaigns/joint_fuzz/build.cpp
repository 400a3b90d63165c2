#include "tests/campaigns/joint_fuzz/build.h"

#include <algorithm>

#include "tests/campaigns/joint_fuzz/turn.h"

namespace detent_joint_fuzz {

namespace {

using detent_queries::to_float;

constexpr Triple k_x = {1, 0, 0};

Rotation rotate_about(const Triple& axis, double half_tangent) {
  return normalised({axis[0] * half_tangent, axis[1] * half_tangent, axis[2] * half_tangent, 1});
}

/// The angle of rotate_about(), rad.
double angle_of(double half_tangent) { return 2 * atan(half_tangent); }

bool slides(Hold hold) { return hold == Hold::slider || hold == Hold::wheel; }

}  // namespace

double spread(Random& random, double low, double high) { return to_float(random.log_uniform(low, high)); }

Triple any_vector(Random& random, double most) {
  const Triple displacement = random.direction();
  return displacement * random.uniform(0, most);
}

Triple Builder::arm() {
  const Triple displacement = random_.direction();
  return random_.chance(0.05) ? Triple{} : displacement * (style_.distance_max * random_.uniform(0.1, 1));
}

uint32_t Builder::add_body(const Triple& position) {
  SceneBody body;
  const double size = style_.size * style_.distance_max;
  switch (random_.below(5)) {
    case 0:
      body.solid = Solid::sphere;
      body.size = {size, size, size};
      break;
    case 1:
      body.solid = Solid::capsule;
      body.size = {size * random_.uniform(0.2, 0.6), size, size};
      break;
    case 2:  // a rod
      body.size = {size * 0.05, size, size * 0.05};
      break;
    default:
      body.size = {size, size * random_.uniform(0.3, 1), size * random_.uniform(0.1, 1)};
      break;
  }
  body.size = to_float(body.size);
  body.position = to_float(position);
  body.rotation = normalised(random_.rotation());
  body.mass = to_float(style_.mass * (style_.mass_ratio > 1 ? spread(random_, 1, style_.mass_ratio) : 1));
  scene_.bodies.push_back(body);
  return static_cast<uint32_t>(scene_.bodies.size() - 1);
}

uint32_t Builder::add_wall(const Triple& position) {
  SceneBody wall;
  const double size = to_float(0.1 * style_.distance_max);
  wall.fixed = true;
  wall.size = {size, size, size};
  wall.position = to_float(position);
  scene_.bodies.push_back(wall);
  return static_cast<uint32_t>(scene_.bodies.size() - 1);
}

Hold Builder::any_hold() {
  if (!style_.mixed) return style_.hold;
  // In games most joints are ball joints and hinges, so they are more frequent here.
  constexpr Hold k_often[] = {Hold::ball,  Hold::ball,     Hold::ball,  Hold::hinge,      Hold::hinge, Hold::cone_twist,
                              Hold::wheel, Hold::distance, Hold::fixed, Hold::cone_twist, Hold::slider};
  return k_often[random_.below(sizeof k_often / sizeof *k_often)];
}

void Builder::join(uint32_t a, uint32_t b, const Triple& point, Hold hold) {
  const Rotation frame = normalised(random_.rotation());
  double apart = 0;
  if (hold == Hold::distance) apart = style_.distance_max * random_.uniform(0.2, 2);
  if (slides(hold) && random_.chance(0.5)) apart = style_.distance_max * random_.uniform(-1, 1);
  join(a, b, point, hold, frame, apart);
}

void Builder::join(uint32_t a, uint32_t b, const Triple& point, Hold hold, const Rotation& frame, double apart) {
  const SceneBody &first = scene_.bodies[a], &other = scene_.bodies[b];
  SceneJoint joint;
  joint.hold = hold;
  joint.a = a;
  joint.b = b;
  const double half_lean = hold == Hold::cone_twist && random_.chance(0.5) ? random_.uniform(0.05, 0.5) : 0;
  // The axis is across x, so that there is no twist.
  const Rotation frame_b = product(frame, rotate_about(random_.perpendicular(k_x), half_lean));
  joint.anchor_a = unrotate(first.rotation, point - first.position);
  joint.anchor_b = unrotate(other.rotation, point + rotate(frame, k_x) * apart - other.position);
  joint.frame_a = normalised(product(conjugate(first.rotation), frame));
  joint.frame_b = normalised(product(conjugate(other.rotation), frame_b));
  if (hold == Hold::distance) {
    const bool rod = random_.chance(0.5);
    joint.axis.limited = true;
    joint.axis.lower = rod ? apart : 0;
    joint.axis.upper = rod || random_.chance(0.3) ? apart : apart * random_.uniform(1, 1.3);
  }
  if (style_.limits) add_limits(joint, apart, angle_of(half_lean));
  // Without limits a slide of several seconds makes arms of a thousand times the body's size. In a pair a second joint
  // may limit it.
  const bool bounded = scene_.kind != Kind::pair || random_.chance(0.5);
  if (slides(hold) && !joint.axis.limited && bounded)
    joint.axis = {.limited = true, .lower = apart - style_.distance_max, .upper = apart + style_.distance_max};
  if (style_.drives) add_drives(joint);
  scene_.joints.push_back(joint);
}

void Builder::add_limits(SceneJoint& joint, double apart, double lean) {
  const auto about = [&](SceneAxis& axis, double middle, double most) {
    if (random_.chance(0.5)) return;
    axis.limited = true;
    axis.lower = middle - random_.uniform(0, most);
    axis.upper = middle + random_.uniform(0, most);
  };
  switch (joint.hold) {
    case Hold::hinge:
      about(joint.axis, 0, 2);
      break;
    case Hold::slider:
    case Hold::wheel:
      about(joint.axis, apart, style_.distance_max);
      break;
    case Hold::cone_twist:
      about(joint.axis, 0, 2);
      if (random_.chance(0.5)) joint.second = {.limited = true, .upper = lean + random_.uniform(0.05, 1)};
      break;
    default:
      break;
  }
}

void Builder::add_drives(SceneJoint& joint) {
  const auto drive = [&](SceneAxis& axis, double middle, double swing, double lever) {
    const double weight = style_.mass * spread(random_, 1, style_.mass_ratio > 1 ? style_.mass_ratio : 2);
    const double force = to_float(weight * lever * spread(random_, 1, 100));
    switch (random_.below(4)) {
      case 0:  // a motor, or a brake
        axis.speed = random_.chance(0.2) ? 0 : random_.uniform(-5, 5) * lever;
        axis.force_max = force;
        break;
      case 1:
        axis.frequency = spread(random_, 0.2, 20);
        axis.damping_ratio = random_.uniform(0, 2);
        axis.target = middle + random_.uniform(-1, 1) * swing;
        axis.force_max = force;
        break;
      case 2:  // at rest at the start, so it returns at most the energy that it has stored
        if (joint.hold != Hold::hinge) break;
        axis.frequency = spread(random_, 0.2, 20);
        axis.damping_ratio = random_.uniform(0, 2);
        break;
      default:
        break;
    }
  };
  const double length = style_.distance_max;
  switch (joint.hold) {
    case Hold::hinge:
      drive(joint.axis, 0, 1, length);
      break;
    case Hold::slider:
      drive(joint.axis, 0, length, 1);
      break;
    case Hold::wheel:
      drive(joint.axis, 0, length, 1);
      drive(joint.second, 0, 1, length);
      break;
    case Hold::cone_twist:
      drive(joint.axis, 0, 1, length);
      break;
    case Hold::distance:
      if (joint.axis.lower < joint.axis.upper) drive(joint.axis, joint.axis.upper, 0.3 * joint.axis.upper, 1);
      break;
    default:
      break;
  }
}

void set_any_velocities(Scene& scene, double speed, double angular_velocity, Random& random) {
  for (SceneBody& body : scene.bodies) {
    if (body.fixed) continue;
    body.linear_velocity = to_float(any_vector(random, speed));
    body.angular_velocity = to_float(any_vector(random, angular_velocity));
  }
}

void set_fitting_velocities(Scene& scene, bool is_tree, double speed, double angular_velocity, Random& random) {
  const bool held = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const SceneBody& b) { return b.fixed; });
  const Triple rotation_vector = any_vector(random, angular_velocity), displacement = any_vector(random, speed);
  if (!is_tree) {
    for (SceneBody& body : scene.bodies) {
      if (held) continue;
      body.angular_velocity = rotation_vector;
      body.linear_velocity = displacement + cross(rotation_vector, body.position - scene.bodies[0].position);
    }
    return;
  }
  if (!scene.bodies[0].fixed) {
    scene.bodies[0].angular_velocity = rotation_vector;
    scene.bodies[0].linear_velocity = displacement;
  }
  for (const SceneJoint& joint : scene.joints) {
    const SceneBody& a = scene.bodies[joint.a];
    SceneBody& b = scene.bodies[joint.b];
    const Rotation frame = product(a.rotation, joint.frame_a);
    const Triple x = rotate(frame, k_x);
    const Triple anchor = b.position + rotate(b.rotation, joint.anchor_b);
    const double rate = random.uniform(-1, 1) * angular_velocity, slide = random.uniform(-1, 1) * speed;
    Triple own = {}, along = {};
    if (joint.hold == Hold::hinge) own = x * rate;
    if (joint.hold == Hold::wheel) own = rotate(frame, {0, 0, 1}) * rate;
    if (joint.hold == Hold::ball || joint.hold == Hold::cone_twist || joint.hold == Hold::distance)
      own = any_vector(random, angular_velocity);
    if (slides(joint.hold)) along = x * slide;
    b.angular_velocity = a.angular_velocity + own;
    const Triple at_anchor = a.linear_velocity + cross(a.angular_velocity, anchor - a.position) + along;
    b.linear_velocity = at_anchor - cross(b.angular_velocity, anchor - b.position);
  }
}

}  // namespace detent_joint_fuzz
