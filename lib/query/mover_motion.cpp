#include "query/mover_motion.h"

#include <detent/contact.h>

#include "contact/compound_ops.h"
#include "query/query_terrain.h"
#include "shape/sweep.h"
#include "state/ranges.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Footing k_footings[] = {Footing::floor, Footing::edge};  // better footings come first
/// Distances to bodies are measured from a shrunken core: a capsule inside the mover with 2^k_core_power of its radius.
/// If a body overlaps the mover by up to 7/8 of the radius, its distance from the core is still positive.
constexpr int k_core_power = -3;
constexpr uint32_t k_recoveries = 4;
constexpr uint32_t k_hits_passed = 3;  ///< largest number of hits through which a cast continues
/// If the cosine between two normals is greater than this, they count as equal.
constexpr Unit k_apart_cosine = 0.9999;
/// The smallest component along `up` that the normal at an edge must have for the mover to stand on the edge.
constexpr Unit k_edge_cosine = 0.125;

/// As push_out(), for the triangle hit.triangle of a terrain. The normal points to the side of the triangle on which
/// the mover's centre is.
bool push_out_of_terrain(const World& world, const QueryHit& hit, const Shape& core, const Pose& at,
                         const Vec3<Unit>& up, Vec3<Unit>& normal, Real& depth) {
  const StateView<const uint8_t> state = view_of(world);
  const uint32_t slot = hit.body.slot - 1;
  Real height;
  if (side_of_triangle(asked_terrain(world, state.properties[slot], state.poses[slot]), hit.triangle, at, normal,
                       height) != Status::ok)
    return false;
  depth = max(core.radius + abs(core.half_length * dot(normal, up)) - height, k_zero);
  return true;
}

/// For a body that overlaps even the mover's shrunken core (k_core_power): sets `normal` and `depth`, m, of the overlap
/// with the core. For a compound, they are those of the part with the deepest overlap. Returns false if no overlap is
/// found.
bool push_out(const World& world, BodyId body, const Shape& core, const Pose& at, Vec3<Unit>& normal, Real& depth) {
  const StateView<const uint8_t> state = view_of(world);
  const BodyProperties& properties = state.properties[body.slot - 1];
  const Pose pose = pose_near(properties, state.poses[body.slot - 1], at.position);
  const ConvexParts parts(properties, world.hooks.assets);
  QueryShape shape;
  if (make_query_shape(world, core, shape) != Status::ok) return false;
  bool found = false;
  depth = k_zero;
  for (uint32_t i = 0; i < parts.count(); ++i) {
    Convex convex;
    ContactManifold manifold;
    if (!parts.convex(i, false, convex) ||
        contact_points(convex, pose, shape.convex, at, k_zero, manifold) != Status::ok || manifold.count == 0)
      continue;
    Real deepest = k_zero;
    for (uint32_t k = 0; k < manifold.count; ++k) deepest = max(deepest, -manifold.point[k].separation);
    if (found && !(deepest > depth)) continue;
    found = true;
    normal = manifold.normal;
    depth = deepest;
  }
  return found;
}

}  // namespace

MoverMotion::MoverMotion(const World& world, const MoverSettings& settings, const Position& start, MoverReport& report)
    : world_(world),
      settings_(settings),
      report_(report),
      up_(matrix_from(settings.rotation).column[1]),
      position_(start),
      free_radius_(settings.radius) {}

template <class Query>
QueryReport MoverMotion::ask(Status (*call)(const World&, const Query&, QueryHits, QueryReport&), const Query& query,
                             QueryHits hits) {
  QueryReport answer;
  ++report_.queries;
  if (const Status status = call(world_, query, hits, answer); status != Status::ok) status_ = status;
  return answer;
}

/// Whether the mover is stuck: its shrunken core is nearer to a body than half the gap, or a query failed.
bool MoverMotion::caught() const {
  return status_ != Status::ok || free_radius_ < scale_by_power(settings_.radius, k_core_power);
}

void MoverMotion::go_back(const Place& place) {
  position_ = place.position;
  report_.contact_count = place.contact_count;
  report_.contacts_dropped = place.contacts_dropped;
  known_ = false;
}

MoverPlane MoverMotion::plane_at(const QueryHit& hit, Real room) const {
  const bool floor = dot(hit.normal, up_) >= settings_.slope_cosine;
  return {hit.normal, room, floor ? Footing::floor : Footing::unknown, hit.body, hit.point, hit.triangle != UINT32_MAX};
}

