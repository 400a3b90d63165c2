#include "tests/bench/zoo/ode.h"

namespace detent_zoo {

namespace {

constexpr Rotation k_y_to_z = {-0.70710678118654752440, 0, 0, 0.70710678118654752440};  ///< ODE's axis is z

Vector middle_of(const Part& part) {
  Vector sum;
  for (const Vector& p : part.points) sum = sum + p;
  return (1.0 / static_cast<double>(part.points.size())) * sum;
}

/// About the middle of its points: ODE wants the origin within.
dGeomID convex_of(dSpaceID space, const Part& given, OdeBody& body) {
  Part part = given;
  const Vector middle = middle_of(part);
  for (Vector& p : part.points) p = p - middle;
  auto convex = std::make_unique<OdeConvex>();
  for (const Vector& p : part.points) convex->points.insert(convex->points.end(), {p.x, p.y, p.z});
  for (const std::vector<uint32_t>& face : part.faces) {
    convex->polygons.push_back(static_cast<unsigned>(face.size()));
    Vector normal;  // by Newell: a face's corners lie in one plane but for their rounding
    for (size_t i = 0; i < face.size(); ++i) {
      const Vector &p = part.points[face[i]], &q = part.points[face[(i + 1) % face.size()]];
      normal = normal + cross(p, q);
      convex->polygons.push_back(face[i]);
    }
    normal = (1 / length(normal)) * normal;
    double offset = -1e300;
    for (const uint32_t corner : face) offset = fmax(offset, dot(normal, part.points[corner]));
    convex->planes.insert(convex->planes.end(), {normal.x, normal.y, normal.z, offset});
  }
  body.convexes.push_back(std::move(convex));
  const OdeConvex& kept = *body.convexes.back();
  return dCreateConvex(space, kept.planes.data(), static_cast<unsigned>(kept.planes.size() / 4), kept.points.data(),
                       static_cast<unsigned>(kept.points.size() / 3), kept.polygons.data());
}

dGeomID mesh_of(dSpaceID space, const Part& part, OdeBody& body) {
  auto mesh = std::make_unique<OdeMesh>();
  for (const Vector& p : part.points) mesh->points.insert(mesh->points.end(), {p.x, p.y, p.z});
  for (const std::vector<uint32_t>& face : part.faces)
    mesh->indices.insert(mesh->indices.end(), face.begin(), face.end());
  mesh->data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(mesh->data, mesh->points.data(), 3 * sizeof(double), static_cast<int>(part.points.size()),
                              mesh->indices.data(), static_cast<int>(mesh->indices.size()), 3 * sizeof(dTriIndex));
  // What hulls ask of a mesh, and what keeps edges within a surface from being hit.
  dGeomTriMeshDataPreprocess2(
      mesh->data, 1u << dTRIDATAPREPROCESS_BUILD_CONCAVE_EDGES | 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
  body.meshes.push_back(std::move(mesh));
  return dCreateTriMesh(space, body.meshes.back()->data, nullptr, nullptr, nullptr);
}

/// Null, and why, if ODE has none such.
dGeomID geom_of(dSpaceID space, const Part& part, OdeBody& body, std::string& problem) {
  switch (part.solid) {
    case Solid::sphere:
      return dCreateSphere(space, part.radius);
    case Solid::capsule:
      return dCreateCapsule(space, part.radius, 2 * part.half_length);
    case Solid::box:
      return dCreateBox(space, 2 * part.half_extents.x, 2 * part.half_extents.y, 2 * part.half_extents.z);
    case Solid::cylinder:
      return dCreateCylinder(space, part.radius, 2 * part.half_length);
    case Solid::hull:
      return convex_of(space, part, body);
    case Solid::mesh:
      return mesh_of(space, part, body);
    case Solid::half_space: {
      if (body.kind != Kind::fixed) {
        problem = "half-space that moves";
        return nullptr;
      }
      const Vector normal = rotate(body.rotation, {0, 1, 0});
      return dCreatePlane(space, normal.x, normal.y, normal.z, dot(normal, body.position));
    }
    case Solid::cone:
      break;
  }
  problem = "cone";
  return nullptr;
}

}  // namespace

std::string make_ode_geoms(dSpaceID space, OdeBody& body) {
  for (const Part& part : body.properties.parts) {
    if (part.rounding > 0) return "rounded shape";
    std::string problem;
    const dGeomID geom = geom_of(space, part, body, problem);
    if (geom == nullptr) return problem;
    body.geoms.push_back(geom);
    dGeomSetData(geom, &body);
    if (part.solid == Solid::half_space) continue;
    const bool along_z = part.solid == Solid::capsule || part.solid == Solid::cylinder;
    const Vector position =
        part.solid == Solid::hull ? part.position + rotate(part.rotation, middle_of(part)) : part.position;
    const Rotation rotation_vector = along_z ? part.rotation * k_y_to_z : part.rotation;
    if (body.body != nullptr) {
      const dQuaternion q = {rotation_vector.w, rotation_vector.x, rotation_vector.y, rotation_vector.z};
      dGeomSetBody(geom, body.body);
      dGeomSetOffsetPosition(geom, position.x, position.y, position.z);
      dGeomSetOffsetQuaternion(geom, q);
    } else {
      const Vector place = body.position + rotate(body.rotation, position);
      const Rotation whole = body.rotation * rotation_vector;
      const dQuaternion q = {whole.w, whole.x, whole.y, whole.z};
      dGeomSetPosition(geom, place.x, place.y, place.z);
      dGeomSetQuaternion(geom, q);
    }
  }
  return "";
}

void remove_ode_geoms(OdeBody& body) {
  for (const dGeomID geom : body.geoms) dGeomDestroy(geom);
  body.geoms.clear();
  for (const auto& mesh : body.meshes) dGeomTriMeshDataDestroy(mesh->data);
  body.meshes.clear();
}

}  // namespace detent_zoo
