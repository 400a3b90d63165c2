#include "ccd/impact_response.h"
#include "ccd/impact_stage.h"
#include "contact/compound_ops.h"
#include "contact/contact_arm.h"
#include "math/root.h"
#include "motion/activity.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_rounds_max = 64;  ///< limit of the rounds that propagate an impulse
constexpr int k_free_rounds = 8;  ///< number of the first rounds, in which hold_lighter() is not called

/// For a pair with several contacts, takes the contact whose normal is nearest to the normal of the impact. If the
/// impact has no normal, takes the deepest contact.
__attribute__((noinline)) void find_part_points(const ImpactStage& stage, const ImpactPair& pair,
                                                const CollisionBody& a, const CollisionBody& b,
                                                const ContactMargins& margin, ContactGeometry& geometry) {
  TerrainContacts contacts;
  collide_parts(a, b, margin, stage.assets, stage.settings.reduction, stage.features, contacts);
  const TerrainContact* best = nullptr;
  Real most = k_zero;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const ContactGeometry& found = contacts.contact[i].geometry;
    Real rank = real_from_unit(dot(found.normal, pair.normal), 0);
    for (uint32_t k = 0; !is_direction(pair.normal) && k < found.count; ++k)
      rank = max(rank, -found.point[k].separation);
    if (best != nullptr && !(rank > most)) continue;
    best = &contacts.contact[i];
    most = rank;
  }
  geometry.count = 0;
  if (best != nullptr) geometry = best->geometry;
  geometry.seam = contacts.seam;
}

/// Finds the contact points of the bodies' full shapes, not of their shrunken cores. Returns no points if the contact
/// normal is 90 degrees or more from the normal of the impact: deep within a thin body, the direction of least
/// penetration may lead through the body. The contact counts as one at a seam (the edge between two bodies with level
/// faces) if the contact search finds it to be one. It also counts as one if the overlap is no deeper than that of
/// resting bodies, and either more than two points touch or the two normals enclose an angle between 60 and 120
/// degrees.
void find_points(const ImpactStage& stage, const ImpactPair& pair, const BodyPose& pose_a, const BodyPose& pose_b,
                 ContactGeometry& geometry) {
  const BodyProperties &a = stage.bodies.properties[pair_low(pair.key)],
                       &b = stage.bodies.properties[pair_high(pair.key)];
  const Matrix3 rotation_a = matrix_from(pose_a.rotation), rotation_b = matrix_from(pose_b.rotation);
  const Real about = scale_by_power(stage.extent_of(pair.key), -10);
  const ContactMargins margin = {about, stage.settings.sunk};
  const CollisionBody body_a = {pose_a, a, rotation_a}, body_b = {pose_b, b, rotation_b};
  if (has_parts(a, b))
    find_part_points(stage, pair, body_a, body_b, margin, geometry);
  else
    collide(body_a, body_b, margin, geometry, stage.assets, stage.settings.reduction, stage.features);
  if (!is_direction(pair.normal) || geometry.count == 0) return;
  const Unit along = dot(geometry.normal, pair.normal);
  const bool lies_aside = abs(along) < Unit(0.5);
  const bool lies_flat = geometry.count > 2;
  geometry.seam = geometry.seam || ((lies_aside || lies_flat) && depth_of(geometry) <= stage.settings.sunk);
  if (!(along > Unit(0.0))) geometry.count = 0;
}

/// Makes a contact of one point: the point at which time_of_impact() found the impact.
void take_point(const ImpactStage& stage, const ImpactPair& pair, const BodyPose& pose_a, const BodyPose& pose_b,
                ContactGeometry& geometry) {
  const BodyProperties &a = stage.bodies.properties[pair_low(pair.key)],
                       &b = stage.bodies.properties[pair_high(pair.key)];
  const auto arm = [](const BodyProperties& properties, const Vec3<Real>& point) {
    const Unit zero = 0.0;
    if (is_half_space(properties)) return Vec3<Unit>{zero, zero, zero};
    return arm_of_offset(point, properties.size_exponent);
  };
  geometry.count = 1;
  geometry.normal = pair.normal;
  geometry.point[0] = {arm(a, pair.point), arm(b, pair.point - offset_of(pose_a, pose_b)), k_zero, 1};
}

