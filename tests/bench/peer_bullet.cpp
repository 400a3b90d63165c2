#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "tests/bench/engine.h"
#include "tests/bench/pose.h"

/// Bullet, compiled once in float and once in double. Its settings are its own but for the margin of polyhedra, which
/// is 0: it would round their corners off.
namespace {

using namespace detent_bench;
using detent_queries::Kind;
using detent_queries::Solid;

#if defined(BT_USE_DOUBLE_PRECISION)
constexpr const char* k_config = "bullet-double";
#else
constexpr const char* k_config = "bullet-float";
#endif

btVector3 vector_of(const Triple& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

btTransform transform_of(const PoseAt& pose) {
  const Rotation& q = pose.rotation;
  return btTransform(btQuaternion(static_cast<btScalar>(q[0]), static_cast<btScalar>(q[1]), static_cast<btScalar>(q[2]),
                                  static_cast<btScalar>(q[3])),
                     vector_of(pose.position));
}

/// Bullet's cone has its middle at the origin; this one its centre of mass.
class Cone : public btConeShape {
 public:
  Cone(btScalar radius, btScalar half_length) : btConeShape(radius, 2 * half_length), shift_(half_length / 2) {}
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    return btConeShape::localGetSupportingVertexWithoutMargin(direction) + btVector3(0, shift_, 0);
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const override {
    return btConeShape::localGetSupportingVertex(direction) + btVector3(0, shift_, 0);
  }

 private:
  btScalar shift_;
};

std::unique_ptr<btConvexInternalShape> shape_of(const Solid& solid) {
  const btScalar radius = static_cast<btScalar>(solid.radius), half_length = static_cast<btScalar>(solid.half_length);
  const btScalar rounding = static_cast<btScalar>(solid.rounding);
  const btVector3 around(rounding, rounding, rounding);
  std::unique_ptr<btConvexInternalShape> shape;
  switch (solid.kind) {
    case Kind::sphere:
      return std::make_unique<btSphereShape>(radius);
    case Kind::capsule:
      return std::make_unique<btCapsuleShape>(radius, 2 * half_length);
    case Kind::box:
      shape = std::make_unique<btBoxShape>(vector_of(solid.half_extents) + around);
      break;
    case Kind::cylinder:
      shape = std::make_unique<btCylinderShape>(btVector3(radius, half_length, radius) + around);
      break;
    case Kind::cone:
      shape = std::make_unique<Cone>(radius, half_length);
      break;
    case Kind::hull: {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Triple& point : solid.points) hull->addPoint(vector_of(point), false);
      hull->recalcLocalAabb();
      shape = std::move(hull);
      break;
    }
    case Kind::triangle:
      shape = std::make_unique<btTriangleShape>(vector_of(solid.points[0]), vector_of(solid.points[1]),
                                                vector_of(solid.points[2]));
      break;
    default:
      return nullptr;
  }
  shape->setMargin(rounding);
  return shape;
}

struct Pair {
  std::unique_ptr<btConvexInternalShape> a, b;
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;

  bool make(const Query& query) {
    a = shape_of(query.a);
    b = shape_of(query.b);
    return a != nullptr && b != nullptr;
  }
};

/// Counts the iterations, of which Bullet tells one who draws them.
struct CountedResult : btConvexCast::CastResult {
  uint32_t count = 0;
  void DebugDraw(btScalar) override { ++count; }
};

class ContinuousCollision : public Prepared {
 public:
  bool make(const Query& query, uint32_t parts) {
    for (uint32_t i = 0; i <= parts; ++i) {
      const double time = static_cast<double>(i) / parts;
      poses_a_.push_back(transform_of(pose_at(query.path_a, time)));
      poses_b_.push_back(transform_of(pose_at(query.path_b, time)));
    }
    return pair_.make(query);
  }

