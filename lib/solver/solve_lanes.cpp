#include "solver/solve_lanes.h"

#if DETENT_QUADS
#include "solver/lane_contact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_LANES_INLINE void clamp_lane(Lanes (&v)[2], Lanes limit, int lane) {
#if DETENT_FIXED
  Factor own[2] = {static_cast<Factor>(v[0].v[lane]), static_cast<Factor>(v[1].v[lane])};
  clamp_to_circle(own, static_cast<Factor>(limit.v[lane]));
#else
  Factor own[2] = {v[0].v[lane], v[1].v[lane]};
  clamp_to_circle(own, limit.v[lane]);
#endif
  v[0].v[lane] = own[0];
  v[1].v[lane] = own[1];
}

}  // namespace

/// Clamps v to the circle of radius `limit` in each lane. Only few contacts slide, so their lanes are processed one by
/// one.
DETENT_LANES_INLINE void clamp_to_circle(Lanes (&v)[2], Lanes limit) {
  const Lanes none = lanes_of(0);
  const Lanes size = select(none > v[0], -v[0], v[0]) + select(none > v[1], -v[1], v[1]);
  const LaneMask out = size > limit;
  if (!any(out)) return;
  for (int lane = 0; lane < 4; ++lane) {
    if (out.v[lane] != 0) clamp_lane(v, limit, lane);
  }
}

namespace {

using Contacts = ContactWork* const (&)[4];

/// Words of ContactWork, beginning with a given member.
template <unsigned count>
struct Words {
  LaneWords<count> words;
  uint32_t first;

  DETENT_LANES_INLINE static const uint8_t* start(const ContactWork* from, uint32_t offset) {
    return reinterpret_cast<const uint8_t*>(from) + offset;
  }
  DETENT_LANES_INLINE Words(Contacts from, uint32_t offset)
      : words({start(from[0], offset), start(from[1], offset), start(from[2], offset), start(from[3], offset)}),
        first(offset) {}
  DETENT_LANES_INLINE uint32_t index(uint32_t offset) const { return (offset - first) / 4; }
  DETENT_LANES_INLINE Lanes unit(uint32_t offset, uint32_t i = 0) const { return words.unit(index(offset) + i); }
  DETENT_LANES_INLINE LaneExponent exponent(uint32_t offset) const { return words.exponent(index(offset)); }
  DETENT_LANES_INLINE LaneMask flag(uint32_t offset, uint32_t i = 0) const { return words.flag(index(offset) + i); }
  DETENT_LANES_INLINE Vec3<Lanes> vector(uint32_t offset) const {
    return {unit(offset), unit(offset, 1), unit(offset, 2)};
  }
  DETENT_LANES_INLINE LaneScaled scaled(uint32_t offset, uint32_t i = 0) const {
    return words.scaled(index(offset) + i * static_cast<uint32_t>(sizeof(Scaled) / 4));
  }
  template <unsigned used>
  DETENT_LANES_INLINE void units(uint32_t offset, Lanes (&to)[used]) const {
    DETENT_UNROLL
    for (uint32_t i = 0; i < used; ++i) to[i] = unit(offset, i);
  }
};
#define DETENT_AT(member) static_cast<uint32_t>(__builtin_offsetof(ContactWork, member))

DETENT_LANES_INLINE Real* reals_at(ContactWork* contact, uint32_t offset) {
  return reinterpret_cast<Real*>(reinterpret_cast<uint8_t*>(contact) + offset);
}
DETENT_LANES_INLINE void read_reals_at(Contacts from, uint32_t offset, Lanes (&to)[4]) {
  read_reals(
      {reals_at(from[0], offset), reals_at(from[1], offset), reals_at(from[2], offset), reals_at(from[3], offset)}, to);
}
DETENT_LANES_INLINE Lanes read_real_at(Contacts from, uint32_t offset) {
  return read_real(
      {reals_at(from[0], offset), reals_at(from[1], offset), reals_at(from[2], offset), reals_at(from[3], offset)});
}
DETENT_LANES_INLINE void write_reals_at(const Lanes (&from)[4], Contacts to, uint32_t offset) {
  write_reals(from,
              {reals_at(to[0], offset), reals_at(to[1], offset), reals_at(to[2], offset), reals_at(to[3], offset)});
}

static_assert(__builtin_offsetof(ContactState, normal_impulse) + 4 * sizeof(Real) <= sizeof(ContactState));
static_assert(DETENT_AT(angular_impulse) == DETENT_AT(friction_impulse) + 2 * sizeof(Real));

DETENT_LANES_INLINE void read_contact(Contacts from, LaneContact& to) {
  const Words<56> words(from, DETENT_AT(normal));
  to.normal = words.vector(DETENT_AT(normal));
  to.tangent[0] = words.vector(DETENT_AT(tangent[0]));
  to.tangent[1] = words.vector(DETENT_AT(tangent[1]));
  to.moment_a = words.vector(DETENT_AT(moment_a));
  to.moment_b = words.vector(DETENT_AT(moment_b));
  to.unit_a = words.unit(DETENT_AT(unit_a));
  to.unit_b = words.unit(DETENT_AT(unit_b));
  DETENT_UNROLL
  for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
    words.units(DETENT_AT(coupling) + 16 * i, to.coupling[i]);
    to.apart[i] = words.flag(DETENT_AT(apart), i);
  }
  to.coupling_exponent = words.exponent(DETENT_AT(coupling_exponent));
  to.static_pair = words.flag(DETENT_AT(static_pair));
  words.units(DETENT_AT(x), to.x);
  words.units(DETENT_AT(y), to.y);
  words.units(DETENT_AT(inverse_mass), to.inverse_mass);
  to.inverse_mass_a = words.scaled(DETENT_AT(inverse_mass_a));
  to.inverse_mass_b = words.scaled(DETENT_AT(inverse_mass_b));
  to.state.point_count = from[0]->state.point_count;
  to.angular_rows = from[0]->angular_rows;
  read_reals_at(from, DETENT_AT(state.normal_impulse), to.state.normal_impulse);
  read_reals_at(from, DETENT_AT(impulse_max), to.impulse_max);
}

