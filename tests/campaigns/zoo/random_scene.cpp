#include "tests/campaigns/zoo/random_scene.h"

#include <math.h>
#include <stdio.h>

#include <initializer_list>
#include <iterator>

#include "tests/common/queries/random.h"

// The members of a braced list are evaluated in their order, so random numbers are drawn within such lists, not as
// arguments of a call.
namespace detent_zoo {

namespace {

using detent_queries::Random;

constexpr uint32_t k_ticks = 2700;  // a disc may roll for 30 s
constexpr uint32_t k_bodies_max = 6;

/// A shape's text, and the radius of a ball about the body's origin that contains it, m.
struct Solid {
  std::string kind, text;
  double radius;
};

/// Fixed bodies, one a line, and the greatest height near the origin, m.
struct Ground {
  std::string kind;
  double top;
  std::string text;
};

/// A cooked file of scenes/.
struct Cooked {
  const char* kind;
  const char* suffix;
  double radius;  ///< at least that of the ball about the origin, m
  bool alone;     ///< too large for a heap, or never at rest in it because it rolls
};
constexpr Cooked k_cooked[] = {
    {"arch_stone", "hull", 1, false},    {"chamfered_slab", "hull", 2.4, true}, {"cup", "hull", 0.3, false},
    {"edge", "hull", 1.2, true},         {"icosahedron", "hull", 0.5, false},   {"prism_15", "hull", 0.8, false},
    {"prism_16", "hull", 0.4, false},    {"rock", "hull", 0.9, false},          {"top", "hull", 2.5, true},
    {"wedge", "hull", 4.5, true},        {"wheel", "hull", 0.4, false},         {"drum", "compound", 4.5, true},
    {"dumbbell", "compound", 0.5, true}, {"ell", "compound", 1, false},         {"hoop", "compound", 0.5, false},
    {"jack", "compound", 0.4, false},    {"ring", "compound", 1.3, true},       {"table", "compound", 0.8, false},
    {"tree", "compound", 4, true},       {"weeble", "compound", 3.6, true},     {"wheel_of_37", "compound", 0.5, false},
};

std::string number_text(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string list_text(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + number_text(value);
  return text + "]";
}

/// From 2^low to 2^high, about log-uniform. Without logarithms, whose last bits differ between C libraries.
double octaves(Random& random, int low, int high) {
  const int octave = low + static_cast<int>(random.below(static_cast<uint32_t>(high - low)));
  return ldexp(random.uniform(1, 2), octave);
}

std::string rotation_text(Random& random) {
  const detent_queries::Rotation q = random.rotation();
  return list_text({q[0], q[1], q[2], q[3]});
}

std::string box_text(std::initializer_list<double> half_extents) {
  return "{\"type\": \"box\", \"half_extents\": " + list_text(half_extents) + "}";
}

/// `kind`: capsule, cylinder, cone.
std::string round_text(const char* kind, double radius, double half_length) {
  return "{\"type\": \"" + std::string(kind) + "\", \"radius\": " + number_text(radius) +
         ", \"half_length\": " + number_text(half_length) + "}";
}

std::string file_text(const std::string& type, const std::string& file) {
  return "{\"type\": \"" + type + "\", \"file\": \"" + file + "\"}";
}

Solid any_box(const char* kind, double x, double y, double z) {
  return {kind, box_text({x, y, z}), sqrt(x * x + y * y + z * z)};
}

Solid any_round(const char* kind, double radius, double half_length) {
  return {kind, round_text(kind, radius, half_length), radius + half_length};
}

Solid any_cooked(Random& random, bool alone, const std::string& assets) {
  for (;;) {
    const Cooked& cooked = k_cooked[random.below(static_cast<uint32_t>(std::size(k_cooked)))];
    if (cooked.alone && !alone) continue;
    return {cooked.kind, file_text(cooked.suffix, assets + cooked.kind + "." + cooked.suffix), cooked.radius};
  }
}

/// `alone`: there is no other body.
Solid any_solid(Random& random, bool alone, const std::string& assets) {
  const uint32_t kind = random.below(10);
  const double size = octaves(random, -3, 0) * (alone ? 1 : 0.5);
  if (kind >= 8) return any_cooked(random, alone, assets);
  const double wide[] = {size * octaves(random, -3, 0), size * octaves(random, -3, 0), size * octaves(random, -3, 0)};
  const double thin[] = {size * octaves(random, -5, -2), size * octaves(random, -5, -2)};
  const double half[] = {size * octaves(random, -1, 0)};
  switch (kind) {
    case 0:
    case 1:
      return any_box("box", wide[0], wide[1], wide[2]);
    case 2:
      return any_box("plate", size, thin[0], half[0]);
    case 3:
      return any_box("rod", thin[0], size, thin[1]);
    case 4:
      return any_round("capsule", 2 * thin[0], size);
    case 5:
    case 6:
      return any_round("cylinder", wide[0], wide[1]);
    default:
      return any_round("cone", half[0], wide[1]);
  }
}

std::string fixed_text(const std::string& name, const std::string& pose, const std::string& shape) {
  return "    {\"name\": \"" + name + "\", \"type\": \"fixed\", \"position\": " + pose + ", \"shape\": " + shape +
         ", \"material\": \"felt\"}";
}

std::string floor_text(double top) { return fixed_text("floor", list_text({0, top, 0}), "{\"type\": \"half_space\"}"); }

std::string tilted_text(const std::string& name, double x, double degrees, std::initializer_list<double> half_extents) {
  const std::string pose =
      list_text({x, 0, 0}) + ", \"rotation\": {\"axis\": [0, 0, 1], \"degrees\": " + number_text(degrees) + "}";
  return fixed_text(name, pose, box_text(half_extents));
}

std::string blocks_text(Random& random) {
  std::string text = floor_text(0);
  for (int i = 0; i < 12; ++i) {
    const double place[] = {random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
    const std::string pose = list_text({place[0], 0, place[1]}) + ", \"rotation\": " + rotation_text(random);
    const std::string shape = box_text({random.uniform(0.1, 0.6), random.uniform(0.1, 0.6), random.uniform(0.1, 0.6)});
    text += ",\n" + fixed_text("block " + std::to_string(i), pose, shape);
  }
  return text;
}

Ground terrain(const char* kind, const std::string& file, double x, double top) {
  return {kind, top, fixed_text(kind, list_text({x, 0, 0}), file_text("terrain", file)) + ",\n" + floor_text(-0.6)};
}

Ground any_ground(Random& random, const std::string& assets) {
  switch (random.below(7)) {
    case 0:
      return terrain("hills", assets + "hills.field", 0, 2);
    case 1:
      return terrain("waves", assets + "waves.mesh", -12, 0);
    case 2:
      return terrain("bowl", assets + "bowl.mesh", 0, 1.5);
    case 3:
      return {"ridge", 0.71, tilted_text("ridge", 0, 45, {0.5, 0.5, 5}) + ",\n" + floor_text(0)};
    case 4: {
      const double degrees[] = {15.0 * (1 + random.below(4)), -15.0 * (1 + random.below(4))};
      return {"vee", 3,
              tilted_text("right", 1, degrees[0], {3, 0.5, 5}) + ",\n" +
                  tilted_text("left", -1, degrees[1], {3, 0.5, 5}) + ",\n" + floor_text(-2)};
    }
    case 5:
      return {"blocks", 1.05, blocks_text(random)};
    default:
      return {"flat", 0, fixed_text("slab", list_text({0, -0.5, 0}), box_text({20, 0.5, 20})) + ",\n" + floor_text(-1)};
  }
}

std::string dynamic_text(Random& random, const std::string& name, const Solid& solid, double height, double spread) {
  const double place[] = {random.uniform(-spread, spread), random.uniform(-spread, spread)};
  const double velocity[] = {random.uniform(-1, 1), random.uniform(-1, 1)};
  const std::string rotation = rotation_text(random);
  return "    {\"name\": \"" + name + "\", \"position\": " + list_text({place[0], height, place[1]}) +
         ", \"rotation\": " + rotation + ", \"linear_velocity\": " + list_text({velocity[0], 0, velocity[1]}) +
         ", \"angular_velocity\": " + list_text({random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}) +
         ",\n     \"shape\": " + solid.text + ", \"material\": \"felt\"}";
}

}  // namespace

RandomScene random_scene(uint64_t seed, const std::string& assets) {
  Random random(seed);
  const bool alone = random.chance(0.5);
  const Ground ground = any_ground(random, assets);
  RandomScene scene = {ground.kind, alone ? 1 : 2 + random.below(k_bodies_max - 1), ""};
  std::string bodies = ground.text;
  double height = ground.top;
  for (uint32_t i = 1; i <= scene.bodies; ++i) {
    const Solid solid = any_solid(random, alone, assets);
    height += solid.radius + random.uniform(0.05, alone ? 1 : 0.3);
    bodies += ",\n" + dynamic_text(random, solid.kind + " " + std::to_string(i), solid, height, alone ? 1 : 0.3);
    height += solid.radius;
  }
  scene.text = "{\n  \"format\": 1,\n  \"description\": \"Random scene " + std::to_string(seed) + ": " +
               std::to_string(scene.bodies) + " on " + scene.ground + "\",\n  \"ticks\": " + std::to_string(k_ticks) +
               ",\n  \"materials\": {\"felt\": {\"rolling_resistance\": 0.1}},\n  \"bodies\": [\n" + bodies +
               "\n  ]\n}\n";
  return scene;
}

}  // namespace detent_zoo
