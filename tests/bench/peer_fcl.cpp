#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/engine.h"
#include "tests/bench/pose.h"

/// FCL in double, with its own settings. Its round shapes lie along z: they are turned; its cone has another origin and
/// is left out. A hull is given without faces, of which its distance needs none; so is a triangle, for
/// conservative advancement knows no TriangleP.
namespace {

using namespace detent_bench;
using detent_queries::Kind;
using detent_queries::Solid;

constexpr double k_rotation_max = 3;  ///< rad; of which two poses can tell

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry geometry_of(const Solid& solid) {
  if (solid.rounding != 0) return nullptr;
  Geometry geometry;
  switch (solid.kind) {
    case Kind::sphere:
      geometry = std::make_shared<fcl::Sphered>(solid.radius);
      break;
    case Kind::capsule:
      geometry = std::make_shared<fcl::Capsuled>(solid.radius, 2 * solid.half_length);
      break;
    case Kind::box:
      geometry =
          std::make_shared<fcl::Boxd>(2 * solid.half_extents[0], 2 * solid.half_extents[1], 2 * solid.half_extents[2]);
      break;
    case Kind::cylinder:
      geometry = std::make_shared<fcl::Cylinderd>(solid.radius, 2 * solid.half_length);
      break;
    case Kind::hull:
    case Kind::triangle: {
      auto points = std::make_shared<std::vector<fcl::Vector3d>>();
      for (const Triple& point : solid.points) points->emplace_back(point[0], point[1], point[2]);
      geometry = std::make_shared<fcl::Convexd>(points, 0, std::make_shared<std::vector<int>>());
      break;
    }
    default:
      return nullptr;
  }
  geometry->computeLocalAABB();
  return geometry;
}

fcl::Transform3d transform_of(const Solid& solid, const PoseAt& pose) {
  Rotation q = pose.rotation;
  constexpr double k_half = 0.70710678118654752440;
  if (solid.kind == Kind::capsule || solid.kind == Kind::cylinder) q = product(q, {-k_half, 0, 0, k_half});  // z to y
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = fcl::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
  transform.translation() = fcl::Vector3d(pose.position[0], pose.position[1], pose.position[2]);
  return transform;
}

/// Made by hand: continuousCollide() of two pairs of poses leaves a motion's reference point uninitialised (FCL 0.7).
fcl::InterpMotion<double> motion_of(const fcl::Transform3d& from, const fcl::Transform3d& to) {
  return {from.linear(), from.translation(), to.linear(), to.translation(), fcl::Vector3d(0, 0, 0)};
}

class Advancement : public Prepared {
 public:
  bool make(const Query& query, fcl::GJKSolverType solver) {
    a_ = geometry_of(query.a);
    b_ = geometry_of(query.b);
    if (a_ == nullptr || b_ == nullptr) return false;
    request_.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    request_.ccd_motion_type = fcl::CCDM_LINEAR;
    request_.gjk_solver_type = solver;
    const uint32_t parts = static_cast<uint32_t>(fmax(1, ceil(turn_of(query) / k_rotation_max)));
    for (uint32_t i = 0; i <= parts; ++i) {
      const double time = static_cast<double>(i) / parts;
      poses_a_.push_back(transform_of(query.a, pose_at(query.path_a, time)));
      poses_b_.push_back(transform_of(query.b, pose_at(query.path_b, time)));
    }
    return true;
  }

  void run(Answer& answer) override {
    answer = {};
    const size_t parts = poses_a_.size() - 1;
    for (size_t i = 0; i < parts; ++i) {
      const fcl::InterpMotion<double> motion_a = motion_of(poses_a_[i], poses_a_[i + 1]);
      const fcl::InterpMotion<double> motion_b = motion_of(poses_b_[i], poses_b_[i + 1]);
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide(a_.get(), &motion_a, b_.get(), &motion_b, request_, result);
      if (!result.is_collide) continue;
      answer.outcome = Outcome::hit;
      answer.time = (static_cast<double>(i) + result.time_of_contact) / static_cast<double>(parts);
      return;
    }
  }

 private:
  Geometry a_, b_;
  std::vector<fcl::Transform3d> poses_a_, poses_b_;
  fcl::ContinuousCollisionRequestd request_;
};

class PairDistance : public Prepared {
 public:
  bool make(const Query& query, fcl::GJKSolverType solver) {
    a_ = geometry_of(query.a);
    b_ = geometry_of(query.b);
    if (a_ == nullptr || b_ == nullptr) return false;
    request_.gjk_solver_type = solver;
    pose_a_ = transform_of(query.a, pose_at(query.path_a, 0));
    pose_b_ = transform_of(query.b, pose_at(query.path_b, 0));
    return true;
  }

  void run(Answer& answer) override {
    answer = {};
    fcl::DistanceResultd result;
    const double distance = fcl::distance(a_.get(), pose_a_, b_.get(), pose_b_, request_, result);
    answer.outcome = distance > 0 ? Outcome::clear : Outcome::hit;
    answer.distance = fmax(distance, 0);
  }

 private:
  Geometry a_, b_;
  fcl::Transform3d pose_a_, pose_b_;
  fcl::DistanceRequestd request_;
};

template <class Made, fcl::GJKSolverType k_solver>
std::unique_ptr<Prepared> prepare(const Query& query) {
  auto prepared = std::make_unique<Made>();
  if (!prepared->make(query, k_solver)) return nullptr;
  return prepared;
}

}  // namespace

extern "C" void detent_bench_peer(AddEngine add, void* list) {
  using fcl::GST_INDEP, fcl::GST_LIBCCD;
  add({Task::toi, "conservative advancement, libccd", "fcl", 0, 0, prepare<Advancement, GST_LIBCCD>}, list);
  add({Task::toi, "conservative advancement, indep", "fcl", 0, 0, prepare<Advancement, GST_INDEP>}, list);
  add({Task::distance, "distance, libccd", "fcl", 0, 0, prepare<PairDistance, GST_LIBCCD>}, list);
  add({Task::distance, "distance, indep", "fcl", 0, 0, prepare<PairDistance, GST_INDEP>}, list);
}
