#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>

#include "tests/bench/zoo/bullet.h"

namespace detent_zoo {

namespace {

/// Bullet's own for boxes and cylinders: it lies within them. That of a hull lies around it, so the hull is made
/// smaller by it.
double margin_within(const Vector& half_extents) {
  const double least = std::min({half_extents.x, half_extents.y, half_extents.z});
  return std::min(static_cast<double>(CONVEX_DISTANCE_MARGIN), 0.1 * least);
}

std::unique_ptr<btCollisionShape> hull_of(const Part& part) {
  std::vector<btVector3> points;
  for (const Vector& point : part.points) points.push_back(bullet(point));
  const int stride = static_cast<int>(sizeof points[0]), count = static_cast<int>(points.size());
  btScalar margin = bullet(margin_within(part.half_extents));
  btConvexHullComputer computer;
  if (computer.compute(&points[0].x(), stride, count, margin, 0) < 0) {
    margin = 0;
    computer.compute(&points[0].x(), stride, count, 0, 0);
  }
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < computer.vertices.size(); ++i) hull->addPoint(computer.vertices[i], false);
  hull->recalcLocalAabb();
  hull->setMargin(margin);
  return hull;
}

std::unique_ptr<btCollisionShape> mesh_of(const Part& part, BulletShape& shape) {
  auto mesh = std::make_unique<btTriangleMesh>();
  for (const std::vector<uint32_t>& face : part.faces)
    mesh->addTriangle(bullet(part.points[face[0]]), bullet(part.points[face[1]]), bullet(part.points[face[2]]));
  auto surface = std::make_unique<btBvhTriangleMeshShape>(mesh.get(), true);
  surface->setMargin(0);  // else bodies lie 4 cm above it
  shape.meshes.push_back(std::move(mesh));
  return surface;
}

/// A cone's margin lies around it as well. `shift`: of its middle, along y, from the part's centre of mass.
std::unique_ptr<btCollisionShape> cone_of(const Part& part, double& shift) {
  const double margin = margin_within({part.radius, part.half_length, part.radius});
  const double slant = sqrt(part.radius * part.radius + 4 * part.half_length * part.half_length);
  const double base = -0.5 * part.half_length + margin, apex = 1.5 * part.half_length - margin * slant / part.radius;
  const double height = apex - base;
  shift = 0.5 * (base + apex);
  auto cone = std::make_unique<btConeShape>(bullet(part.radius * height / (2 * part.half_length)), bullet(height));
  cone->setMargin(bullet(margin));
  return cone;
}

}  // namespace

std::string make_bullet_shape(const std::vector<Part>& parts, BulletShape& shape) {
  std::vector<btTransform> places;
  bool centred = true;
  for (const Part& part : parts) {
    if (part.rounding > 0) return "rounded shape";
    double shift = 0;
    switch (part.solid) {
      case Solid::sphere:
        shape.parts.push_back(std::make_unique<btSphereShape>(bullet(part.radius)));
        break;
      case Solid::capsule:
        shape.parts.push_back(std::make_unique<btCapsuleShape>(bullet(part.radius), bullet(2 * part.half_length)));
        break;
      case Solid::box:
        shape.parts.push_back(std::make_unique<btBoxShape>(bullet(part.half_extents)));
        break;
      case Solid::cylinder:
        shape.parts.push_back(
            std::make_unique<btCylinderShape>(bullet(Vector{part.radius, part.half_length, part.radius})));
        break;
      case Solid::cone:
        shape.parts.push_back(cone_of(part, shift));
        break;
      case Solid::hull:
        shape.parts.push_back(hull_of(part));
        break;
      case Solid::half_space:
        shape.parts.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), bullet(0.0)));
        break;
      case Solid::mesh:
        shape.parts.push_back(mesh_of(part, shape));
        break;
    }
    places.push_back(bullet(part.rotation, part.position + rotate(part.rotation, {0, shift, 0})));
    centred = centred && shift == 0 && length(part.position) == 0 && fabs(part.rotation.w) == 1;
  }
  if (parts.size() == 1 && centred) {
    shape.whole = shape.parts.front().get();
    return "";
  }
  auto compound = std::make_unique<btCompoundShape>();
  for (size_t i = 0; i < parts.size(); ++i) compound->addChildShape(places[i], shape.parts[i].get());
  shape.whole = compound.get();
  shape.parts.push_back(std::move(compound));
  return "";
}

}  // namespace detent_zoo