DETENT_LANES_INLINE void read_gaps(Contacts from, LaneContact& to) {
  read_reals_at(from, DETENT_AT(separation), to.separation);
  to.push_max = read_real_at(from, DETENT_AT(push_max));
}

DETENT_LANES_INLINE void read_friction(Contacts from, LaneContact& to) {
  const Words<DETENT_FIXED ? 44 : 36> words(from, DETENT_AT(middle_a));
  to.middle_a = words.vector(DETENT_AT(middle_a));
  to.middle_b = words.vector(DETENT_AT(middle_b));
  DETENT_UNROLL
  for (int i = 0; i < 7; ++i) {
    for (int k = 0; k < 3; ++k)
      to.response[3 * i + k] = words.unit(DETENT_AT(response), static_cast<uint32_t>(3 * i + k));
  }
  to.response_exponent = words.exponent(DETENT_AT(response_exponent));
  words.units(DETENT_AT(friction_mass), to.friction_mass);
  to.friction = words.scaled(DETENT_AT(friction));
  to.twist_arm = words.scaled(DETENT_AT(twist_arm));
  to.rolling_arm = words.scaled(DETENT_AT(rolling_arm));
  for (uint32_t i = 0; i < 3; ++i) to.angular_mass[i] = words.scaled(DETENT_AT(angular_mass), i);
  Lanes impulses[4];
  read_reals_at(from, DETENT_AT(friction_impulse), impulses);
  to.friction_impulse[0] = impulses[0];
  to.friction_impulse[1] = impulses[1];
  to.angular_impulse[0] = impulses[2];
  to.angular_impulse[1] = impulses[3];
  to.angular_impulse[2] = read_real_at(from, DETENT_AT(angular_impulse[2]));
}

DETENT_LANES_INLINE void write_normals(const LaneContact& from, Contacts to) {
  write_reals_at(from.state.normal_impulse, to, DETENT_AT(state.normal_impulse));
  write_reals_at(from.impulse_max, to, DETENT_AT(impulse_max));
}

DETENT_LANES_INLINE void write_solved(const LaneContact& from, Contacts to) {
  write_normals(from, to);
  LaneInt32 words[4];
  DETENT_UNROLL
  for (int i = 0; i < 4; ++i) {
#if DETENT_FIXED
    words[i] = __builtin_convertvector(from.apart[i].v, LaneInt32) & 1;
#else
    words[i] = from.apart[i].v & 1;
#endif
  }
  write_words(words, {to[0]->apart, to[1]->apart, to[2]->apart, to[3]->apart});
}

DETENT_LANES_INLINE void write_relaxed(const LaneContact& from, Contacts to) {
  write_normals(from, to);
  write_reals_at({from.friction_impulse[0], from.friction_impulse[1], from.angular_impulse[0], from.angular_impulse[1]},
                 to, DETENT_AT(friction_impulse));
  if (from.angular_rows != 3) return;
  write_real(from.angular_impulse[2],
             {reals_at(to[0], DETENT_AT(angular_impulse[2])), reals_at(to[1], DETENT_AT(angular_impulse[2])),
              reals_at(to[2], DETENT_AT(angular_impulse[2])), reals_at(to[3], DETENT_AT(angular_impulse[2]))});
}

/// Four bodies, one per lane. Only the bodies that take impulses are written back.
struct Bodies {
  BodyMotion* motion[4];
  BodyWork* work[4];

