#pragma once
#include <ode/ode.h>

#include <memory>
#include <vector>

#include "tests/bench/zoo/peer.h"

/// What ODE's files share.
namespace detent_zoo {

inline Rotation from_ode(const dReal* q) { return {q[1], q[2], q[3], q[0]}; }
inline Vector vector_from_ode(const dReal* v) { return {v[0], v[1], v[2]}; }

/// What geoms keep pointers to.
struct OdeConvex {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};
struct OdeMesh {
  std::vector<double> points;
  std::vector<dTriIndex> indices;
  dTriMeshDataID data = nullptr;
};

/// A body, as it lies; what is fixed has geoms alone.
struct OdeBody {
  Id id = 0;
  Kind kind = Kind::fixed;
  Properties properties;
  double mass = 0, gravity_scale = 1;
  Vector position;  ///< of a fixed one
  Rotation rotation;
  dBodyID body = nullptr;
  std::vector<dGeomID> geoms;
  std::vector<std::unique_ptr<OdeConvex>> convexes;
  std::vector<std::unique_ptr<OdeMesh>> meshes;
};
/// Makes the geoms in that space. Empty, or why not.
std::string make_ode_geoms(dSpaceID space, OdeBody& body);
void remove_ode_geoms(OdeBody& body);

struct OdeJoint {
  dJointID joint = nullptr;  ///< null where a joint only keeps its bodies from colliding
  double sign = 1;           ///< of ODE's angle or length, against the scene's
  double break_force = 0;
  std::unique_ptr<dJointFeedback> feedback;
};
/// Likewise.
std::string make_ode_joint(dWorldID world, const JointFrame& joint, const Ties& ties, OdeBody& a, OdeBody& b,
                           OdeJoint& made);
void set_ode_spring(const JointFrame& joint, const JointState& state, double tick, const OdeJoint& made);

}  // namespace detent_zoo