/// Returns the mean of the contact points, as a world position.
Position point_of(const ContactGeometry& geometry, const BodyPose& pose_a, const BodyPose& pose_b,
                  const BodyProperties& a, const BodyProperties& b) {
  static constexpr Unit k_share[k_manifold_points_max] = {1.0, 0.5, 1.0 / 3.0, 0.25};
  // If A is a terrain or a half-space, B's arms are used: a terrain is large, so its arms are coarse, and the points on
  // a half-space have no arms.
  const bool by_b = is_ground(a);
  const int exponent = by_b ? b.size_exponent : a.size_exponent;
  Vec3<Real> sum = k_zero_vector;
  for (uint32_t i = 0; i < geometry.count; ++i) {
    const Vec3<Unit> arm = (by_b ? geometry.point[i].arm_b : geometry.point[i].arm_a) * k_share[geometry.count - 1];
    sum += real_from_unit(arm, exponent);
  }
  return moved((by_b ? pose_b : pose_a).position, sum);
}
void wake(ImpactStage& stage, uint32_t slot) {
  if (stage.bodies.activities[slot].asleep == 0) return;
#if DETENT_TASKS
  if (stage.warp != nullptr) {
    stage.warp->fail();
    return;
  }
#endif
  stage.sweep_of(slot).marks |= k_mark_slept;
  stage.report.woke += wake_all_with(slot, stage.bodies.activities, stage.bodies.active);
}

/// The velocity that gravity adds to a body in the part of the tick after `time`.
Vec3<Real> fall_after(const ImpactStage& stage, uint32_t slot, Fraction time) {
  const BodyProperties& properties = stage.bodies.properties[slot];
  if (!is_dynamic(properties) || (stage.sweep_of(slot).marks & k_mark_slept) != 0) return k_zero_vector;
  const Vec3<Real> fall = stage.settings.gravity * stage.settings.tick_time;
  bool saturated = false;
  return part_of(multiply(fall, properties.gravity_scale, saturated), k_whole_step - time);
}

/// Returns a part of the speed, m/s, at which the rotations of both bodies can bring them together again in the rest of
/// the tick. The part is 1/16 at the second impact of the pair, then twice as much each time, up to all of the speed.
Real bend_speed(const ImpactStage& stage, const ImpactPair& pair) {
  const Real part = part_of(stage.bend_of(pair.key), k_whole_step - pair.time);
  const int power = (pair.impacts < 5 ? pair.impacts : 5) - 5;
  bool saturated = false;
  return multiply(scale_by_power(part, power), stage.tick_rate, saturated);
}

/// Returns the lowest speed, m/s, at which a pair must separate on its sweeps. The speed corrects an overlap. A body
/// that rotates or rolls on an edge collides again and again. If the pair has already collided in this tick, the speed
/// therefore grows with the number of its impacts, so that a few impacts are enough for the tick. The speed does not
/// change the velocities in the bodies' state.
Real parting_speed(const ImpactStage& stage, const ImpactPair& pair, const ContactWork& contact, uint32_t count) {
  bool saturated = false;
  Real depth = k_zero, approach = k_zero;
  for (uint32_t i = 0; i < count; ++i) {
    depth = max(depth, -contact.separation[i]);
    approach = max(approach, -contact.approach[i]);
  }
  const Real half_in_a_tick = scale_by_power(multiply(depth, stage.tick_rate, saturated), -1);
  if (pair.impacts == 0)
    return max(half_in_a_tick, min(scale_by_power(half_in_a_tick, 6), scale_by_power(approach, -2)));
  const int power = pair.impacts < 2 ? -2 : pair.impacts < 5 ? -1 : 0;
  return max(max(half_in_a_tick, scale_by_power(approach, power)), bend_speed(stage, pair));
}

/// One of the bodies that resolve_at() separates. Its motion along the sweep is changed first, then the motion in its
/// state.
class ImpactedBody {
 public:
  DETENT_SHARED ImpactedBody(ImpactStage& stage, uint32_t slot, const BodyPose& pose)
      : stage_(stage),
        slot_(slot),
        pose_(pose),
        properties_(stage.bodies.properties[slot]),
        before_(motion_of_sweep(properties_, pose.rotation, stage.sweep_of(slot), stage.tick_rate)),
        motion_(before_),
        inverse_inertia_(world_inverse_inertia(properties_, matrix_from(pose.rotation))),
        angular_velocity_(world_angular_velocity(properties_, inverse_inertia_, before_.angular_momentum,
                                                 -k_angular_velocity_power)) {}
  ImpactedBody(const ImpactedBody&) = delete;
  ImpactedBody& operator=(const ImpactedBody&) = delete;

