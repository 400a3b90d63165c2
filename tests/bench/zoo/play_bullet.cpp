#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <map>

#include "tests/bench/zoo/bullet.h"

/// Bullet in double: its dynamic world, its tree and its sequential impulse solver with 10 iterations, all else as it
/// comes. No continuous collision detection, which a body has only if asked for.
namespace detent_zoo {

namespace {

struct BulletBody {
  Id id = 0;
  Kind kind = Kind::fixed;
  Properties properties;
  BulletShape shape;
  double gravity_scale = 1;
  std::unique_ptr<btRigidBody> body;
  Vector linear_velocity, angular_velocity;  ///< that a kinematic one is given

  bool moves() const { return length(linear_velocity) > 0 || length(angular_velocity) > 0; }
};

const BulletBody& owner_of(const btCollisionObject* object) {
  return *static_cast<const BulletBody*>(object->getUserPointer());
}
const Properties& properties_of(const btCollisionObject* object) { return owner_of(object).properties; }

btScalar friction_of(const btCollisionObject* a, const btCollisionObject* b) {
  return bullet(pair_friction(properties_of(a), properties_of(b)));
}
btScalar restitution_of(const btCollisionObject* a, const btCollisionObject* b) {
  return bullet(pair_restitution(properties_of(a), properties_of(b)));
}
btScalar rolling_arm_of(const btCollisionObject* a, const btCollisionObject* b) {
  return bullet(pair_rolling_arm(properties_of(a), properties_of(b)));
}

struct Filter : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    const BulletBody& one = owner_of(static_cast<const btCollisionObject*>(a->m_clientObject));
    const BulletBody& other = owner_of(static_cast<const btCollisionObject*>(b->m_clientObject));
    return (one.kind == Kind::dynamic || other.kind == Kind::dynamic) && pair_touches(one.properties, other.properties);
  }
};