  DETENT_LANES_INLINE void read(LaneBody& to, bool with_displacement) const {
    read_vector(
        motion, [](BodyMotion& m) -> Vec3<Real>& { return m.linear_velocity; }, to.linear_velocity);
    read_vector(
        motion, [](BodyMotion& m) -> Vec3<Real>& { return m.angular_momentum; }, to.angular_momentum);
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.angular_velocity; }, to.angular_velocity);
    if (with_displacement) {
      read_vector(
          work, [](BodyWork& w) -> Vec3<Real>& { return w.displacement; }, to.displacement);
      read_vector(
          work, [](BodyWork& w) -> Vec3<Real>& { return w.rotation_vector; }, to.rotation_vector);
    }
#if !DETENT_FIXED
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.contact_velocity; }, to.contact_velocity);
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.contact_angular_momentum; }, to.contact_angular_momentum);
#endif
    const auto inverse_inertia = [this](int k) { return reinterpret_cast<const uint8_t*>(&work[k]->inverse_inertia); };
    const LaneWords<12> words({inverse_inertia(0), inverse_inertia(1), inverse_inertia(2), inverse_inertia(3)});
    DETENT_UNROLL
    for (uint32_t i = 0; i < 3; ++i)
      to.inverse_inertia.row[i] = {words.unit(3 * i), words.unit(3 * i + 1), words.unit(3 * i + 2)};
    to.inverse_inertia.exponent = words.exponent(9);
  }
  DETENT_LANES_INLINE void write(const LaneBody& from, Contacts contacts, Scaled ContactWork::*share) const {
    // Receives the results for bodies that take no impulses. They must not be written back, because such a body may
    // belong to several of the contacts.
    BodyMotion no_motion;
    BodyWork no_work;
    BodyMotion* motions[4];
    BodyWork* works[4];
    for (int k = 0; k < 4; ++k) {
      const bool takes = is_positive(contacts[k]->*share);
      motions[k] = takes ? motion[k] : &no_motion;
      works[k] = takes ? work[k] : &no_work;
    }
    write_vector(from.linear_velocity, motions, [](BodyMotion& m) -> Vec3<Real>& { return m.linear_velocity; });
    write_vector(from.angular_momentum, motions, [](BodyMotion& m) -> Vec3<Real>& { return m.angular_momentum; });
    write_vector(from.angular_velocity, works, [](BodyWork& w) -> Vec3<Real>& { return w.angular_velocity; });
#if !DETENT_FIXED
    write_vector(from.contact_velocity, works, [](BodyWork& w) -> Vec3<Real>& { return w.contact_velocity; });
    write_vector(from.contact_angular_momentum, works,
                 [](BodyWork& w) -> Vec3<Real>& { return w.contact_angular_momentum; });
#endif
  }
};

Bodies bodies_of(const SolverBodies& bodies, Contacts contacts, uint32_t ContactState::*body) {
  Bodies result;
  for (int k = 0; k < 4; ++k) {
    const uint32_t slot = contacts[k]->state.*body;
    result.motion[k] = &bodies.motions[slot];
    result.work[k] = &bodies.work[slot];
  }
  return result;
}

/// Reads four contacts and their bodies, calls `solve` on them, and writes the bodies back. `read` reads the members of
/// the contacts that only this pass needs; `write` writes the contacts back.
template <class Read, class Solve, class Write>
DETENT_LANES_INLINE void pass(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts,
                              bool with_displacement, const Read& read, const Solve& solve, const Write& write) {
  const Bodies all_a = bodies_of(bodies, contacts, &ContactState::body_a);
  const Bodies all_b = bodies_of(bodies, contacts, &ContactState::body_b);
  LaneContact contact;
  LaneBody a, b;
  read_contact(contacts, contact);
  read(contacts, contact);
  all_a.read(a, with_displacement);
  all_b.read(b, with_displacement);
  ContactSolver<Four> solver = {settings, contact, a, b};
  solve(solver);
  all_a.write(a, contacts, &ContactWork::inverse_mass_a);
  all_b.write(b, contacts, &ContactWork::inverse_mass_b);
  write(contact, contacts);
}

}  // namespace

void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts) {
  pass(
      settings, bodies, contacts, false, read_friction, [](ContactSolver<Four>& solver) { solver.warm_start(); },
      [](const LaneContact&, Contacts) {});
}

void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts) {
  pass(
      settings, bodies, contacts, true, read_gaps, [](ContactSolver<Four>& solver) { solver.solve_normals(); },
      write_solved);
}

void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts) {
  pass(
      settings, bodies, contacts, false, read_friction, [](ContactSolver<Four>& solver) { solver.relax(); },
      write_relaxed);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
