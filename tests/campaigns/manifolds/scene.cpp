#include "tests/campaigns/manifolds/scene.h"

#include <math.h>

#include <algorithm>

#include "tests/campaigns/manifolds/solids.h"

namespace detent_manifolds {

namespace {

constexpr double k_pi = 3.14159265358979323846;
using Quaternion = std::array<double, 4>;

Quaternion times(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}
Quaternion about(const Arrow& axis, double angle) {
  const double s = sin(angle / 2) / static_cast<double>(detent_oracle::length(axis));
  return {static_cast<double>(axis.x) * s, static_cast<double>(axis.y) * s, static_cast<double>(axis.z) * s,
          cos(angle / 2)};
}
Quaternion normalised(Quaternion q) {
  const double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& component : q) component /= size;
  return q;
}
Arrow turned(const Quaternion& q, const Arrow& v) { return to_world(detent_oracle::frame_of(q), v); }

/// The rotation that maps `out` to +y or -y and `along` to x.
Quaternion seated(const Seat& seat, double up) {
  const Arrow local[3] = {seat.along, seat.out, cross(seat.along, seat.out)};
  const Arrow world[3] = {{1, 0, 0}, {0, up, 0}, {0, 0, up}};
  Number m[3][3] = {};
  for (int k = 0; k < 3; ++k) {
    const Number w[3] = {world[k].x, world[k].y, world[k].z}, l[3] = {local[k].x, local[k].y, local[k].z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += w[i] * l[j];
    }
  }
  // The row of the largest component: proportional to the quaternion, and the most precise.
  const Number square[4] = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                            1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
  const long best = std::max_element(square, square + 4) - square;
  const Number rows[4][4] = {{square[0], m[0][1] + m[1][0], m[0][2] + m[2][0], m[2][1] - m[1][2]},
                             {m[0][1] + m[1][0], square[1], m[1][2] + m[2][1], m[0][2] - m[2][0]},
                             {m[0][2] + m[2][0], m[1][2] + m[2][1], square[2], m[1][0] - m[0][1]},
                             {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], square[3]}};
  Quaternion q;
  for (size_t i = 0; i < 4; ++i) q[i] = static_cast<double>(rows[best][i]);
  return normalised(q);
}

double spread(Dice& dice, double low, double high) { return low * pow(high / low, dice.between(0, 1)); }

/// A pose in `long double` during the construction of a scene.
struct Place {
  Arrow position = {0, 0, 0};
  Quaternion rotation = {0, 0, 0, 1};
};

bool is_round(const Solid& solid) { return solid.kind != SolidKind::box && solid.kind != SolidKind::hull; }
Part part_of_b(Kind kind, Dice& dice) {
  switch (kind) {
    case Kind::edge:
    case Kind::along:
    case Kind::crossing:
      return Part::edge;
    case Kind::corner:
      return Part::corner;
    case Kind::rim:
      return Part::rim;
    case Kind::mesh: {
      constexpr Part k_parts[] = {Part::face, Part::face, Part::edge, Part::corner, Part::rim};
      return k_parts[dice.below(5)];
    }
    default:
      return Part::face;
  }
}

class Maker {
 public:
  Maker(uint64_t seed, Dice& dice) : dice_(dice) {
    scene_.seed = seed;
    scene_.kind = kind_of(seed);
  }
  /// False if the pair does not touch as its kind requires.
  bool make() {
    choose_solids();
    if (!place()) return false;
    move();
    return true;
  }
  const Scene& scene() const { return scene_; }

 private:
  void choose_solids();
  bool place();
  void move();
  bool set_gap();
  Arrow lateral();

  Dice& dice_;
  Scene scene_{};
  Seat seat_a_{}, seat_b_{};
  Place a_{}, b_{};
  double size_ = 0, thickness_ = 0;
  Arrow lean_axis_ = {1, 0, 0};
};