void MoverMotion::add_plane(const MoverPlane& plane) {
  if (plane_count_ - hit_count_ == k_mover_near_max)
    ++report_.hits_dropped;
  else
    planes_[plane_count_++] = plane;
}

/// Adds the planes of a terrain, because one terrain may be both floor and walls. The plane of its nearest point was
/// added just before, and is left out.
void MoverMotion::add_terrain(const QueryHit& hit) {
  const StateView<const uint8_t> state = view_of(world_);
  const BodyPose& ground = state.poses[hit.body.slot - 1];
  QueryShape shape;
  if (make_query_shape(world_, capsule(settings_.radius, settings_.half_length), shape) != Status::ok) return;
  BodyPose pose = {};
  pose.position = position_;
  pose.rotation = settings_.rotation;
  const Real distance_max = settings_.gap + scale_by_power(settings_.gap, -1);
  TerrainContacts contacts;
  world_.features->terrain->collide({ground, state.properties[hit.body.slot - 1], matrix_from(ground.rotation)},
                                    {pose, shape.properties, matrix_from(pose.rotation)}, distance_max,
                                    world_.hooks.assets, contacts);
  if (contacts.dropped != 0) ++report_.hits_dropped;
  const Vec3<Unit> nearest = planes_[plane_count_ - 1].normal;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const ContactGeometry& geometry = contacts.contact[i].geometry;
    if (geometry.count == 0 || dot(geometry.normal, nearest) >= k_apart_cosine) continue;
    uint32_t lowest = 0;
    for (uint32_t k = 1; k < geometry.count; ++k)
      lowest = geometry.point[k].separation < geometry.point[lowest].separation ? k : lowest;
    const ContactGeometryPoint& point = geometry.point[lowest];
    QueryHit beside = hit;
    beside.normal = geometry.normal;
    const Vec3<Unit>& arm = point.arm_b;
    const int exponent = shape.properties.size_exponent;
    const Vec3<Real> displacement = real_from_unit(arm, exponent);
    beside.point = moved(position_, displacement - geometry.normal * scale_by_power(point.separation, -1));
    add_plane(plane_at(beside, point.separation - settings_.gap));
  }
}

void MoverMotion::add_near(const QueryHit& hit, const Shape& core) {
  const bool on_terrain = hit.triangle != UINT32_MAX;
  QueryHit out = hit;
  if (hit.normal == k_no_direction) {
    out.normal = up_;
    out.point = position_;
    Real depth = core.radius;  // used if the body cannot be tested
    const Pose at = {position_, settings_.rotation};
    if (on_terrain)
      push_out_of_terrain(world_, hit, core, at, up_, out.normal, depth);
    else
      push_out(world_, hit.body, core, at, out.normal, depth);
    out.distance = -depth;
  }
  const Real apart = out.distance - (settings_.radius - core.radius);
  report_.overlap = max(report_.overlap, -apart);
  add_plane(plane_at(out, apart - settings_.gap));
  if (on_terrain) add_terrain(hit);
}

/// Finds the planes of the bodies near the mover, and sets `free_radius_`.
void MoverMotion::look_around() {
  if (known_ || status_ != Status::ok) return;
  known_ = true;
  plane_count_ = hit_count_;
  report_.overlap = k_zero;
  const Real half_gap = scale_by_power(settings_.gap, -1);
  ClosestQuery query;
  query.shape = capsule(scale_by_power(settings_.radius, k_core_power), settings_.half_length);
  query.position = position_;
  query.rotation = settings_.rotation;
  query.distance_max = settings_.radius - query.shape.radius + settings_.gap + half_gap;
  query.filter = settings_.filter;
  query.all = true;
  QueryHit hits[k_mover_near_max];
  const QueryReport answer = ask(query_closest, query, {hits, k_mover_near_max});
  report_.hits_dropped += answer.dropped;
  Real nearest = query.distance_max;
  for (uint32_t i = 0; i < answer.hits; ++i) {
    if (hits[i].body == passed_) continue;
    nearest = min(nearest, hits[i].distance);
    if (hits[i].undecided)
      ++report_.undecided;
    else
      add_near(hits[i], query.shape);
  }
  free_radius_ = min(settings_.radius, query.shape.radius + nearest - half_gap);
}

