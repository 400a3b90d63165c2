#include <math.h>
#include <ode/ode.h>
#include <stdio.h>

#include <memory>

#include "tests/bench/world/engine.h"

/// ODE as Debian builds it: dWorldQuickStep with 20 iterations, the faster one of its spaces here (sweep and prune), up
/// to 4 contacts a pair, the surface layer that the manual proposes, all else as it comes.
namespace {

using namespace detent_bench;

constexpr uint32_t k_iterations = 20;
constexpr int k_contacts_max = 4;
constexpr double k_surface_layer = 0.001;  ///< m

#if defined(dDOUBLE)
constexpr const char* k_config = "double";
#else
constexpr const char* k_config = "float";
#endif

struct Surface {
  double friction, restitution;
};

/// What dCreateConvex keeps a pointer to.
struct Convex {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

Convex icosahedron(double radius) {
  const auto corners = detent_stress::icosahedron_points(radius);
  const auto square = [&corners](unsigned i, unsigned j) {
    double sum = 0;
    for (size_t axis = 0; axis < 3; ++axis) sum += pow(corners[i][axis] - corners[j][axis], 2);
    return sum;
  };
  double edge = square(0, 1);
  for (unsigned i = 2; i < corners.size(); ++i) edge = fmin(edge, square(0, i));
  edge *= 1.01;

  Convex convex;
  for (const auto& corner : corners) convex.points.insert(convex.points.end(), corner.begin(), corner.end());
  for (unsigned i = 0; i < corners.size(); ++i) {
    for (unsigned j = i + 1; j < corners.size(); ++j) {
      for (unsigned k = j + 1; k < corners.size(); ++k) {
        if (square(i, j) > edge || square(j, k) > edge || square(i, k) > edge) continue;
        const auto &a = corners[i], &b = corners[j], &c = corners[k];
        const double outward = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                               a[2] * (b[0] * c[1] - b[1] * c[0]);
        convex.polygons.insert(convex.polygons.end(), {3, i, outward > 0 ? j : k, outward > 0 ? k : j});
        double middle[3], length = 0;  // the middle of a face is the foot of its normal
        for (size_t axis = 0; axis < 3; ++axis) {
          middle[axis] = (a[axis] + b[axis] + c[axis]) / 3;
          length += middle[axis] * middle[axis];
        }
        length = sqrt(length);
        convex.planes.insert(convex.planes.end(), {middle[0] / length, middle[1] / length, middle[2] / length, length});
      }
    }
  }
  return convex;
}

class OdeRun : public WorldRun {
 public:
  OdeRun(const Stage& stage, uint32_t iterations, uint32_t steps) : steps_(steps), step_time_(stage.tick / steps) {
    heap_before_ = heap_use().bytes;
    snprintf(settings_, sizeof settings_, "%u iterations, %u steps", iterations, steps);
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    group_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, 0, -stage.gravity, 0);
    dWorldSetQuickStepNumIterations(world_, static_cast<int>(iterations));
    dWorldSetContactSurfaceLayer(world_, k_surface_layer);
    dWorldSetAutoDisableFlag(world_, stage.sleeping ? 1 : 0);
    surfaces_.reserve(stage.bodies.size());
    convexes_.reserve(stage.bodies.size());
    for (const StageBody& body : stage.bodies) add(body, stage.collisions);
    const auto states = detent_stress::states_at_start(stage);
    for (const StageJoint& given : stage.joints) {
      const dJointID joint = dJointCreateBall(world_, nullptr);
      dJointAttach(joint, dGeomGetBody(geoms_[given.a]), dGeomGetBody(geoms_[given.b]));
      const auto at = detent_stress::point_of(states[given.a], given.anchor_a);  // of both, at the start
      dJointSetBallAnchor(joint, at[0], at[1], at[2]);
    }
  }
  ~OdeRun() override {
    dJointGroupDestroy(group_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void step() override {
    for (uint32_t i = 0; i < steps_; ++i) {
      points_ = 0;
      dSpaceCollide(space_, this, near_each_other);
      dWorldQuickStep(world_, step_time_);
      dJointGroupEmpty(group_);
    }
  }

  uint32_t contact_points() const override { return points_; }
  uint64_t losses() const override { return 0; }

  void read(BodyState* states) const override {
    for (size_t i = 0; i < geoms_.size(); ++i) {
      BodyState& state = states[i];
      state = {};
      if (dGeomGetClass(geoms_[i]) == dPlaneClass) continue;  // it has no pose
      const dReal* const position = dGeomGetPosition(geoms_[i]);
      dQuaternion rotation;
      dGeomGetQuaternion(geoms_[i], rotation);
      if (along_z_[i]) rotation_vector(rotation, -1);
      for (int axis = 0; axis < 3; ++axis) {
        state.position[axis] = position[axis];
        state.rotation[axis] = rotation[axis + 1];
      }
      state.rotation[3] = rotation[0];
      const dBodyID body = dGeomGetBody(geoms_[i]);
      if (body == nullptr) continue;
      for (int axis = 0; axis < 3; ++axis) {
        state.linear_velocity[axis] = dBodyGetLinearVel(body)[axis];
        state.angular_velocity[axis] = dBodyGetAngularVel(body)[axis];
      }
    }
  }

  uint64_t bytes() const override { return heap_use().bytes - heap_before_; }
  const char* settings() const override { return settings_; }

 private:
  /// ODE's capsule lies along z: turned by a quarter about x, there (sign 1) and back (-1).
  static void rotation_vector(dReal (&rotation)[4], double sign) {
    const double half = 0.70710678118654752440;
    const dQuaternion quarter = {half, -sign * half, 0, 0};
    dQuaternion before = {rotation[0], rotation[1], rotation[2], rotation[3]};
    dQMultiply0(rotation, before, quarter);
  }

  static void near_each_other(void* run, dGeomID a, dGeomID b) { static_cast<OdeRun*>(run)->collide(a, b); }

  void collide(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    const bool awake_a = body_a != nullptr && dBodyIsEnabled(body_a) != 0;
    const bool awake_b = body_b != nullptr && dBodyIsEnabled(body_b) != 0;
    if (!awake_a && !awake_b) return;
    dContact contacts[k_contacts_max];
    const int count = dCollide(a, b, k_contacts_max, &contacts[0].geom, sizeof(dContact));
    if (count == 0) return;
    const Surface &surface_a = *static_cast<const Surface*>(dGeomGetData(a)),
                  &surface_b = *static_cast<const Surface*>(dGeomGetData(b));
    const double friction = sqrt(surface_a.friction * surface_b.friction);
    const double restitution = fmax(surface_a.restitution, surface_b.restitution);
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[i];
      contact.surface = {};
      contact.surface.mode = dContactApprox1 | (restitution > 0 ? dContactBounce : 0);
      contact.surface.mu = friction;
      contact.surface.bounce = restitution;
      dJointAttach(dJointCreateContact(world_, group_, &contact), body_a, body_b);
    }
    points_ += static_cast<uint32_t>(count);
  }

  dGeomID geom_of(const StageBody& body) {
    const double* size = body.size;
    switch (body.solid) {
      case Solid::box:
        return dCreateBox(space_, 2 * size[0], 2 * size[1], 2 * size[2]);
      case Solid::sphere:
        return dCreateSphere(space_, size[0]);
      case Solid::capsule:
        return dCreateCapsule(space_, size[0], 2 * size[1]);
      case Solid::icosahedron: {
        convexes_.push_back(icosahedron(size[0]));
        const Convex& convex = convexes_.back();
        return dCreateConvex(space_, convex.planes.data(), static_cast<unsigned>(convex.planes.size() / 4),
                             convex.points.data(), static_cast<unsigned>(convex.points.size() / 3),
                             convex.polygons.data());
      }
      case Solid::half_space:
        return dCreatePlane(space_, 0, 1, 0, body.position[1]);
    }
    return nullptr;
  }

  void add(const StageBody& given, bool collides) {
    const dGeomID geom = geom_of(given);
    geoms_.push_back(geom);
    along_z_.push_back(given.solid == Solid::capsule);
    surfaces_.push_back({given.friction, given.restitution});
    dGeomSetData(geom, &surfaces_.back());
    if (!collides) {
      dGeomSetCategoryBits(geom, 0);
      dGeomSetCollideBits(geom, 0);
    }
    if (given.role != Role::fixed) {
      const dBodyID body = dBodyCreate(world_);
      dMass mass;
      dMassSetZero(&mass);
      const double kilograms = detent_stress::mass_of(given);
      const auto inverse_inertia = detent_stress::inverse_inertia_of(given);
      const size_t y = along_z_.back() ? 2 : 1, z = along_z_.back() ? 1 : 2;
      dMassSetParameters(&mass, kilograms, 0, 0, 0, kilograms * inverse_inertia[0], kilograms * inverse_inertia[y],
                         kilograms * inverse_inertia[z], 0, 0, 0);
      dBodySetMass(body, &mass);
      if (given.role == Role::kinematic) dBodySetKinematic(body);
      dBodySetLinearVel(body, given.linear_velocity[0], given.linear_velocity[1], given.linear_velocity[2]);
      dBodySetAngularVel(body, given.angular_velocity[0], given.angular_velocity[1], given.angular_velocity[2]);
      dGeomSetBody(geom, body);
    }
    if (given.solid == Solid::half_space) return;
    dGeomSetPosition(geom, given.position[0], given.position[1], given.position[2]);
    dQuaternion rotation = {given.rotation[3], given.rotation[0], given.rotation[1], given.rotation[2]};
    if (along_z_.back()) rotation_vector(rotation, 1);
    dGeomSetQuaternion(geom, rotation);
  }

  uint32_t steps_;  ///< a tick
  double step_time_;
  uint64_t heap_before_ = 0;
  uint32_t points_ = 0;
  char settings_[40] = {};
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID group_;
  std::vector<dGeomID> geoms_;
  std::vector<bool> along_z_;
  std::vector<Surface> surfaces_;
  std::vector<Convex> convexes_;
};

void quiet(int, const char*, va_list) {}

WorldRun* make(const Stage& stage, const Effort& effort, const char*& problem) {
  static const bool ready =
      dInitODE2(0) != 0 && dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  if (!ready) {
    problem = "does not start";
    return nullptr;
  }
  dSetMessageHandler(quiet);  // "LCP internal error" and its like: their effect is measured
  dRandSetSeed(0);            // it solves contacts in an order of chance: the same in every repetition
  return new OdeRun(stage, effort.iterations != 0 ? effort.iterations : k_iterations,
                    effort.substeps != 0 ? effort.substeps : 1);
}

}  // namespace

extern "C" void detent_bench_world_peer(AddWorldEngine add, void* list) {
  add({"ode", k_config, make, heap_use}, list);
}