void Maker::choose_solids() {
  const Kind kind = scene_.kind;
  size_ = spread(dice_, 0.01, 10);
  const Part on_b = part_of_b(kind, dice_);
  const Part on_a = kind == Kind::along || kind == Kind::crossing ? Part::edge : Part::face;
  scene_.b = random_solid(dice_, on_b, size_);
  seat_b_ = random_seat(dice_, scene_.b, on_b);
  if (kind == Kind::mesh) {
    constexpr uint32_t k_cells[] = {1, 2, 8, 16};
    scene_.mesh_cells = k_cells[dice_.below(4)];
    const double half = held(8 * size_ / scene_.mesh_cells) * scene_.mesh_cells / 2;
    scene_.a.kind = SolidKind::hull;
    for (const double y : {0.0, -half}) {
      for (const double x : {-half, half}) {
        for (const double z : {-half, half}) scene_.a.points.push_back({x, y, z});
      }
    }
    seat_a_ = {{0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
  } else if (kind == Kind::large) {
    const double larger = std::min(100.0, size_ * spread(dice_, 10, 1000));
    scene_.a = box_of({larger, larger * dice_.between(0.05, 1), larger * dice_.between(0.3, 1)});
    seat_a_ = {{0, 1, 0}, {1, 0, 0}, {0, scene_.a.half_extents[1], 0}};
  } else {
    scene_.a = random_solid(dice_, on_a, std::min(10.0, size_ * spread(dice_, 0.5, 3)));
    seat_a_ = random_seat(dice_, scene_.a, on_a);
  }
  thickness_ =
      scene_.mesh_cells != 0 ? thickness_of(scene_.b) : std::min(thickness_of(scene_.a), thickness_of(scene_.b));
  const bool flat = on_b == Part::face || (on_b == Part::edge && !is_round(scene_.b) && !is_round(scene_.a));
  scene_.tolerance = thickness_ * (flat ? 0x1p-10 : 0x1p-20);
}

/// The offset from A's middle to B's across the normal.
Arrow Maker::lateral() {
  const double angle = dice_.between(0, 2 * k_pi);
  const Arrow displacement = {cos(angle), 0, sin(angle)};
  const detent_oracle::ConvexSolid a = solid_of(scene_.a), b = solid_of(scene_.b);
  const auto distance_max = [](const detent_oracle::ConvexSolid& solid, const Place& at, const Arrow& to) {
    return support_value(solid, to_local(detent_oracle::frame_of(at.rotation), to)) + solid.rounding +
           dot(at.position, to);
  };
  const Number of_a = distance_max(a, a_, displacement), of_b = distance_max(b, b_, -displacement);
  const Number width = std::min(of_a + distance_max(a, a_, -displacement), of_b + distance_max(b, b_, displacement));
  switch (scene_.kind) {
    case Kind::overhang:
      return displacement * (of_a + of_b - width * dice_.between(0.1, 0.9));
    case Kind::along: {
      const Number half = std::min(distance_max(a, a_, {1, 0, 0}), distance_max(b, b_, {1, 0, 0}));
      return Arrow{1, 0, 0} * (half * dice_.between(-0.8, 0.8));
    }
    case Kind::crossing:
      return {0, 0, 0};
    case Kind::large:
    case Kind::mesh:
      return displacement * (of_a * dice_.between(0, 0.4));
    default:
      return dice_.coin() ? Arrow{0, 0, 0} : displacement * (of_a * dice_.between(0, 0.6));
  }
}

bool Maker::set_gap() {
  const detent_oracle::ConvexSolid a = solid_of(scene_.a), b = solid_of(scene_.b);
  for (int i = 0; i < 6; ++i) {
    const detent_oracle::Separation found = separation_of(
        a, b, {detent_oracle::frame_of(a_.rotation), detent_oracle::frame_of(b_.rotation), b_.position - a_.position},
        {thickness_ * 1e-9L, 1e-3L}, {0, 1, 0});
    // The axis must be near the face's normal or the normal of crossing edges, except for B's lean.
    if (found.axis.y < 0.98L) return false;
    const Number off = scene_.gap - found.gap;
    if (fabsl(off) < thickness_ * 1e-8L) return true;
    b_.position.y += off / found.axis.y;
  }
  return true;
}

bool Maker::place() {
  const Kind kind = scene_.kind;
  const int where = dice_.below(6);
  scene_.gap = where == 0  ? 0
               : where < 4 ? -thickness_ * spread(dice_, 1e-6, 1e-2)
                           : thickness_ / 64 * dice_.between(0, 0.9);
  a_.rotation = seated(seat_a_, 1);
  a_.position = -turned(a_.rotation, seat_a_.middle);
  const bool aligned = kind == Kind::aligned || (kind != Kind::turned && kind != Kind::crossing && dice_.below(4) == 0);
  double twist = aligned ? dice_.below(4) * k_pi / 2 : dice_.between(0, 2 * k_pi);
  if (kind == Kind::along) twist = dice_.coin() ? 0 : spread(dice_, 1e-6, 0.1);
  if (kind == Kind::crossing) twist = dice_.between(0.15, k_pi - 0.15);
  b_.rotation = times(about({0, 1, 0}, twist), seated(seat_b_, -1));
  const double direction = dice_.between(0, 2 * k_pi);
  lean_axis_ = {cos(direction), 0, sin(direction)};
  if (kind == Kind::leaning || ((kind == Kind::edge || kind == Kind::mesh) && dice_.coin()))
    scene_.lean = spread(dice_, 1e-6, 0.1);
  b_.rotation = normalised(times(about(lean_axis_, scene_.lean), b_.rotation));
  b_.position = -turned(b_.rotation, seat_b_.middle);
  b_.position = b_.position + lateral();
  b_.position.y += scene_.gap;
  return set_gap();
}

/// Computes the poses of all ticks. In half of the scenes the whole pair is also rotated and moved.
void Maker::move() {
  scene_.motion = static_cast<Motion>(dice_.below(k_motions));
  const double step = std::min(5e-3, thickness_ / 4) * spread(dice_, 1e-3, 1), angle = dice_.between(0, 2 * k_pi);
  const bool ridge = scene_.kind == Kind::along || scene_.kind == Kind::crossing;
  const Arrow displacement = ridge ? Arrow{1, 0, 0} : Arrow{cos(angle), 0, sin(angle)};
  const double angular_velocity = spread(dice_, 1e-5, 1e-2),
               amplitude = 0.01 * thickness_ / size_ * spread(dice_, 1e-3, 1);
  const bool anywhere = dice_.coin();
  const Triple axis = dice_.direction();
  const Quaternion frame =
      anywhere ? about({axis[0], axis[1], axis[2]}, dice_.between(0, k_pi)) : Quaternion{0, 0, 0, 1};
  const Arrow at = anywhere ? dice_.arrow(dice_.between(0, 64)) : Arrow{0, 0, 0};
  const double carried = std::min(0.01, thickness_ * spread(dice_, 1e-4, 1e-2));
  const Arrow carrying = dice_.arrow(carried), pivot = b_.position + turned(b_.rotation, seat_b_.middle);
  const Triple carrying_axis = dice_.direction();
  for (uint32_t tick = 0; tick <= k_ticks; ++tick) {
    Place a = a_, b = b_;
    if (scene_.motion == Motion::slide || scene_.motion == Motion::carried)
      b.position = b.position + displacement * (step * tick);
    Quaternion rotation_vector = {0, 0, 0, 1};
    if (scene_.motion == Motion::rotation_vector) rotation_vector = about({0, 1, 0}, angular_velocity * tick);
    if (scene_.motion == Motion::rock) rotation_vector = about(lean_axis_, amplitude * sin(2 * k_pi * tick / k_ticks));
    b.position = pivot + (b.position - b_.position) + turned(rotation_vector, b_.position - pivot);
    b.rotation = times(rotation_vector, b.rotation);
    Quaternion whole = frame;
    Arrow shift = at;
    if (scene_.motion == Motion::carried) {
      whole = times(about({carrying_axis[0], carrying_axis[1], carrying_axis[2]}, carried / size_ * tick), frame);
      shift = shift + carrying * tick;
    }
    const auto held_at = [&](const Place& place) -> Pose {
      const Arrow p = shift + turned(whole, place.position);
      return {{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)},
              normalised(times(whole, place.rotation))};
    };
    scene_.pose_a.push_back(held_at(a));
    scene_.pose_b.push_back(held_at(b));
  }
}

}  // namespace