/// Whether a cast continues through a hit: either the mover ignores the body, or the core of a stuck mover touches the
/// body at the start and does not move into it.
bool MoverMotion::passes(const QueryHit& hit, const Vec3<Real>& displacement) const {
  if (hit.body == passed_) return true;
  return caught() && hit.fraction.raw == 0 && !hit.undecided && dot(displacement, hit.normal) >= k_zero;
}

/// Moves along `displacement` until only the gap to the first obstacle is left, and keeps the plane of that obstacle.
/// If the mover is stuck (caught()), casts only its shrunken core. Range: `displacement` is at least k_mover_still
/// long.
void MoverMotion::step_along(const Vec3<Real>& displacement) {
  const Real core = scale_by_power(settings_.radius, k_core_power);
  CastQuery query;
  query.shape = capsule(max(free_radius_, core), settings_.half_length);
  query.position = position_;
  query.rotation = settings_.rotation;
  query.displacement = displacement;
  query.filter = settings_.filter;
  query.all = caught() || passed_.slot != 0;  // because hits behind the ignored ones are needed
  QueryHit hits[k_hits_passed + 1];
  const uint32_t room_for = query.all ? k_hits_passed + 1 : 1;
  const uint32_t count = ask(query_cast, query, {hits, room_for}).hits;
  if (status_ != Status::ok) return;
  uint32_t first = 0;
  while (first < count && passes(hits[first], displacement)) ++first;
  if (first == room_for) {  // the buffer had no room for hits behind these
    ++report_.hits_dropped;
    return;
  }
  known_ = false;
  const Position from = position_;
  if (first == count) {
    position_ = moved(position_, displacement);
  } else {
    const QueryHit& hit = hits[first];
    const Real fraction = real_from_fraction(hit.fraction);
    const Real closing = -dot(displacement, hit.normal);
    const Real wall = caught() ? k_zero : settings_.radius - free_radius_;
    const Real room = fraction * closing - wall - settings_.gap;
    const bool straight = closing > k_mover_still;  // false for undecided hits, which have no normal
    const Real part = straight ? divide(room, closing) : fraction - divide(settings_.gap, length(displacement));
    position_ = moved(position_, displacement * clamp(part, k_zero, fraction));
    report_.undecided += hit.undecided ? 1 : 0;
    if (straight && hit_count_ < k_mover_rounds_max) planes_[hit_count_++] = plane_at(hit, room);
  }
  const Vec3<Real> gone = real_difference(position_, from);
  for (uint32_t i = 0; i < hit_count_; ++i) planes_[i].room += dot(gone, planes_[i].normal);
}

/// Sets the footing of a plane if it is still unknown. Casts a ray down beside the contact point, on the side of the
/// body: the plane is the edge of a floor if the ray hits a floor.
void MoverMotion::find_footing(MoverPlane& plane) {
  if (plane.footing != Footing::unknown) return;
  plane.footing = Footing::none;
  const Unit rise = dot(plane.normal, up_);
  if (rise < k_edge_cosine) return;
  const Real over = scale_by_power(settings_.gap, 1);
  const Vec3<Unit> inward = up_ * rise - plane.normal;
  RayQuery query;
  query.origin = moved(plane.point, (up_ + inward) * over);
  query.displacement = up_ * scale_by_power(-over, 1);
  query.filter = settings_.filter;
  QueryHit hit;
  if (ask(query_ray, query, {&hit, 1}).hits == 0) return;
  if (hit.undecided) ++report_.undecided;
  if (!hit.undecided && dot(hit.normal, up_) >= settings_.slope_cosine) plane.footing = Footing::edge;
}

/// For each set bit i of `touched`, adds plane i to the contacts of the report.
void MoverMotion::note(uint32_t touched) {
  for (uint32_t i = 0; i < plane_count_; ++i) {
    if ((touched >> i & 1) == 0) continue;
    bool known = false;
    for (uint32_t k = 0; k < report_.contact_count; ++k) {
      const MoverContact& other = report_.contacts[k];
      known |= other.body == planes_[i].body &&
               (!planes_[i].on_terrain || dot(other.normal, planes_[i].normal) >= k_apart_cosine);
    }
    if (known) continue;
    if (report_.contact_count == k_mover_contacts_max) {
      ++report_.contacts_dropped;
      continue;
    }
    MoverContact& contact = report_.contacts[report_.contact_count++];
    contact = {};
    contact.body = planes_[i].body;
    contact.point = planes_[i].point;
    contact.normal = planes_[i].normal;
  }
}