  DETENT_SHARED RowBody row_body() const {
    const Real extent = shape_extent(properties_);
    return {
        properties_, pose_, before_, inverse_inertia_, angular_velocity_, extent, fall_speed(stage_.settings, extent)};
  }
  ImpactBody impact_body() { return {properties_, pose_.rotation, motion_}; }

  /// Changes the sweep to the motion after the impact, and wakes the body.
  DETENT_SHARED void set_sweep() {
    wake(stage_, slot_);
    hold();
    BodySweep& sweep = stage_.sweep_of(slot_);
    if (!stage_.dynamic(slot_) || (sweep.marks & k_mark_stopped) != 0) return;
    stage_.report.clamped +=
        add_to_sweep(properties_, pose_.rotation, before_, motion_, stage_.settings.tick_time, sweep);
  }
  /// Continues with the motion in the body's state. Subtracts the velocity that gravity adds after `time`; set_state()
  /// adds it again.
  DETENT_SHARED void read_state(Fraction time) {
    fall_ = fall_after(stage_, slot_, time);
    motion_ = stage_.motion_of(slot_);
    motion_.linear_velocity -= fall_;
  }
  DETENT_SHARED void set_state() {
    motion_.linear_velocity += fall_;
    hold();
    if (stage_.dynamic(slot_)) stage_.motion_of(slot_) = motion_;
  }

 private:
  void hold() { stage_.report.clamped += clamp_angular_velocity(properties_, pose_.rotation, motion_); }

  ImpactStage& stage_;
  const uint32_t slot_;
  const BodyPose& pose_;
  const BodyProperties& properties_;
  const BodyMotion before_;  ///< motion along the sweep before the impact
  BodyMotion motion_;
  const WorldInverseInertia inverse_inertia_;
  const Vec3<Real> angular_velocity_;
  Vec3<Real> fall_ = k_zero_vector;  ///< velocity that gravity adds after the impact, m/s
};

/// If the lighter one of two dynamic bodies also had an impact with a fixed body at `time`, replaces the lighter body
/// in `slots` by the fixed body; of several, by the one with the lowest slot. The fixed body then takes the impulse,
/// and the heavier body is stopped as if the lighter one were a part of the fixed body.
void hold_lighter(const ImpactStage& stage, Fraction time, uint32_t (&slots)[2]) {
  const Span<const BodyProperties> properties = stage.bodies.properties;
  const uint32_t which = less(properties[slots[0]].mass, properties[slots[1]].mass) ? 0 : 1;
  if (!stage.dynamic(slots[1 - which])) return;
  const uint32_t lighter = slots[which];
  uint32_t lowest = UINT32_MAX;
  stage.for_each_impact(lighter, [&](const ImpactPair& pair) {
    const uint32_t low = pair_low(pair.key), other = low == lighter ? pair_high(pair.key) : low;
    if (other < lowest && pair.last == time && type_of(properties[other]) == BodyType::fixed) lowest = other;
  });
  if (lowest != UINT32_MAX) slots[which] = lowest;
}

/// Separates the bodies of a pair at the given points. Returns false if the bodies do not approach there; the attempt
/// counts as work, but changes no body. `again`: the impulse is propagated from another pair. Then an approach of at
/// most 2^-12 of the approach speed of that pair (first_approach) is ignored, the bodies need not separate at
/// parting_speed(), and the impact is neither counted nor recorded. `holds`: see hold_lighter().
bool resolve_at(ImpactStage& stage, ImpactPair& pair, const ContactGeometry& geometry, const BodyPose& pose_a,
                const BodyPose& pose_b, bool again, bool holds) {
  stage.take_work(1);
  uint32_t slots[2] = {pair_low(pair.key), pair_high(pair.key)};
  if (holds) hold_lighter(stage, pair.time, slots);
  ImpactedBody a(stage, slots[0], pose_a), b(stage, slots[1], pose_b);
  ContactWork contact;
  contact.state = {};
  contact.state.point_count = static_cast<uint8_t>(geometry.count);
  make_rows(stage.settings, a.row_body(), b.row_body(), geometry, k_zero, contact);
  const Real parting = again ? k_zero : parting_speed(stage, pair, contact, geometry.count);
  const Real least = again ? scale_by_power(stage.first_approach, -12) : k_zero;
  const auto resolves = [&](Real least_approach, Real leave, Real& found) {
    return resolve_impact(contact, geometry.count, least_approach, leave, a.impact_body(), b.impact_body(), found);
  };
  Real approach = k_zero;
  if (!resolves(least, parting, approach)) return false;
  a.set_sweep();
  b.set_sweep();
  a.read_state(pair.time);
  b.read_state(pair.time);
  // If the solver has pushed the pair apart, a slow remaining approach is left to the solver in the next tick.
  const Real least_of_state = stage.is_pushed(pair.key) ? contact.rebound_min : k_zero;
  Real approach_of_state = k_zero;
  if (resolves(least_of_state, k_zero, approach_of_state)) {
    a.set_state();
    b.set_state();
  }

  if (again) return true;
  stage.first_approach = approach;
  ++stage.report.impacts;
  // The 8-bit counter `impacts` does not overflow: a body stops after k_impacts_max impacts, and a kinematic body then
  // hits the stopped body at most once at each shrink depth.
  static_assert(2 * k_impacts_max <= UINT8_MAX);
  ++pair.impacts;
  stage.add_hit(
      {pair.key, pair.time,
       point_of(geometry, pose_a, pose_b, stage.bodies.properties[slots[0]], stage.bodies.properties[slots[1]]),
       geometry.normal, approach});
  return true;
}

