#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/bench/zoo/ode.h"

/// ODE as Debian builds it, as in tests/bench/world/peer_ode.cpp: dWorldQuickStep with 20 iterations, sweep and prune,
/// the surface layer that the manual proposes, bodies that rest disabled, all else as it comes.
namespace detent_zoo {

namespace {

constexpr int k_iterations = 20;
constexpr int k_contacts_max = 4;          ///< of two solids
constexpr int k_mesh_contacts_max = 16;    ///< of a solid and a mesh: it does not choose among those of many triangles
constexpr double k_surface_layer = 0.001;  ///< m

void quiet(int, const char*, va_list) {}

/// What ODE asserts, of its bodies' rotations above all: it would end the program where a scene flies apart.
struct Fault {};
[[noreturn]] void fault(int, const char* text, va_list arguments) {
  fputs("\nODE: ", stderr);
  vfprintf(stderr, text, arguments);
  throw Fault();
}

void start_ode() {
  static const bool ready =
      dInitODE2(0) != 0 && dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  if (!ready) abort();  // it has no memory
  dSetDebugHandler(fault);
  dSetErrorHandler(fault);
  dSetMessageHandler(quiet);  // "LCP internal error" and its like: their effect is measured
  dRandSetSeed(0);            // it takes joints in an order of chance: the same in every run
}

class OdePeer : public Peer {
 public:
  explicit OdePeer(double tick) : tick_(tick) {
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    group_ = dJointGroupCreate(0);
    dWorldSetQuickStepNumIterations(world_, k_iterations);
    dWorldSetContactSurfaceLayer(world_, k_surface_layer);
    dWorldSetAutoDisableFlag(world_, 1);
  }
  ~OdePeer() override {
    if (faulty_) return;  // its spaces are locked: it is left as it lies
    dJointGroupDestroy(group_);
    for (auto& [id, body] : bodies_) remove_ode_geoms(*body);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void set_gravity(const Vector& gravity) override {
    gravity_ = gravity;
    dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  }

  std::string add_body(Id id, const BodyFrame& given, const Properties& properties) override {
    auto made = std::make_unique<OdeBody>();
    made->id = id;
    made->kind = given.kind;
    made->properties = properties;
    made->mass = given.mass;
    made->gravity_scale = given.gravity_scale;
    made->position = given.position;
    made->rotation = given.rotation;
    if (given.kind != Kind::fixed) {
      made->body = dBodyCreate(world_);
      if (given.kind == Kind::kinematic) {
        dBodySetKinematic(made->body);
      } else {
        const Vector& inertia = given.inertia;
        if (inertia.x <= 0 || inertia.y <= 0 || inertia.z <= 0) {
          dBodyDestroy(made->body);
          return "rotation locks";
        }
        dMass mass;
        dMassSetParameters(&mass, given.mass, 0, 0, 0, inertia.x, inertia.y, inertia.z, 0, 0, 0);
        dBodySetMass(made->body, &mass);
        dBodySetLinearDamping(made->body, 1 - exp(-properties.linear_damping * tick_));
        dBodySetAngularDamping(made->body, 1 - exp(-properties.angular_damping * tick_));
        if (given.gravity_scale != 1) dBodySetGravityMode(made->body, 0);
      }
    }
    OdeBody& body = *made;
    bodies_[id] = std::move(made);
    if (std::string problem = make_ode_geoms(space_, body); !problem.empty()) return problem;
    if (body.body != nullptr) set_state(id, given);
    return "";
  }

  void remove_body(Id id) override {
    const auto found = bodies_.find(id);
    if (found == bodies_.end()) return;
    remove_ode_geoms(*found->second);
    if (found->second->body != nullptr) dBodyDestroy(found->second->body);
    bodies_.erase(found);
  }

  std::string add_joint(Id id, const JointFrame& joint, const Ties& ties, Id a, Id b, const JointState&) override {
    OdeJoint made;
    if (std::string problem = make_ode_joint(world_, joint, ties, *bodies_[a], *bodies_[b], made); !problem.empty())
      return problem;
    for (const Id each : {a, b}) wake(*bodies_[each]);
    joints_[id] = std::move(made);
    if (!ties.collide) {
      apart_[id] = std::minmax(a, b);
      find_pairs_apart();
    }
    return "";
  }

  void remove_joint(Id id) override {
    const auto found = joints_.find(id);
    if (found == joints_.end()) return;
    if (const dJointID joint = found->second.joint; joint != nullptr) {
      for (int i = 0; i < 2; ++i) {
        if (dJointGetBody(joint, i) != nullptr) dBodyEnable(dJointGetBody(joint, i));
      }
      dJointDestroy(joint);
    }
    joints_.erase(found);
    apart_.erase(id);
    find_pairs_apart();
  }

  void set_springs(Id id, const JointFrame& joint, const JointState& state) override {
    set_ode_spring(joint, state, tick_, joints_[id]);
  }

  void set_state(Id id, const BodyFrame& state) override {
    const dBodyID body = bodies_[id]->body;
    const dQuaternion rotation = {state.rotation.w, state.rotation.x, state.rotation.y, state.rotation.z};
    dBodySetPosition(body, state.position.x, state.position.y, state.position.z);
    dBodySetQuaternion(body, rotation);
    dBodySetLinearVel(body, state.linear_velocity.x, state.linear_velocity.y, state.linear_velocity.z);
    dBodySetAngularVel(body, state.angular_velocity.x, state.angular_velocity.y, state.angular_velocity.z);
    dBodyEnable(body);
  }

  void wake_all() override {
    for (auto& [id, body] : bodies_) wake(*body);
  }

  void step() override {
    if (faulty_) return;
    try {
      push();
    } catch (const Fault&) {
      faulty_ = true;
    }
  }

  void read(Id id, BodyFrame& state) const override {
    const dBodyID body = bodies_.at(id)->body;
    state.position = vector_from_ode(dBodyGetPosition(body));
    state.rotation = from_ode(dBodyGetQuaternion(body));
    state.linear_velocity = vector_from_ode(dBodyGetLinearVel(body));
    state.angular_velocity = vector_from_ode(dBodyGetAngularVel(body));
    if (faulty_) state.linear_velocity = {NAN, NAN, NAN};
  }

  std::vector<Touch> contacts() const override { return touches_; }

  uint32_t awake() const override {
    uint32_t count = 0;
    for (const auto& [id, body] : bodies_) count += body->kind == Kind::dynamic && dBodyIsEnabled(body->body) ? 1u : 0u;
    return count;
  }

  std::vector<Id> broken() override {
    std::vector<Id> ids;
    for (const auto& [id, joint] : joints_) {
      if (joint.feedback != nullptr && length(vector_from_ode(joint.feedback->f1)) > joint.break_force)
        ids.push_back(id);
    }
    for (const Id id : ids) remove_joint(id);
    return ids;
  }

 private:
  void push() {
    for (auto& [id, body] : bodies_) {
      if (body->kind != Kind::dynamic || body->gravity_scale == 1 || dBodyIsEnabled(body->body) == 0) continue;
      const Vector force = body->mass * body->gravity_scale * gravity_;
      dBodyAddForce(body->body, force.x, force.y, force.z);
    }
    touches_.clear();
    dSpaceCollide(space_, this, near_each_other);
    dWorldQuickStep(world_, tick_);
    dJointGroupEmpty(group_);
  }

  void find_pairs_apart() {
    pairs_apart_.clear();
    for (const auto& [id, pair] : apart_) pairs_apart_.insert(pair);
  }

  static void wake(const OdeBody& body) {
    if (body.body != nullptr) dBodyEnable(body.body);
  }

  static void near_each_other(void* peer, dGeomID a, dGeomID b) { static_cast<OdePeer*>(peer)->collide(a, b); }

  void collide(dGeomID a, dGeomID b) {
    const OdeBody &one = *static_cast<const OdeBody*>(dGeomGetData(a)),
                  &other = *static_cast<const OdeBody*>(dGeomGetData(b));
    if (&one == &other || (one.kind != Kind::dynamic && other.kind != Kind::dynamic)) return;
    const bool awake_one = one.body != nullptr && dBodyIsEnabled(one.body) != 0;
    const bool awake_other = other.body != nullptr && dBodyIsEnabled(other.body) != 0;
    if (!awake_one && !awake_other) return;
    if (!pair_touches(one.properties, other.properties)) return;
    if (!pairs_apart_.empty() && pairs_apart_.count(std::minmax(one.id, other.id)) != 0) return;
    const bool mesh = dGeomGetClass(a) == dTriMeshClass || dGeomGetClass(b) == dTriMeshClass;
    dContact contacts[k_mesh_contacts_max];
    const int count = dCollide(a, b, mesh ? k_mesh_contacts_max : k_contacts_max, &contacts[0].geom, sizeof(dContact));
    if (count == 0) return;
    const double friction = pair_friction(one.properties, other.properties);
    const double restitution = pair_restitution(one.properties, other.properties);
    const double arm = pair_rolling_arm(one.properties, other.properties);
    double depth = -1e300;
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[i];
      // Of hulls that just touch it gives some without a direction, which would make an end of the world.
      if (!(fabs(length(vector_from_ode(contact.geom.normal)) - 1) < 0.01)) continue;
      contact.surface = {};
      contact.surface.mode = dContactApprox1 | (restitution > 0 ? dContactBounce : 0) | (arm > 0 ? dContactRolling : 0);
      contact.surface.mu = friction;
      contact.surface.bounce = restitution;
      contact.surface.rho = contact.surface.rho2 = contact.surface.rhoN = arm;
      dJointAttach(dJointCreateContact(world_, group_, &contact), one.body, other.body);
      depth = fmax(depth, contact.geom.depth);
    }
    if (depth > -1e300) touches_.push_back({one.id, other.id, depth});
  }

  double tick_;
  Vector gravity_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID group_;
  std::map<Id, std::unique_ptr<OdeBody>> bodies_;
  std::map<Id, OdeJoint> joints_;
  std::map<Id, std::pair<Id, Id>> apart_;  ///< bodies that a joint keeps from colliding, by the joint
  std::set<std::pair<Id, Id>> pairs_apart_;
  std::vector<Touch> touches_;
  bool faulty_ = false;  ///< it does not step any more
};

std::unique_ptr<Peer> make(double tick) {
  start_ode();
  return std::make_unique<OdePeer>(tick);
}

}  // namespace

std::unique_ptr<Play> open_ode(const std::string& path, detent_test::Ground ground, std::string& problem);
std::unique_ptr<Play> open_ode(const std::string& path, detent_test::Ground ground, std::string& problem) {
  return open_peer_play(path, ground, make, problem);
}

}  // namespace detent_zoo
