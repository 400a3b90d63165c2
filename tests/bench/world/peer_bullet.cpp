#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <btBulletDynamicsCommon.h>
#include <math.h>
#include <stdio.h>

#include <memory>

#include "tests/bench/world/engine.h"

/// Bullet, compiled once in float and once in double: its dynamic world, its tree and its sequential impulse solver
/// with 10 iterations, all else as it comes.
namespace {

using namespace detent_bench;

#if defined(BT_USE_DOUBLE_PRECISION)
constexpr const char* k_config = "double";
#else
constexpr const char* k_config = "float";
#endif
constexpr uint32_t k_iterations = 10;

btScalar scalar(double value) { return static_cast<btScalar>(value); }
btVector3 vector_of(const double (&v)[3]) { return {scalar(v[0]), scalar(v[1]), scalar(v[2])}; }

std::unique_ptr<btCollisionShape> shape_of(const StageBody& body) {
  switch (body.solid) {
    case Solid::box:
      return std::make_unique<btBoxShape>(vector_of(body.size));
    case Solid::sphere:
      return std::make_unique<btSphereShape>(scalar(body.size[0]));
    case Solid::capsule:
      return std::make_unique<btCapsuleShape>(scalar(body.size[0]), scalar(2 * body.size[1]));
    case Solid::icosahedron: {
      // A hull's margin is around it: it is made smaller, so that the faces with their margin are where they should be.
      auto hull = std::make_unique<btConvexHullShape>();
      constexpr double k_inner = 0.79465447229176612296;  // radius of the inscribed ball over that of the vertices
      const double radius = body.size[0] - static_cast<double>(hull->getMargin()) / k_inner;
      for (const auto& point : detent_stress::icosahedron_points(radius))
        hull->addPoint({scalar(point[0]), scalar(point[1]), scalar(point[2])}, false);
      hull->recalcLocalAabb();
      return hull;
    }
    case Solid::half_space:
      return std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), scalar(0));
  }
  return nullptr;
}

/// As stages have it; Bullet's own is the product.
btScalar larger_restitution(const btCollisionObject* a, const btCollisionObject* b) {
  return btMax(a->getRestitution(), b->getRestitution());
}

class BulletRun : public WorldRun {
 public:
  BulletRun(const Stage& stage, uint32_t iterations, uint32_t steps)
      : steps_(steps), step_time_(scalar(stage.tick / steps)) {
    gCalculateCombinedRestitutionCallback = larger_restitution;
    heap_before_ = heap_use().bytes;
    configuration_ = std::make_unique<btDefaultCollisionConfiguration>();
    dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
    broadphase_ = std::make_unique<btDbvtBroadphase>();
    solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    world_ = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), broadphase_.get(), solver_.get(),
                                                       configuration_.get());
    world_->setGravity({0, scalar(-stage.gravity), 0});
    world_->getSolverInfo().m_numIterations = static_cast<int>(iterations);
    snprintf(settings_, sizeof settings_, "%u iterations, %u steps", iterations, steps);
    for (const StageBody& body : stage.bodies) add(body, stage);
    for (const StageJoint& joint : stage.joints) add(joint);
  }
  ~BulletRun() override {
    for (const auto& joint : joints_) world_->removeConstraint(joint.get());
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
  }

  void step() override {
    for (uint32_t i = 0; i < steps_; ++i) world_->stepSimulation(step_time_, 0);
  }

  uint32_t contact_points() const override {
    int count = 0;
    for (int i = 0; i < dispatcher_->getNumManifolds(); ++i)
      count += dispatcher_->getManifoldByIndexInternal(i)->getNumContacts();
    return static_cast<uint32_t>(count);
  }
  uint64_t losses() const override { return 0; }

  void read(BodyState* states) const override {
    for (const auto& body : bodies_) {
      BodyState& state = *states++;
      const btTransform& pose = body->getWorldTransform();
      const btQuaternion rotation = pose.getRotation();
      for (int i = 0; i < 4; ++i) state.rotation[i] = static_cast<double>(rotation[i]);
      for (int i = 0; i < 3; ++i) {
        state.position[i] = static_cast<double>(pose.getOrigin()[i]);
        state.linear_velocity[i] = static_cast<double>(body->getLinearVelocity()[i]);
        state.angular_velocity[i] = static_cast<double>(body->getAngularVelocity()[i]);
      }
    }
  }

  uint64_t bytes() const override { return heap_use().bytes - heap_before_; }
  const char* settings() const override { return settings_; }

 private:
  void add(const StageBody& given, const Stage& stage) {
    shapes_.push_back(shape_of(given));
    const double mass = given.role == Role::dynamic ? detent_stress::mass_of(given) : 0;
    const auto inverse_inertia = detent_stress::inverse_inertia_of(given);
    btRigidBody::btRigidBodyConstructionInfo info(
        scalar(mass), nullptr, shapes_.back().get(),
        btVector3(scalar(mass * inverse_inertia[0]), scalar(mass * inverse_inertia[1]),
                  scalar(mass * inverse_inertia[2])));
    info.m_startWorldTransform.setRotation(btQuaternion(scalar(given.rotation[0]), scalar(given.rotation[1]),
                                                        scalar(given.rotation[2]), scalar(given.rotation[3])));
    info.m_startWorldTransform.setOrigin(vector_of(given.position));
    info.m_friction = scalar(sqrt(given.friction));  // of a pair: the product
    info.m_restitution = scalar(given.restitution);
    auto body = std::make_unique<btRigidBody>(info);
    if (given.role == Role::kinematic)
      body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setLinearVelocity(vector_of(given.linear_velocity));
    body->setAngularVelocity(vector_of(given.angular_velocity));
    if (!stage.sleeping) body->setActivationState(DISABLE_DEACTIVATION);
    if (stage.collisions)
      world_->addRigidBody(body.get());
    else
      world_->addRigidBody(body.get(), 0, 0);
    bodies_.push_back(std::move(body));
  }

  void add(const StageJoint& given) {
    joints_.push_back(std::make_unique<btPoint2PointConstraint>(*bodies_[given.a], *bodies_[given.b],
                                                                vector_of(given.anchor_a), vector_of(given.anchor_b)));
    world_->addConstraint(joints_.back().get());
  }

  uint32_t steps_;  ///< a tick
  btScalar step_time_;
  uint64_t heap_before_ = 0;
  char settings_[40] = {};
  std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

WorldRun* make(const Stage& stage, const Effort& effort, const char*&) {
  return new BulletRun(stage, effort.iterations != 0 ? effort.iterations : k_iterations,
                       effort.substeps != 0 ? effort.substeps : 1);
}

}  // namespace

extern "C" void detent_bench_world_peer(AddWorldEngine add, void* list) {
  add({"bullet", k_config, make, heap_use}, list);
}