Vec3<Real> MoverMotion::slide(Vec3<Real> displacement, MoverGait gait) {
  if (hit_count_ != 0) known_ = false;
  hit_count_ = 0;
  if (within(displacement, k_mover_still)) return displacement;
  for (uint32_t round = 0; round < k_mover_rounds_max; ++round) {
    look_around();
    if (caught()) return displacement;
    for (uint32_t i = 0; i < plane_count_ && gait == MoverGait::fall; ++i) find_footing(planes_[i]);
    uint32_t touched = 0;
    const Vec3<Real> next = slide_between({planes_, plane_count_}, displacement, up_, gait, touched);
    note(touched);
    if (within(next, k_mover_still)) return displacement;
    const Position from = position_;
    const uint32_t hits_before = hit_count_;
    step_along(next);
    const Vec3<Real> gone = real_difference(position_, from);
    displacement -= gone;
    // The rest becomes horizontal, so that the next round does not undo a rise over a floor.
    if (gait == MoverGait::walk) displacement -= up_ * dot(displacement, up_);
    if (within(displacement, k_mover_still) || (within(gone, k_mover_still) && hit_count_ == hits_before))
      return displacement;
  }
  ++report_.slides_cut;
  return displacement;
}

void MoverMotion::go(const Vec3<Real>& displacement) {
  hit_count_ = 0;
  known_ = false;
  look_around();
  if (!caught() && !within(displacement, k_mover_still)) step_along(displacement);
}

void MoverMotion::recover() {
  for (uint32_t round = 0; round < k_recoveries; ++round) {
    look_around();
    Real least = k_zero;
    for (uint32_t i = 0; i < plane_count_; ++i) least = min(least, planes_[i].room);
    if (status_ != Status::ok || least >= scale_by_power(-settings_.gap, -2)) break;
    Vec3<Real> displacement = push_out_of({planes_, plane_count_});
    const Real size = length(displacement), most = scale_by_power(settings_.radius, -1);
    if (size > most) displacement = displacement * divide(most, size);
    if (within(displacement, k_mover_still)) break;
    step_along(displacement);
  }
}

const MoverPlane* MoverMotion::find_floor() {
  look_around();
  const MoverPlane* best = nullptr;
  const Real distance_max = scale_by_power(settings_.gap, -1);
  for (const Footing wanted : k_footings) {
    for (uint32_t i = 0; i < plane_count_; ++i) {
      MoverPlane& plane = planes_[i];
      if (plane.room > distance_max) continue;
      if (wanted == Footing::edge) find_footing(plane);
      if (plane.footing != wanted) continue;
      if (best == nullptr || dot(plane.normal, up_) > dot(best->normal, up_)) best = &plane;
    }
    if (best != nullptr) break;
  }
  return best;
}

bool MoverMotion::climb(const Vec3<Real>& rest) {
  const Place start = place();
  const Real half_gap = scale_by_power(settings_.gap, -1);
  const auto rise = [&] { return dot(real_difference(position_, start.position), up_); };
  Vec3<Unit> forward;
  Real size = k_zero;
  if (!normalise(rest, forward, size)) return false;
  const auto gets_on = [&] {
    return dot(real_difference(position_, start.position), forward) >= scale_by_power(size, -2);
  };
  go(up_ * settings_.step_height);
  if (rise() > half_gap) {
    // The forward motion is at least twice the gap, so that the mover stands on the edge and not before it.
    slide(forward * max(size, scale_by_power(settings_.gap, 1)), MoverGait::walk);
    if (gets_on()) {
      go(up_ * -rise());
      const MoverPlane* floor = find_floor();
      if (floor != nullptr && rise() > half_gap && gets_on()) {
        // An edge may touch the side of the mover high above its foot. Such an edge is not a step.
        const Real top =
            dot(real_difference(floor->point, start.position), up_) + settings_.half_length + settings_.radius;
        if (top <= settings_.step_height) return true;
      }
    }
  }
  go_back(start);
  return false;
}

const MoverPlane* MoverMotion::descend() {
  const MoverPlane* floor = find_floor();
  if (floor != nullptr && floor->room <= scale_by_power(settings_.gap, -5)) return floor;
  const Place start = place();
  go(up_ * -settings_.snap);
  floor = find_floor();
  if (floor == nullptr) go_back(start);
  return floor;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
