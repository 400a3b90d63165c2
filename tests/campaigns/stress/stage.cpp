#include "tests/campaigns/stress/stage.h"

#include <math.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "tests/common/queries/random.h"
#include "tests/common/queries/triple.h"

namespace detent_stress {

namespace {

constexpr double k_pi = 3.14159265358979323846;
/// For an icosahedron: circumradius over edge, volume over the cube of the edge, and moment of inertia per unit mass
/// over the square of the edge.
constexpr double k_radius_of_edge = 0.95105651629515357212;
constexpr double k_volume_of_edge = 2.18169499062491237350;
constexpr double k_inverse_inertia_of_edge = 0.26180339887498948482;

double cube(double value) { return value * value * value; }

double volume_of(const StageBody& body) {
  const double r = body.size[0];
  switch (body.solid) {
    case Solid::box:
      return 8 * body.size[0] * body.size[1] * body.size[2];
    case Solid::sphere:
      return 4 * k_pi / 3 * cube(r);
    case Solid::capsule:
      return 4 * k_pi / 3 * cube(r) + 2 * k_pi * r * r * body.size[1];
    case Solid::icosahedron:
      return k_volume_of_edge * cube(r / k_radius_of_edge);
    case Solid::half_space:
      break;
  }
  return 0;
}

/// The product a b of quaternions x, y, z, w: b followed by a.
void multiply(const double (&a)[4], const double (&b)[4], double (&result)[4]) {
  const double product[4] = {
      a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
      a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  for (int i = 0; i < 4; ++i) result[i] = product[i];
}

bool is_ground(const StageBody& body) {
  const double(&q)[4] = body.rotation;
  return body.role == Role::fixed && q[0] == 0 && q[1] == 0 && q[2] == 0 &&
         (body.solid == Solid::half_space ||
          (body.solid == Solid::box && detent_test::is_wide_as_ground(body.size[0], body.size[1], body.size[2])));
}

}  // namespace

States states_at_start(const Stage& stage) {
  States states;
  for (const StageBody& body : stage.bodies) {
    BodyState state;
    for (int i = 0; i < 3; ++i) {
      state.position[i] = body.position[i];
      state.linear_velocity[i] = body.linear_velocity[i];
      state.angular_velocity[i] = body.angular_velocity[i];
    }
    for (int i = 0; i < 4; ++i) state.rotation[i] = body.rotation[i];
    states.push_back(state);
  }
  return states;
}

std::array<double, 3> point_of(const BodyState& state, const double (&point)[3]) {
  const double(&q)[4] = state.rotation;
  const auto arm = detent_queries::rotate({q[0], q[1], q[2], q[3]}, {point[0], point[1], point[2]});
  return {state.position[0] + arm[0], state.position[1] + arm[1], state.position[2] + arm[2]};
}

Stage scaled(const Stage& stage, double factor) {
  Stage result = stage;
  const double root = sqrt(factor);
  result.unit *= factor;
  result.tick *= root;
  for (StageBody& body : result.bodies) {
    for (int i = 0; i < 3; ++i) {
      body.size[i] *= factor;
      body.position[i] *= factor;
      body.linear_velocity[i] *= root;
      body.angular_velocity[i] /= root;
    }
    body.mass *= cube(factor);
  }
  for (StageJoint& joint : result.joints) {
    for (double& coordinate : joint.anchor_a) coordinate *= factor;
    for (double& coordinate : joint.anchor_b) coordinate *= factor;
  }
  return result;
}

Stage moved(const Stage& stage, double distance) {
  Stage result = stage;
  for (StageBody& body : result.bodies) {
    for (double& coordinate : body.position) coordinate = rint(coordinate * 0x1p28) * 0x1p-28 + distance;
  }
  return result;
}

Stage varied(const Stage& stage, uint64_t seed) {
  if (seed == 0) return stage;
  Stage result = stage;
  detent_queries::Random random(seed);
  size_t first = 0;
  while (first < result.bodies.size() && result.bodies[first].role != Role::dynamic) ++first;
  std::vector<uint32_t> was(result.bodies.size());  // for each body its index in the original stage
  std::iota(was.begin(), was.end(), 0);
  for (size_t i = result.bodies.size(); i > first + 1; --i) {
    const size_t other = first + random.below(static_cast<uint32_t>(i - first));
    std::swap(result.bodies[i - 1], result.bodies[other]);
    std::swap(was[i - 1], was[other]);
  }
  for (StageJoint& joint : result.joints) {
    for (uint32_t* body : {&joint.a, &joint.b})
      *body = static_cast<uint32_t>(std::find(was.begin(), was.end(), *body) - was.begin());
  }
  double s = 0, c = 0;  // of half the angle
  for (double square = 0; square < 0.01 || square > 1;) {
    s = random.uniform(-1, 1);
    c = random.uniform(-1, 1);
    square = s * s + c * c;
  }
  const double norm = sqrt(s * s + c * c);
  s /= norm;
  c /= norm;
  const double rotation_vector[4] = {0, s, 0, c}, sine = 2 * s * c, cosine = c * c - s * s;
  for (StageBody& body : result.bodies) {
    for (double* v : {body.position, body.linear_velocity, body.angular_velocity}) {
      const double x = v[0], z = v[2];
      v[0] = cosine * x + sine * z;
      v[2] = cosine * z - sine * x;
    }
    multiply(rotation_vector, body.rotation, body.rotation);
  }
  return result;
}

bool has_ground(const Stage& stage) { return std::count_if(stage.bodies.begin(), stage.bodies.end(), is_ground) == 1; }

Stage on_ground(const Stage& stage, detent_test::Ground ground) {
  Stage result = stage;
  if (ground == detent_test::Ground::own || !has_ground(stage)) return result;
  StageBody& body = *std::find_if(result.bodies.begin(), result.bodies.end(), is_ground);
  const bool was_box = body.solid == Solid::box;
  const double top = body.position[1] + (was_box ? body.size[1] : 0);
  if (ground == detent_test::Ground::half_space) {
    body.solid = Solid::half_space;
    body.position[1] = top;
    return result;
  }
  for (const int axis : {0, 2})
    body.size[axis] = std::max(was_box ? body.size[axis] : 0, detent_test::k_ground_half_width);
  body.solid = Solid::box;
  body.size[1] = detent_test::k_ground_half_height;
  body.position[1] = top - detent_test::k_ground_half_height;
  return result;
}

double mass_of(const StageBody& body) { return body.mass != 0 ? body.mass : body.density * volume_of(body); }

std::array<double, 3> inverse_inertia_of(const StageBody& body) {
  const double r = body.size[0];
  switch (body.solid) {
    case Solid::box: {
      const double x = body.size[0] * body.size[0], y = body.size[1] * body.size[1], z = body.size[2] * body.size[2];
      return {(y + z) / 3, (z + x) / 3, (x + y) / 3};
    }
    case Solid::sphere:
      return {0.4 * r * r, 0.4 * r * r, 0.4 * r * r};
    case Solid::capsule: {
      // A cylinder of half length l and two half balls; the half balls' centres of mass are 3 r / 8 beyond its ends.
      const double l = body.size[1], ball = 4.0 / 3 * cube(r), tube = 2 * r * r * l, mass = ball + tube;
      const double about = tube * r * r / 2 + ball * 0.4 * r * r;
      const double across = tube * (r * r / 4 + l * l / 3) + ball * (0.4 * r * r + l * l + 0.75 * l * r);
      return {across / mass, about / mass, across / mass};
    }
    case Solid::icosahedron: {
      const double edge = r / k_radius_of_edge, square = k_inverse_inertia_of_edge * edge * edge;
      return {square, square, square};
    }
    case Solid::half_space:
      break;
  }
  return {};
}

double bounding_radius(const StageBody& body) {
  switch (body.solid) {
    case Solid::box:
      return sqrt(body.size[0] * body.size[0] + body.size[1] * body.size[1] + body.size[2] * body.size[2]);
    case Solid::capsule:
      return body.size[0] + body.size[1];
    case Solid::half_space:
      return HUGE_VAL;
    case Solid::sphere:
    case Solid::icosahedron:
      break;
  }
  return body.size[0];
}

std::vector<std::array<double, 3>> icosahedron_points(double radius) {
  const double golden = (1 + sqrt(5.0)) / 2, size = radius / sqrt(1 + golden * golden);
  std::vector<std::array<double, 3>> points;
  for (const double a : {-size, size}) {
    for (const double b : {-size * golden, size * golden}) {
      points.push_back({0, a, b});
      points.push_back({a, b, 0});
      points.push_back({b, 0, a});
    }
  }
  return points;
}

}  // namespace detent_stress
