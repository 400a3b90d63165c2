#include "tests/campaigns/manifolds/run_detent.h"

#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>
#include <string.h>

#include "contact/collide.h"
#include "contact/compound_ops.h"
#include "contact/contact_cache.h"
#include "contact/manifold_recycling.h"
#include "ports/host/cook/cook.h"
#include "ports/host/cook/cook_mesh.h"
#include "shape/shape_properties.h"
#include "tests/common/oracle/random_solids.h"

#define DETENT_MANIFOLDS_TEXT_OF(name) #name
#define DETENT_MANIFOLDS_TEXT(name) DETENT_MANIFOLDS_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_manifolds::Followed;
using detent_manifolds::Found;
using detent_manifolds::FoundPoint;
using detent_manifolds::Motion;
using detent_manifolds::Scene;
using detent_manifolds::Solid;
using detent_manifolds::Tick;
using detent_manifolds::Triple;
using detent_oracle::Dice;

/// Cooked bytes, aligned to 8.
struct Bytes {
  std::vector<uint64_t> words{};
  uint32_t count = 0;

  void set(const std::vector<uint8_t>& from) {
    count = static_cast<uint32_t>(from.size());
    words.resize((from.size() + 7) / 8);
    if (!from.empty()) memcpy(words.data(), from.data(), from.size());
  }
  Asset asset() const { return {reinterpret_cast<const uint8_t*>(words.data()), count}; }
};

double metres(const Unit& value, int exponent) { return ldexp(unit_to_host(value), exponent); }

/// Changes the number by one step up or down, or not at all.
void disturb(Unit& value, Dice& dice) {
  const int step = dice.below(3) - 1;
#if DETENT_FIXED
  value.raw += step;
#else
  if (step != 0) value = step < 0 ? nextafter(value, static_cast<Unit>(-2)) : nextafter(value, static_cast<Unit>(2));
#endif
}
void disturb(Position& position, Dice& dice) {
  for (Coord* value : {&position.x, &position.y, &position.z}) {
    const int step = dice.below(3) - 1;
#if defined(DETENT_F64)
    if (step != 0) *value = nextafter(*value, step * 1e9);
#else
    value->raw += step;
#endif
  }
}

/// An upper bound of the movement of a body's points in a tick, m.
double motion_of(const detent_manifolds::Pose& from, const detent_manifolds::Pose& to,
                 const BodyProperties& properties) {
  double displacement = 0, rotation_vector = 0;
  for (size_t k = 0; k < 3; ++k)
    displacement += (to.position[k] - from.position[k]) * (to.position[k] - from.position[k]);
  for (size_t k = 0; k < 4; ++k)
    rotation_vector += (to.rotation[k] - from.rotation[k]) * (to.rotation[k] - from.rotation[k]);
  return sqrt(displacement) + 2 * sqrt(rotation_vector) * metres(properties.bounding_radius, properties.size_exponent);
}

/// A pair as in a step: the data stored in one tick are used in the next.
class Pair {
 public:
  Status make(const Scene& scene) {
    mesh_ = scene.mesh_cells != 0;
    if (mesh_) {
      bytes_[0].set(mesh_bytes(scene));
      set(set_shape_properties(terrain(0), properties_a_, set_assets()));
    } else {
      make_shape(scene.a, 0, properties_a_);
    }
    make_shape(scene.b, 1, properties_b_);
    if (status_ != Status::ok) return status_;
    properties_a_.type = static_cast<uint32_t>(BodyType::fixed);
    properties_b_.type = static_cast<uint32_t>(BodyType::dynamic);
    const WorldDef def;
    const double extent = fmin(real_to_host(shape_extent(properties_a_)), real_to_host(shape_extent(properties_b_)));
    at_rest_ = extent * real_to_host(def.contact_margin);
    reuse_ = extent * real_to_host(def.contact_recycle_distance);
    extent_ = extent;
    return status_;
  }

  void tick(const Scene& scene, uint32_t index, Dice& dice, Tick& tick);

