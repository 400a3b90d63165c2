#include "tests/campaigns/joint_fuzz/random_scene.h"

#include <algorithm>

#include "tests/campaigns/joint_fuzz/build.h"
#include "tests/campaigns/joint_fuzz/turn.h"

namespace detent_joint_fuzz {

namespace {

using detent_queries::to_float;

constexpr double k_gravity = 9.81;
constexpr double k_pi = 3.14159265358979323846;
constexpr double k_tip_speed_max = 200;  ///< m/s
constexpr uint32_t k_bodies_max = 24;
constexpr uint32_t k_tries = 200;  ///< attempts to find a scene whose bodies do not overlap at the start

/// The result of a scene's construction.
struct Made {
  bool is_tree = true;  ///< joint k connects body k + 1 to an earlier body
};

Style any_style(Kind kind, Random& random) {
  Style style;
  const bool far = kind == Kind::pair || kind == Kind::tree;
  const bool many = kind == Kind::contact || kind == Kind::ground;
  style.distance_max = many ? spread(random, 0.05, 1) : spread(random, 0.01, far ? 16 : 4);
  if (kind == Kind::rope) style.distance_max = spread(random, 1, 16);
  const double least = std::max(0.02, 0.003 / style.distance_max);
  style.size = random.chance(0.6) ? spread(random, 0.3, 1) : spread(random, std::min(least, 0.5), 1);
  if (kind == Kind::contact) style.size = spread(random, 0.05, 0.3);
  style.mass = spread(random, 0.01, 100);
  constexpr double k_ratios[] = {1, 1, 10, 100, 10000};
  style.mass_ratio = k_ratios[random.below(5)];
  style.mixed = random.chance(0.4);
  style.hold = static_cast<Hold>(1 + random.below(k_holds));
  style.limits = random.chance(0.3);
  style.drives = kind == Kind::drive;
  return style;
}

/// Adds bodies until there are `count`, each with a joint to an earlier body: a chain, a bush, or a mixture.
void grow_tree(Builder& build, Scene& scene, uint32_t count, Random& random) {
  const double chain = random.uniform(0, 1);
  while (scene.bodies.size() < count) {
    const uint32_t last = static_cast<uint32_t>(scene.bodies.size() - 1);
    const uint32_t from = random.chance(chain) ? last : random.below(last + 1);
    const Triple point = scene.bodies[from].position + build.arm();
    const uint32_t to = build.add_body(point + build.arm());
    const Hold hold = build.any_hold();
    build.join(from, to, point, hold);
  }
}

/// Adds a joint between two existing bodies, near a point between them.
void close_loop(Builder& build, const Scene& scene, uint32_t a, uint32_t b, Random& random) {
  const Triple &from = scene.bodies[a].position, &to = scene.bodies[b].position;
  const Triple middle = from + (to - from) * random.uniform(0, 1);
  const Hold hold = build.any_hold();
  build.join(a, b, middle + build.arm(), hold);
}

Made make_pair(Builder& build, Scene& scene, Random& random) {
  build.add_body({0, 0, 0});
  const Triple point = build.arm();
  build.add_body(point + build.arm());
  const Hold hold = build.any_hold();
  build.join(0, 1, point, hold);
  if (random.chance(0.35)) return {};
  close_loop(build, scene, 0, 1, random);
  return {false};
}

Made make_tree(Builder& build, Scene& scene, Random& random, bool hung) {
  if (hung) {
    build.add_wall({0, 0, 0});
  } else {
    build.add_body({0, 0, 0});
  }
  grow_tree(build, scene, 3 + random.below(k_bodies_max - 3), random);
  return {};
}

/// Bodies on a rough circle, with attached trees.
Made make_loop(Builder& build, Scene& scene, Random& random, bool hung) {
  const uint32_t count = 3 + random.below(10);
  const double distance_max = build.style().distance_max, radius = distance_max * count / k_pi;
  const double noise = random.chance(0.3) ? 0 : 0.4 * distance_max;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * k_pi * i / count;
    const Triple place = {radius * to_float(cos(angle)), radius * to_float(sin(angle)), 0};
    if (i == 0 && hung) {
      build.add_wall(place);
    } else {
      build.add_body(place + any_vector(random, noise));
    }
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    const Triple middle = (scene.bodies[i].position + scene.bodies[next].position) * 0.5;
    const Hold hold = build.any_hold();
    build.join(i, next, middle + any_vector(random, noise), hold);
  }
  if (random.chance(0.3)) grow_tree(build, scene, count + 1 + random.below(8), random);
  return {false};
}

Made make_grid(Builder& build, Scene& scene, Random& random, bool hung) {
  const uint32_t columns = 2 + random.below(4), rows = 2 + random.below(std::min(k_bodies_max / columns, 5u) - 1);
  const double distance_max = build.style().distance_max, noise = random.chance(0.5) ? 0 : 0.3 * distance_max;
  for (uint32_t i = 0; i < rows * columns; ++i) {
    const Triple place = {distance_max * 2 * (i % columns), distance_max * -2 * (i / columns), 0};
    if (i == 0 && hung) {
      build.add_wall(place);
    } else {
      build.add_body(place + any_vector(random, noise));
    }
  }
  const auto hold = [&](uint32_t a, uint32_t b) {
    const Triple middle = (scene.bodies[a].position + scene.bodies[b].position) * 0.5;
    const Hold type = build.any_hold();
    build.join(a, b, middle + any_vector(random, noise), type);
  };
  for (uint32_t i = 0; i < rows * columns; ++i) {
    if (i % columns != 0) hold(i - 1, i);
    if (i >= columns) hold(i - columns, i);
  }
  return {false};
}

Made make_net(Builder& build, Scene& scene, Random& random, bool hung) {
  if (random.chance(0.5)) return make_grid(build, scene, random, hung);
  make_tree(build, scene, random, hung);
  const uint32_t count = static_cast<uint32_t>(scene.bodies.size());
  for (uint32_t left = 1 + random.below(count); left != 0; --left) {
    const uint32_t a = random.below(count), b = (a + 1 + random.below(count - 1)) % count;
    const double apart = length(scene.bodies[b].position - scene.bodies[a].position);
    if (apart <= 8 * build.style().distance_max) close_loop(build, scene, a, b, random);
  }
  return {false};
}

Made make_rope(Builder& build, Scene& scene, Random& random, bool hung) {
  if (hung) {
    build.add_wall({0, 0, 0});
  } else {
    build.add_body({0, 0, 0});
  }
  const uint32_t count = 2 + random.below(3);
  while (scene.bodies.size() < count) {
    const uint32_t last = static_cast<uint32_t>(scene.bodies.size() - 1);
    const Triple arm = scene.bodies[last].fixed ? Triple{} : build.arm();
    const Triple point = scene.bodies[last].position + arm;
    const double rope = spread(random, 0.01, 0.3);
    const Rotation frame = normalised(random.rotation());
    const Triple end = point + rotate(frame, {1, 0, 0}) * rope;
    const uint32_t to = build.add_body(end + build.arm());
    build.join(last, to, point, Hold::distance, frame, rope);
  }
  return {};
}

/// Links of equal length in a row, the first and last held by walls.
Made make_taut(Builder& build, Random& random) {
  const uint32_t count = 1 + random.below(k_bodies_max - 2);
  const double distance_max = build.style().distance_max;
  const Triple displacement = random.direction();
  // If alike, all hinges rotate about the same axis; otherwise each has its own axis.
  const bool alike = random.chance(0.5);
  const Rotation frame = normalised(random.rotation());
  build.add_wall({0, 0, 0});
  for (uint32_t i = 0; i < count; ++i) build.add_body(displacement * (distance_max * (2 * i + 1)));
  build.add_wall(displacement * (distance_max * 2 * count));
  for (uint32_t i = 0; i <= count; ++i) {
    const Hold hold = build.any_hold();
    const Triple point = displacement * (distance_max * 2 * i);
    if (alike && hold != Hold::distance) {
      build.join(i, i + 1, point, hold, frame, 0);
    } else {
      build.join(i, i + 1, point, hold);
    }
  }
  return {false};
}

Made make(Builder& build, Scene& scene, Random& random) {
  const bool hung = !scene.ground && scene.kind != Kind::pair && random.chance(scene.gravity > 0 ? 0.9 : 0.25);
  switch (scene.kind) {
    case Kind::pair:
      return make_pair(build, scene, random);
    case Kind::tree:
      return make_tree(build, scene, random, hung);
    case Kind::loop:
      return make_loop(build, scene, random, hung);
    case Kind::net:
      return make_net(build, scene, random, hung);
    case Kind::rope:
      return make_rope(build, scene, random, hung);
    case Kind::taut:
      return make_taut(build, random);
    default:
      return random.chance(0.5) ? make_tree(build, scene, random, hung) : make_net(build, scene, random, hung);
  }
}

double radius_of(const SceneBody& body) {
  if (body.solid == Solid::sphere) return body.size[0];
  return body.solid == Solid::capsule ? body.size[0] + body.size[1] : length(body.size);
}

/// Whether the bounding spheres of two bodies that may collide overlap.
bool overlaps(const Scene& scene) {
  for (uint32_t b = 0; b < scene.bodies.size(); ++b) {
    for (uint32_t a = 0; a < b; ++a) {
      const bool jointed = std::any_of(scene.joints.begin(), scene.joints.end(), [&](const SceneJoint& joint) {
        return std::min(joint.a, joint.b) == a && std::max(joint.a, joint.b) == b;
      });
      const double apart = length(scene.bodies[b].position - scene.bodies[a].position);
      if (!jointed && apart < radius_of(scene.bodies[a]) + radius_of(scene.bodies[b])) return true;
    }
  }
  return false;
}

/// Lifts all bodies, so that none is in the ground; the joints do not change.
void lift(Scene& scene, double above) {
  double lowest = 0;
  for (const SceneBody& body : scene.bodies) {
    lowest = std::min(lowest, body.position[1] - radius_of(body));
  }
  const double by = to_float(above - lowest);
  for (SceneBody& body : scene.bodies) body.position[1] += by;
}

double extent_of(const Scene& scene) {
  Triple low = scene.bodies[0].position, high = low;
  const auto take = [&](const Triple& point) {
    for (size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  };
  for (const SceneBody& body : scene.bodies) take(body.position);
  for (const SceneJoint& joint : scene.joints) {
    const SceneBody &a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
    take(a.position + rotate(a.rotation, joint.anchor_a));
    take(b.position + rotate(b.rotation, joint.anchor_b));
  }
  return length(high - low);
}

void set_velocities(Scene& scene, const Made& made, double distance_max, Random& random) {
  constexpr double k_angular_velocities[] = {0, 5, 5, 80, 80};
  const double angular_velocity = std::min(k_angular_velocities[random.below(5)], k_tip_speed_max / (2 * distance_max));
  const double speed = random.chance(0.2) ? 0.1 : 5;
  if (random.chance(0.5)) {
    set_fitting_velocities(scene, made.is_tree, speed, angular_velocity, random);
  } else {
    set_any_velocities(scene, speed, angular_velocity, random);
  }
}

}  // namespace

Kind kind_of(uint64_t seed) {
  constexpr Kind k_row[16] = {Kind::pair, Kind::tree, Kind::loop, Kind::net,  Kind::contact, Kind::tree,
                              Kind::loop, Kind::net,  Kind::rope, Kind::pair, Kind::ground,  Kind::tree,
                              Kind::loop, Kind::net,  Kind::taut, Kind::drive};
  return k_row[seed % 16];
}

Scene random_scene(uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.seed = seed;
  scene.kind = kind_of(seed);
  const Style style = any_style(scene.kind, random);
  scene.ground = scene.kind == Kind::ground;
  scene.collisions = scene.kind == Kind::contact || (scene.ground && random.chance(0.5));
  if (scene.ground || random.chance(1.0 / 3)) scene.gravity = k_gravity;
  Made made;
  for (uint32_t tries_left = k_tries; tries_left != 0; --tries_left) {
    scene.bodies.clear();
    scene.joints.clear();
    Builder build(scene, style, random);
    made = make(build, scene, random);
    if (!scene.collisions || !overlaps(scene)) break;
  }
  if (scene.ground) lift(scene, style.distance_max * random.uniform(0, 2));
  set_velocities(scene, made, style.distance_max, random);
  scene.extent = extent_of(scene);
  return scene;
}

const char* name_of(Kind kind) {
  constexpr const char* k_names[k_kinds] = {"pair", "tree",    "loop",   "net",  "rope",
                                            "taut", "contact", "ground", "drive"};
  return k_names[static_cast<uint32_t>(kind)];
}

const char* name_of(Hold hold) {
  constexpr const char* k_names[k_holds] = {"ball", "hinge", "slider", "distance", "fixed", "cone_twist", "wheel"};
  return k_names[static_cast<uint32_t>(hold) - 1];
}

}  // namespace detent_joint_fuzz