class BulletPeer : public Peer {
 public:
  explicit BulletPeer(double tick)
      : tick_(tick), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    gCalculateCombinedFrictionCallback = friction_of;
    gCalculateCombinedRestitutionCallback = restitution_of;
    gCalculateCombinedRollingFrictionCallback = rolling_arm_of;
    gCalculateCombinedSpinningFrictionCallback = rolling_arm_of;
    world_.getPairCache()->setOverlapFilterCallback(&filter_);
  }
  ~BulletPeer() override {
    for (auto& [id, joint] : joints_) {
      if (joint.constraint != nullptr) world_.removeConstraint(joint.constraint.get());
    }
    for (auto& [id, body] : bodies_) world_.removeRigidBody(body->body.get());
  }

  void set_gravity(const Vector& gravity) override {
    gravity_ = gravity;
    world_.setGravity(bullet(gravity));
    for (auto& [id, body] : bodies_) take_gravity(*body);
  }

  std::string add_body(Id id, const BodyFrame& given, const Properties& properties) override {
    auto made = std::make_unique<BulletBody>();
    made->id = id;
    made->kind = given.kind;
    made->properties = properties;
    made->gravity_scale = given.gravity_scale;
    if (std::string problem = make_bullet_shape(properties.parts, made->shape); !problem.empty()) return problem;
    const double mass = given.kind == Kind::dynamic ? given.mass : 0;
    // About a locked axis the inertia is 0, which is how Bullet has such an axis too.
    btRigidBody::btRigidBodyConstructionInfo info(bullet(mass), nullptr, made->shape.whole, bullet(given.inertia));
    info.m_startWorldTransform = bullet(given.rotation, given.position);
    info.m_linearDamping = bullet(1 - exp(-properties.linear_damping));
    info.m_angularDamping = bullet(1 - exp(-properties.angular_damping));
    made->body = std::make_unique<btRigidBody>(info);
    btRigidBody& body = *made->body;
    body.setUserPointer(made.get());
    if (given.kind == Kind::kinematic)
      body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    bodies_[id] = std::move(made);
    world_.addRigidBody(&body);
    take_gravity(*bodies_[id]);
    set_state(id, given);
    return "";
  }

  void remove_body(Id id) override {
    const auto found = bodies_.find(id);
    if (found == bodies_.end()) return;
    world_.removeRigidBody(found->second->body.get());
    bodies_.erase(found);
  }

  std::string add_joint(Id id, const JointFrame& joint, const Ties& ties, Id a, Id b, const JointState&) override {
    btRigidBody &body_a = *bodies_[a]->body, &body_b = *bodies_[b]->body;
    BulletJoint made;
    made.frame = joint;
    const std::string problem = make_bullet_joint(joint, ties, body_a, body_b, tick_, made.constraint);
    if (!problem.empty()) return problem;
    if (made.constraint != nullptr) {
      world_.addConstraint(made.constraint.get(), !ties.collide);
    } else {
      body_a.setIgnoreCollisionCheck(&body_b, true);
      body_b.setIgnoreCollisionCheck(&body_a, true);
    }
    if (bodies_[a]->kind == Kind::dynamic) body_a.activate(true);
    if (bodies_[b]->kind == Kind::dynamic) body_b.activate(true);
    joints_[id] = std::move(made);
    return "";
  }

  void remove_joint(Id id) override {
    const auto found = joints_.find(id);
    if (found == joints_.end()) return;
    if (btTypedConstraint* const constraint = found->second.constraint.get(); constraint != nullptr) {
      constraint->getRigidBodyA().activate();
      constraint->getRigidBodyB().activate();
      world_.removeConstraint(constraint);
    }
    joints_.erase(found);
  }

  void set_springs(Id id, const JointFrame& joint, const JointState& state) override {
    set_bullet_springs(joint, state, *joints_[id].constraint);
  }

  void set_state(Id id, const BodyFrame& state) override {
    BulletBody& owner = *bodies_[id];
    btRigidBody& body = *owner.body;
    const btTransform pose = bullet(state.rotation, state.position);
    if (!(pose == body.getWorldTransform())) {
      body.setCenterOfMassTransform(pose);
      body.setInterpolationWorldTransform(pose);
      world_.getPairCache()->cleanProxyFromPairs(body.getBroadphaseHandle(), &dispatcher_);
    }
    owner.linear_velocity = state.linear_velocity;
    owner.angular_velocity = state.angular_velocity;
    if (owner.kind == Kind::kinematic) {
      // One that moves keeps awake what it touches; one that stands lets it sleep.
      body.forceActivationState(owner.moves() ? DISABLE_DEACTIVATION : ISLAND_SLEEPING);
    } else if (owner.kind == Kind::dynamic) {
      body.setLinearVelocity(bullet(state.linear_velocity));
      body.setAngularVelocity(bullet(state.angular_velocity));
      body.activate(true);
    }
  }

  void wake_all() override {
    for (auto& [id, body] : bodies_) {
      if (body->kind == Kind::dynamic) body->body->activate(true);
    }
  }

  void step() override {
    for (auto& [id, body] : bodies_) {
      if (body->kind == Kind::kinematic && body->moves()) move(*body);
    }
    world_.stepSimulation(bullet(tick_), 0);
  }

  void read(Id id, BodyFrame& state) const override {
    const BulletBody& owner = *bodies_.at(id);
    const btRigidBody& body = *owner.body;
    state.position = from_bullet(body.getWorldTransform().getOrigin());
    state.rotation = from_bullet(body.getWorldTransform().getRotation());
    state.linear_velocity =
        owner.kind == Kind::kinematic ? owner.linear_velocity : from_bullet(body.getLinearVelocity());
    state.angular_velocity =
        owner.kind == Kind::kinematic ? owner.angular_velocity : from_bullet(body.getAngularVelocity());
  }

  std::vector<Touch> contacts() const override {
    std::vector<Touch> touches;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getInternalManifoldPointer()[i];
      if (manifold.getNumContacts() == 0) continue;
      double depth = -1e300;
      for (int j = 0; j < manifold.getNumContacts(); ++j)
        depth = fmax(depth, -static_cast<double>(manifold.getContactPoint(j).getDistance()));
      touches.push_back({owner_of(manifold.getBody0()).id, owner_of(manifold.getBody1()).id, depth});
    }
    return touches;
  }

  uint32_t awake() const override {
    uint32_t count = 0;
    for (const auto& [id, body] : bodies_) count += body->kind == Kind::dynamic && body->body->isActive() ? 1u : 0u;
    return count;
  }

  std::vector<Id> broken() override {
    std::vector<Id> ids;
    for (const auto& [id, joint] : joints_) {
      if (joint.constraint != nullptr && !joint.constraint->isEnabled()) ids.push_back(id);
    }
    for (const Id id : ids) remove_joint(id);
    return ids;
  }

 private:
  void take_gravity(BulletBody& body) {
    if (body.kind == Kind::dynamic) body.body->setGravity(bullet(body.gravity_scale * gravity_));
  }
  /// To where it is at the end of the tick: Bullet finds its velocity from that.
  void move(BulletBody& body) {
    btTransform pose;
    btTransformUtil::integrateTransform(body.body->getWorldTransform(), bullet(body.linear_velocity),
                                        bullet(body.angular_velocity), bullet(tick_), pose);
    body.body->setWorldTransform(pose);
  }

  double tick_;
  Vector gravity_;
  Filter filter_;
  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::map<Id, std::unique_ptr<BulletBody>> bodies_;
  std::map<Id, BulletJoint> joints_;
};

std::unique_ptr<Peer> make(double tick) { return std::make_unique<BulletPeer>(tick); }

}  // namespace

std::unique_ptr<Play> open_bullet(const std::string& path, detent_test::Ground ground, std::string& problem);
std::unique_ptr<Play> open_bullet(const std::string& path, detent_test::Ground ground, std::string& problem) {
  return open_peer_play(path, ground, make, problem);
}

}  // namespace detent_zoo