 private:
  void set(Status next) {
    if (status_ == Status::ok) status_ = next;
  }
  Real real(double value) {
    Real result{};
    set(real_from_host(value, result));
    return result;
  }
  AssetTable set_assets() {
    for (int i = 0; i < 2; ++i) assets_[i] = bytes_[i].asset();
    return {assets_, 2};
  }
  AssetTable assets() const { return {assets_, 2}; }
  static std::vector<uint8_t> mesh_bytes(const Scene& scene) {
    detent_cook::MeshSource source;
    double half = 0;
    for (const Triple& point : scene.a.points) half = fmax(half, point[0]);
    const uint32_t cells = scene.mesh_cells, side = cells + 1;
    for (uint32_t i = 0; i < side * side; ++i)
      source.vertices.push_back({half * (2.0 * (i % side) / cells - 1), 0, half * (2.0 * (i / side) / cells - 1)});
    for (uint32_t i = 0; i < cells * cells; ++i) {
      const uint32_t a = i / cells * side + i % cells, b = a + 1, c = a + side, d = c + 1;
      source.triangles.push_back({{a, c, i % 2 == 0 ? d : b}, 0});
      if (i % 2 == 0)
        source.triangles.push_back({{a, d, b}, 0});
      else
        source.triangles.push_back({{b, c, d}, 0});
    }
    detent_cook::MeshOptions options;
    options.one_sided = true;
    return detent_cook::cook_mesh(source, options).bytes;
  }
  void make_shape(const Solid& solid, uint32_t asset, BodyProperties& properties) {
    using detent_manifolds::SolidKind;
    Shape shape;
    switch (solid.kind) {
      case SolidKind::sphere:
        shape = sphere(real(solid.radius));
        break;
      case SolidKind::capsule:
        shape = capsule(real(solid.radius), real(solid.half_length));
        break;
      case SolidKind::cylinder:
        shape = cylinder(real(solid.radius), real(solid.half_length));
        break;
      case SolidKind::cone:
        shape = cone(real(solid.radius), real(solid.half_length));
        break;
      case SolidKind::box:
        shape = box({real(solid.half_extents[0]), real(solid.half_extents[1]), real(solid.half_extents[2])});
        break;
      default: {
        detent_cook::CookOptions options;
        options.frame = detent_cook::Frame::source;
        const std::vector<detent_cook::Point> points(solid.points.begin(), solid.points.end());
        bytes_[asset].set(detent_cook::cook_hull(points, options).bytes);
        if (bytes_[asset].count == 0) set(Status::bad_argument);
        if (status_ != Status::ok) return;
        shape = hull(asset);
      }
    }
    const AssetTable table = set_assets();
    set(set_shape_properties(shape, properties, table));
  }
  void pose(const detent_manifolds::Pose& from, BodyPose& to) {
    set(coord_from_host(from.position[0], to.position.x));
    set(coord_from_host(from.position[1], to.position.y));
    set(coord_from_host(from.position[2], to.position.z));
    Unit* const parts[] = {&to.rotation.x, &to.rotation.y, &to.rotation.z, &to.rotation.w};
    for (size_t i = 0; i < 4; ++i) set(unit_from_host(from.rotation[i], *parts[i]));
  }
  static detent_manifolds::Pose host_pose(const BodyPose& pose) {
    const Position& p = pose.position;
    const Quat& q = pose.rotation;
    return {{coord_to_host(p.x), coord_to_host(p.y), coord_to_host(p.z)},
            {unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)}};
  }
  void add(const ContactGeometry& geometry, uint32_t key, const Triple& offset, Found& found) const;
  void collide_at(const CollisionBody& a, const CollisionBody& b, double distance_max, TerrainContacts& contacts) const;
  bool reuse(const CollisionBody& a, const CollisionBody& b, double distance_max, TerrainContacts& contacts,
             ManifoldState (&manifold)[k_terrain_manifolds_max]) const;

  bool mesh_ = false;
  Status status_ = Status::ok;
  Bytes bytes_[2];
  Asset assets_[2];
  BodyProperties properties_a_{}, properties_b_{};
  double at_rest_ = 0, reuse_ = 0, extent_ = 0;
  uint32_t count_ = 0;
  ContactState before_[k_terrain_manifolds_max] = {};
  ManifoldState kept_[k_terrain_manifolds_max] = {};
};

void Pair::add(const ContactGeometry& geometry, uint32_t key, const Triple& offset, Found& found) const {
  const bool by_a = !mesh_ && properties_a_.size_exponent <= properties_b_.size_exponent;
  double deepest = found.points.empty() ? INFINITY : found.points[0].separation;
  for (const FoundPoint& point : found.points) deepest = fmin(deepest, point.separation);
  for (uint32_t i = 0; i < geometry.count; ++i) {
    const ContactGeometryPoint& point = geometry.point[i];
    const Vec3<Unit>& arm = by_a ? point.arm_a : point.arm_b;
    const int exponent = by_a ? properties_a_.size_exponent : properties_b_.size_exponent;
    FoundPoint made = {{metres(arm.x, exponent), metres(arm.y, exponent), metres(arm.z, exponent)},
                       real_to_host(point.separation),
                       uint64_t{key} << 32 | point.feature};
    for (size_t k = 0; k < 3 && !by_a; ++k) made.from_a[k] += offset[k];
    found.points.push_back(made);
    if (made.separation < deepest) {
      deepest = made.separation;
      found.normal = {unit_to_host(geometry.normal.x), unit_to_host(geometry.normal.y),
                      unit_to_host(geometry.normal.z)};
    }
  }
  found.seam = found.seam || geometry.seam;
  found.capped = found.capped || geometry.capped;
}

/// Collides the pair as a step does: lib/world/step_contacts.cpp.
void Pair::collide_at(const CollisionBody& a, const CollisionBody& b, double distance_max,
                      TerrainContacts& contacts) const {
  // A resting body penetrates by a quarter of gravity's displacement in a tick.
  Real distance{}, sunk{};
  if (real_from_host(distance_max, distance) != Status::ok || real_from_host(9.81 / 60 / 60 / 4, sunk) != Status::ok)
    return;
  const ContactMargins asked(distance, sunk);
  contacts.count = contacts.dropped = 0;
  contacts.seam = contacts.capped = false;
  if (mesh_) {
    collide_parts(a, b, asked, assets(), ManifoldReduction::projected_extremes, feature_table<Features::all>, contacts);
    return;
  }
  TerrainContact& contact = contacts.contact[0];
  contact.key = 0;
  collide(a, b, asked, contact.geometry, assets());
  contacts.seam = contact.geometry.seam;
  contacts.capped = contact.geometry.capped;
  contacts.count = contact.geometry.count != 0 ? 1 : 0;
}