  void run(Answer& answer) override {
    answer = {};
    const size_t parts = poses_a_.size() - 1;
    btContinuousConvexCollision cast(pair_.a.get(), pair_.b.get(), &pair_.simplex, &pair_.penetration);
    for (size_t i = 0; i < parts; ++i) {
      CountedResult result;
      const bool hit = cast.calcTimeOfImpact(poses_a_[i], poses_a_[i + 1], poses_b_[i], poses_b_[i + 1], result);
      answer.gjk_calls += 1 + result.count;
      if (!hit) continue;
      answer.outcome = Outcome::hit;
      answer.time = (static_cast<double>(i) + static_cast<double>(result.m_fraction)) / static_cast<double>(parts);
      return;
    }
  }

 private:
  Pair pair_;
  std::vector<btTransform> poses_a_, poses_b_;
};

/// A turn of 3 rad or more is not to be had between two poses, and from pi/4 on Bullet clamps it: in parts, then.
constexpr double k_rotation_max = 3, k_part_max = 0.785;

std::unique_ptr<Prepared> prepare_parts(const Query& query, bool in_parts) {
  const double rotation_vector = turn_of(query);
  auto prepared = std::make_unique<ContinuousCollision>();
  const double parts = in_parts || rotation_vector > k_rotation_max ? fmax(1, ceil(rotation_vector / k_part_max)) : 1;
  if (!prepared->make(query, static_cast<uint32_t>(parts))) return nullptr;
  return prepared;
}
std::unique_ptr<Prepared> prepare_continuous(const Query& query) { return prepare_parts(query, false); }
std::unique_ptr<Prepared> prepare_substeps(const Query& query) { return prepare_parts(query, true); }

template <class Cast>
class LinearCast : public Prepared {
 public:
  bool make(const Query& query) {
    from_a_ = transform_of(pose_at(query.path_a, 0));
    from_b_ = transform_of(pose_at(query.path_b, 0));
    to_a_ = transform_of(pose_at(query.path_a, 1));
    to_b_ = transform_of(pose_at(query.path_b, 1));
    return turn_of(query) == 0 && pair_.make(query);
  }
  void run(Answer& answer) override {
    answer = {};
    CountedResult result;
    Cast cast(pair_.a.get(), pair_.b.get(), &pair_.simplex);
    if (cast.calcTimeOfImpact(from_a_, to_a_, from_b_, to_b_, result)) {
      answer.outcome = Outcome::hit;
      answer.time = static_cast<double>(result.m_fraction);
    }
    answer.gjk_calls = result.count;
  }

 private:
  Pair pair_;
  btTransform from_a_, from_b_, to_a_, to_b_;
};

class PairDistance : public Prepared {
 public:
  bool make(const Query& query) {
    input_.m_transformA = transform_of(pose_at(query.path_a, 0));
    input_.m_transformB = transform_of(pose_at(query.path_b, 0));
    return pair_.make(query);
  }
  void run(Answer& answer) override {
    answer = {};
    btPointCollector points;
    btGjkPairDetector detector(pair_.a.get(), pair_.b.get(), &pair_.simplex, &pair_.penetration);
    detector.getClosestPoints(input_, points, nullptr);
    const double distance = points.m_hasResult ? static_cast<double>(points.m_distance) : 0;
    answer.outcome = distance > 0 ? Outcome::clear : Outcome::hit;
    answer.distance = fmax(distance, 0);
    answer.gjk_calls = static_cast<uint32_t>(detector.m_curIter);
  }

 private:
  Pair pair_;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input_;
};

template <class Made>
std::unique_ptr<Prepared> prepare(const Query& query) {
  auto prepared = std::make_unique<Made>();
  if (!prepared->make(query)) return nullptr;
  return prepared;
}

}  // namespace

extern "C" void detent_bench_peer(AddEngine add, void* list) {
  add({Task::toi, "btContinuousConvexCollision", k_config, 0, 0, prepare_continuous}, list);
  add({Task::toi, "btContinuousConvexCollision in parts", k_config, 0, 0, prepare_substeps}, list);
  add({Task::toi, "btSubsimplexConvexCast", k_config, 0, 0, prepare<LinearCast<btSubsimplexConvexCast>>}, list);
  add({Task::toi, "btGjkConvexCast", k_config, 0, 0, prepare<LinearCast<btGjkConvexCast>>}, list);
  add({Task::distance, "btGjkPairDetector", k_config, 0, 0, prepare<PairDistance>}, list);
}
