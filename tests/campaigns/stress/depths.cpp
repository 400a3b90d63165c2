#include <detent/contact.h>
#include <detent/numbers.h>
#include <math.h>

#include <algorithm>

#include "tests/campaigns/stress/icosahedron.h"
#include "tests/campaigns/stress/measures.h"

namespace detent_stress {

struct DepthMeter::Solids {
  std::vector<detent::Convex> convexes;
  std::vector<std::array<double, 4>> rotations;  ///< from the convex shape's axes to the body's
  std::vector<double> radii;
  std::vector<bool> moves;
  std::vector<CookedIcosahedron> hulls;
};

namespace {

using detent::Real;

Real real(double value) {
  Real result = 0.0;
  // A value beyond the library's range is far from everything.
  if (detent::real_from_host(value, result) != detent::Status::ok) result = 65536.0;
  return result;
}

detent::Pose pose_of(const BodyState& state, const double (&origin)[3], const std::array<double, 4>& rotation_vector) {
  detent::Pose pose;
  detent::Coord* const coordinates[3] = {&pose.position.x, &pose.position.y, &pose.position.z};
  for (int i = 0; i < 3; ++i) {
    *coordinates[i] = 0.0;
    static_cast<void>(detent::coord_from_host(state.position[i] - origin[i], *coordinates[i]));
  }
  const double(&a)[4] = state.rotation;
  double q[4] = {
      a[3] * rotation_vector[0] + a[0] * rotation_vector[3] + a[1] * rotation_vector[2] - a[2] * rotation_vector[1],
      a[3] * rotation_vector[1] - a[0] * rotation_vector[2] + a[1] * rotation_vector[3] + a[2] * rotation_vector[0],
      a[3] * rotation_vector[2] + a[0] * rotation_vector[1] - a[1] * rotation_vector[0] + a[2] * rotation_vector[3],
      a[3] * rotation_vector[3] - a[0] * rotation_vector[0] - a[1] * rotation_vector[1] - a[2] * rotation_vector[2]};
  const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  detent::Unit* const units[4] = {&pose.rotation.x, &pose.rotation.y, &pose.rotation.z, &pose.rotation.w};
  for (int i = 0; i < 4; ++i) {
    *units[i] = 0.0;
    static_cast<void>(detent::unit_from_host(q[i] / norm, *units[i]));
  }
  return pose;
}

}  // namespace

DepthMeter::DepthMeter(const Stage& stage) : solids_(new Solids) {
  Solids& solids = *solids_;
  solids.hulls.reserve(stage.bodies.size());
  for (const StageBody& body : stage.bodies) {
    detent::Convex convex;
    std::array<double, 4> rotation = {0, 0, 0, 1};
    detent::Status status = detent::Status::ok;
    switch (body.solid) {
      case Solid::box:
        status = make_convex(detent::box({real(body.size[0]), real(body.size[1]), real(body.size[2])}), convex);
        break;
      case Solid::sphere:
        status = make_convex(detent::sphere(real(body.size[0])), convex);
        break;
      case Solid::capsule:
        status = make_convex(detent::capsule(real(body.size[0]), real(body.size[1])), convex);
        break;
      case Solid::icosahedron: {
        solids.hulls.push_back(cook_icosahedron(body.size[0]));
        const CookedIcosahedron& hull = solids.hulls.back();
        rotation = hull.rotation;
        status = make_hull({reinterpret_cast<const uint8_t*>(hull.words.data()), hull.byte_count}, real(0), convex);
        break;
      }
      case Solid::half_space:  // not convex: stages are judged on the box of the same height
        status = detent::Status::bad_argument;
        break;
    }
    if (status != detent::Status::ok) __builtin_trap();  // the stage's shapes are convex and in range
    solids.convexes.push_back(convex);
    solids.rotations.push_back(rotation);
    solids.radii.push_back(bounding_radius(body));
    solids.moves.push_back(body.role == Role::dynamic);
  }
}

DepthMeter::~DepthMeter() = default;

Depths DepthMeter::measure(const States& states) const {
  const Solids& solids = *solids_;
  Depths depths;
  if (states.empty()) return depths;
  std::vector<uint32_t> order(states.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto low = [&](uint32_t i) { return states[i].position[0] - solids.radii[i]; };
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) { return low(i) < low(j); });
  std::vector<detent::Pose> poses;
  for (size_t i = 0; i < states.size(); ++i)
    poses.push_back(pose_of(states[i], states[0].position, solids.rotations[i]));
  for (size_t first = 0; first < order.size(); ++first) {
    const uint32_t a = order[first];
    for (size_t second = first + 1; second < order.size(); ++second) {
      const uint32_t b = order[second];
      const double distance_max = solids.radii[a] + solids.radii[b];
      if (low(b) > states[a].position[0] + solids.radii[a]) break;
      if (!solids.moves[a] && !solids.moves[b]) continue;
      double square = 0;
      for (int i = 0; i < 3; ++i)
        square += (states[a].position[i] - states[b].position[i]) * (states[a].position[i] - states[b].position[i]);
      if (!(square < distance_max * distance_max)) continue;
      detent::ContactManifold manifold;
      if (contact_points(solids.convexes[a], poses[a], solids.convexes[b], poses[b], real(0), manifold) !=
          detent::Status::ok)
        continue;
      double depth = 0;
      for (uint32_t i = 0; i < manifold.count; ++i)
        depth = fmax(depth, -detent::real_to_host(manifold.point[i].separation));
      if (depth <= 0) continue;
      depths.mean += depth;
      depths.max = fmax(depths.max, depth);
      ++depths.pairs;
    }
  }
  if (depths.pairs != 0) depths.mean /= depths.pairs;
  return depths;
}

}  // namespace detent_stress