Kind kind_of(uint64_t seed) { return static_cast<Kind>(seed % k_kinds); }

Scene random_scene(uint64_t seed) {
  Dice dice(seed);
  for (;;) {
    Maker maker(seed, dice);
    if (maker.make()) return maker.scene();
  }
}

const char* name_of(Kind kind) {
  constexpr const char* k_names[] = {"aligned",  "turned", "overhang", "leaning", "edge", "along",
                                     "crossing", "corner", "rim",      "large",   "mesh"};
  return k_names[static_cast<uint32_t>(kind)];
}
const char* name_of(Motion motion) {
  constexpr const char* k_names[] = {"still", "slide", "rotation_vector", "rock", "carried"};
  return k_names[static_cast<uint32_t>(motion)];
}
const char* name_of(const Solid& solid) {
  constexpr const char* k_names[] = {"sphere", "capsule", "box", "cylinder", "cone", "hull", "triangle", "half-space"};
  return k_names[static_cast<uint32_t>(solid.kind)];
}

std::string Scene::shapes() const {
  const std::string of_a = mesh_cells != 0 ? "mesh" : name_of(a), of_b = name_of(b);
  return of_a < of_b ? of_a + "/" + of_b : of_b + "/" + of_a;
}

double thickness_of(const Solid& solid) {
  switch (solid.kind) {
    case SolidKind::sphere:
    case SolidKind::capsule:
      return 2 * solid.radius;
    case SolidKind::cylinder:
    case SolidKind::cone:
      return 2 * std::min(solid.radius, solid.half_length);
    case SolidKind::box:
      return 2 * std::min({solid.half_extents[0], solid.half_extents[1], solid.half_extents[2]});
    default: {
      Triple most = {0, 0, 0};
      for (const Triple& point : solid.points) {
        for (size_t i = 0; i < 3; ++i) most[i] = std::max(most[i], fabs(point[i]));
      }
      return 2 * std::min({most[0], most[1], most[2]});
    }
  }
}

}  // namespace detent_manifolds