bool Pair::reuse(const CollisionBody& a, const CollisionBody& b, double distance_max, TerrainContacts& contacts,
                 ManifoldState (&manifold)[k_terrain_manifolds_max]) const {
  Real tolerance{}, distance{};
  if (real_from_host(reuse_, tolerance) != Status::ok || real_from_host(distance_max, distance) != Status::ok)
    return false;
  contacts.count = contacts.dropped = 0;
  contacts.seam = contacts.capped = false;
  for (uint32_t i = 0; i < count_; ++i) {
    TerrainContact& contact = contacts.contact[contacts.count];
    contact.key = before_[i].part;
    contact.geometry.seam = false;
    if (!recycle_manifold(a, b, kept_[i], before_[i].feature, before_[i].point_count, tolerance, distance,
                          contact.geometry, manifold[contacts.count++]))
      return false;
  }
  return contacts.count != 0;
}

void Pair::tick(const Scene& scene, uint32_t index, Dice& dice, Tick& tick) {
  BodyPose pose_a{}, pose_b{};
  pose(scene.pose_a[index], pose_a);
  pose(scene.pose_b[index], pose_b);
  if (scene.motion == Motion::still) {
    disturb(pose_b.position, dice);
    for (Unit* part : {&pose_b.rotation.x, &pose_b.rotation.y, &pose_b.rotation.z, &pose_b.rotation.w})
      disturb(*part, dice);
  }
  tick.a = host_pose(pose_a);
  tick.b = host_pose(pose_b);
  const Matrix3 rotation_a = matrix_from(pose_a.rotation), rotation_b = matrix_from(pose_b.rotation);
  const CollisionBody a = {pose_a, properties_a_, rotation_a}, b = {pose_b, properties_b_, rotation_b};
  Triple offset = {};
  for (size_t k = 0; k < 3; ++k) offset[k] = tick.b.position[k] - tick.a.position[k];
  const uint32_t last = index == 0 ? 1 : index;
  const double moved = motion_of(scene.pose_a[last - 1], scene.pose_a[last], properties_a_) +
                       motion_of(scene.pose_b[last - 1], scene.pose_b[last], properties_b_);
  const double distance_max = at_rest_ + fmin(extent_ / 4, moved);
  tick.distance_max = distance_max;
  const bool slow = distance_max + reuse_ <= 2 * at_rest_;

  TerrainContacts fresh, contacts;
  collide_at(a, b, distance_max, fresh);
  ManifoldState manifold[k_terrain_manifolds_max] = {};
  tick.stepped.reused = index != 0 && slow && reuse(a, b, distance_max, contacts, manifold);
  PairBefore pair = {before_, nullptr, count_};
  uint32_t order[k_terrain_manifolds_max] = {0, 1, 2, 3, 4, 5, 6, 7};
  pair.index = order;
  if (!tick.stepped.reused) {
    contacts = fresh;
    if (mesh_) continue_keys(pair, contacts);
    bool kept = slow && !contacts.capped && contacts.dropped == 0;
    for (uint32_t i = 0; kept && i < contacts.count; ++i) {
      manifold[i] = kept_manifold(a, b, contacts.contact[i].geometry);
      kept = is_kept(manifold[i]);
    }
    for (uint32_t i = 0; !kept && i < contacts.count; ++i) manifold[i] = {};
  }
  const auto tell = [&](const TerrainContacts& from, Found& found) {
    for (uint32_t i = 0; i < from.count; ++i) add(from.contact[i].geometry, from.contact[i].key, offset, found);
    found.seam = found.seam || from.seam;
    found.capped = found.capped || from.capped;
  };
  tell(fresh, tick.anew);
  tell(contacts, tick.stepped);
  count_ = contacts.count;
  for (uint32_t i = 0; i < count_; ++i) {
    before_[i] = continued_contact(0, 1, contacts.contact[i].key, contacts.contact[i].geometry, nullptr);
    kept_[i] = manifold[i];
  }
}

Followed follow(const Scene& scene) {
  Followed result;
  Pair pair;
  if (const Status status = pair.make(scene); status != Status::ok) {
    result.problem = "the pair of seed " + std::to_string(scene.seed) + " cannot be made: " + status_text(status);
    return result;
  }
  Dice dice(~scene.seed);
  result.ticks.resize(scene.pose_a.size());
  for (uint32_t i = 0; i < scene.pose_a.size(); ++i) pair.tick(scene, i, dice, result.ticks[i]);
  return result;
}

}  // namespace

detent_manifolds::Engine manifolds_engine() { return {DETENT_MANIFOLDS_TEXT(DETENT_NAMESPACE), follow}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