/// The pair with the lowest key above `after` that has collided in this tick and shares a dynamic body with the first
/// pair.
ImpactPair* next_touching(const ImpactStage& stage, uint64_t first_key, uint64_t after) {
  ImpactPair* best = nullptr;
  const uint32_t slots[2] = {pair_low(first_key), pair_high(first_key)};
  for (const uint32_t slot : slots) {
    if (!stage.dynamic(slot)) continue;
    stage.for_each_impact(slot, [&](ImpactPair& pair) {
      if (pair.impacts == 0 || pair.key <= after || (best != nullptr && pair.key > best->key)) return;
      best = &pair;
    });
  }
  return best;
}

/// Resolves a pair that may still touch. Returns false if its bodies do not touch or do not approach. If they touch,
/// both are moved to `time`. `holds`: see hold_lighter().
bool collide_again(ImpactStage& stage, ImpactPair& pair, Fraction time, bool holds) {
  const uint32_t slots[2] = {pair_low(pair.key), pair_high(pair.key)};
  const BodyPose pose_a = pose_at(stage.body(slots[0]), time), pose_b = pose_at(stage.body(slots[1]), time);
  ContactGeometry geometry;
  const Fraction next_time = pair.time;
  pair.time = time;
  find_points(stage, pair, pose_a, pose_b, geometry);
  for (const uint32_t slot : slots) {
    if (geometry.count != 0 && stage.dynamic(slot)) stage.move_to(slot, time);
  }
  if (geometry.count == 0 || !resolve_at(stage, pair, geometry, pose_a, pose_b, true, holds)) {
    pair.time = next_time;
    return false;
  }
  pair.last = time;
  for (const uint32_t slot : slots) {
    if (stage.dynamic(slot)) stage.change(slot);
  }
  return true;
}

}  // namespace

void ImpactStage::add_hit(const ImpactHit& hit) {
#if DETENT_TASKS
  if (warp != nullptr) {
    warp->add_output(hit);
    return;
  }
#endif
  if (report.hits < hits.count)
    hits[report.hits++] = hit;
  else
    ++report.hits_dropped;
}

bool ImpactStage::resolve(ImpactPair& pair, bool undecided, const BodyPose& pose_a, const BodyPose& pose_b) {
  ContactGeometry geometry;
  find_points(*this, pair, pose_a, pose_b, geometry);
  if (geometry.count != 0 && resolve_at(*this, pair, geometry, pose_a, pose_b, false, false)) return false;
  if (undecided || !is_direction(pair.normal)) return false;
  if (geometry.seam && pair.farther_in == 0) return true;
  take_point(*this, pair, pose_a, pose_b, geometry);
  resolve_at(*this, pair, geometry, pose_a, pose_b, false, false);
  return false;
}

void ImpactStage::pass_on(ImpactPair& first, Fraction time) {
  for (int round = 0; round < k_rounds_max && !is_spent(); ++round) {
    const bool holds = round >= k_free_rounds;
    bool again = false;
    uint64_t after = 0;
    while (ImpactPair* pair = next_touching(*this, first.key, after)) {
      after = pair->key;
      if (after != first.key) again = collide_again(*this, *pair, time, holds) || again;
    }
    if (!again) break;
    collide_again(*this, first, time, holds);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
