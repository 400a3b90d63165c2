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
  const Lanes none = lanes_of(LaneNumber{0});
  const Lanes size = select(none > v[0], -v[0], v[0]) + select(none > v[1], -v[1], v[1]);
  const LaneMask out = size > limit;
  if (!any(out)) return;
  for (int lane = 0; lane < 4; ++lane) {
    if (out.v[lane] != 0) clamp_lane(v, limit, lane);
  }
}

namespace {

using Contacts = const ContactWork* const (&)[4];

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
  DETENT_LANES_INLINE LaneUnits unit(uint32_t offset) const { return words.unit(index(offset)); }
  DETENT_LANES_INLINE LaneInt32 word(uint32_t offset) const { return words.word[index(offset)]; }
  DETENT_LANES_INLINE Vec3<LaneUnits> vector(uint32_t offset) const {
    return {unit(offset), unit(offset + 4), unit(offset + 8)};
  }
  DETENT_LANES_INLINE LaneScaled scaled(uint32_t offset) const { return words.scaled(index(offset)); }
  DETENT_LANES_INLINE LaneShare share(uint32_t offset) const { return words.share(index(offset)); }
  /// Reads Units that stand for their value times 2^exponent.
  template <unsigned used>
  DETENT_LANES_INLINE void units(uint32_t offset, LaneUnits (&to)[used],
                                 LaneInt32 exponent = LaneInt32{0, 0, 0, 0}) const {
    DETENT_UNROLL
    for (uint32_t i = 0; i < used; ++i) to[i] = words.unit(index(offset) + i, exponent);
  }
};
#define DETENT_AT(member) static_cast<uint32_t>(__builtin_offsetof(ContactWork, member))

DETENT_LANES_INLINE void read_rows(Contacts from, LaneContact& to) {
  {
    const Words<56> words(from, DETENT_AT(normal));
    to.normal = words.vector(DETENT_AT(normal));
    to.tangent[0] = words.vector(DETENT_AT(tangent[0]));
    to.tangent[1] = words.vector(DETENT_AT(tangent[1]));
    to.moment_a = words.vector(DETENT_AT(moment_a));
    to.moment_b = words.vector(DETENT_AT(moment_b));
    to.unit_a = words.unit(DETENT_AT(unit_a));
    to.unit_b = words.unit(DETENT_AT(unit_b));
    for (uint32_t i = 0; i < k_manifold_points_max; ++i)
      words.units(DETENT_AT(coupling) + 16 * i, to.coupling[i], words.word(DETENT_AT(coupling_exponent)));
#if DETENT_FIXED
    to.coupling_power = LaneWords<4>::power(24 - words.word(DETENT_AT(coupling_exponent)));
    to.coupling_step = LaneWords<4>::power(words.word(DETENT_AT(coupling_exponent)) - 24);
#endif
    to.static_pair = words.word(DETENT_AT(static_pair)) != 0;
    words.units(DETENT_AT(x), to.x);
    words.units(DETENT_AT(y), to.y);
    words.units(DETENT_AT(inverse_mass), to.inverse_mass);
    to.inverse_mass_a = words.share(DETENT_AT(inverse_mass_a));
    to.inverse_mass_b = words.share(DETENT_AT(inverse_mass_b));
  }
  const Words<DETENT_FIXED ? 44 : 36> words(from, DETENT_AT(middle_a));
  to.middle_a = words.vector(DETENT_AT(middle_a));
  to.middle_b = words.vector(DETENT_AT(middle_b));
  words.units(DETENT_AT(response), to.response, words.word(DETENT_AT(response_exponent)));
  words.units(DETENT_AT(friction_mass), to.friction_mass);
  to.friction = words.scaled(DETENT_AT(friction));
  to.twist_arm = words.scaled(DETENT_AT(twist_arm));
  to.rolling_arm = words.scaled(DETENT_AT(rolling_arm));
  for (uint32_t i = 0; i < 3; ++i)
    to.angular_mass[i] = words.scaled(DETENT_AT(angular_mass) + i * static_cast<uint32_t>(sizeof(Scaled)));
}

DETENT_LANES_INLINE void read_inverse_inertias(const SolverBodies& bodies, LaneContact& to) {
  for (int end = 0; end < 2; ++end) {
    const auto of = [&](int k) {
      return reinterpret_cast<const uint8_t*>(&bodies.work[to.body[end][k]].inverse_inertia);
    };
    const LaneWords<12> words({of(0), of(1), of(2), of(3)});
    LaneInverseInertia& inverse_inertia = to.inverse_inertia[end];
    DETENT_UNROLL
    for (uint32_t i = 0; i < 3; ++i)
      inverse_inertia.row[i] = {words.fine_unit(3 * i), words.fine_unit(3 * i + 1), words.fine_unit(3 * i + 2)};
    inverse_inertia.exponent = words.word[9];
  }
}

/// Four bodies, one per lane. Only the bodies that take impulses are written back.
struct Bodies {
  BodyMotion* motion[4];
  BodyWork* work[4];

  DETENT_LANES_INLINE Bodies(const SolverBodies& bodies, const uint32_t (&slots)[4]) {
    for (int k = 0; k < 4; ++k) {
      motion[k] = &bodies.motions[slots[k]];
      work[k] = &bodies.work[slots[k]];
    }
  }
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
  }
  DETENT_LANES_INLINE void write(const LaneBody& from, const uint32_t (&takes)[4]) const {
    // Receives the results for bodies that take no impulses. They must not be written back, because such a body may
    // belong to several of the contacts.
    BodyMotion no_motion;
    BodyWork no_work;
    BodyMotion* motions[4];
    BodyWork* works[4];
    for (int k = 0; k < 4; ++k) {
      motions[k] = takes[k] != 0 ? motion[k] : &no_motion;
      works[k] = takes[k] != 0 ? work[k] : &no_work;
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

static_assert(sizeof(LaneContact) == sizeof(LaneSpace) && alignof(LaneContact) <= alignof(LaneSpace));
DETENT_LANES_INLINE LaneContact& contact_in(LaneSpace& lanes) { return reinterpret_cast<LaneContact&>(lanes); }

/// Reads the bodies of four contacts, calls `solve` on them, and writes the bodies back.
template <class Solve>
DETENT_LANES_INLINE void pass(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes,
                              bool with_displacement, const Solve& solve) {
  LaneContact& contact = contact_in(lanes);
  const Bodies all_a(bodies, contact.body[0]), all_b(bodies, contact.body[1]);
  LaneBody a(contact.inverse_inertia[0]), b(contact.inverse_inertia[1]);
  all_a.read(a, with_displacement);
  all_b.read(b, with_displacement);
  ContactSolver<Four> solver = {settings, contact, a, b};
  solve(solver);
  all_a.write(a, contact.takes[0]);
  all_b.write(b, contact.takes[1]);
}

/// Calls visit(member of ContactWork, number of Reals, their lanes) for each array of impulses that the passes change.
template <class Lane, class Visit>
DETENT_LANES_INLINE void each_impulse(Lane& lanes, const Visit& visit) {
  visit([](auto& contact) { return contact.state.normal_impulse; }, lanes.state.normal_impulse);
  visit([](auto& contact) { return contact.impulse_max; }, lanes.impulse_max);
  visit([](auto& contact) { return contact.friction_impulse; }, lanes.friction_impulse);
  visit([](auto& contact) { return contact.angular_impulse; }, lanes.angular_impulse);
}

template <class Pick, unsigned count>
DETENT_LANES_INLINE void read_all(Contacts from, const Pick& pick, LaneReals (&to)[count]) {
  for (unsigned i = 0; i < count; ++i)
    to[i] = read_real({pick(*from[0]) + i, pick(*from[1]) + i, pick(*from[2]) + i, pick(*from[3]) + i});
}

}  // namespace

void put_in_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, const ContactOrder* order,
                  LaneSpace& lanes) {
  LaneContact& to = contact_in(lanes);
  const ContactWork* const from[4] = {&contacts[order[0].contact], &contacts[order[1].contact],
                                      &contacts[order[2].contact], &contacts[order[3].contact]};
  for (int k = 0; k < 4; ++k) {
    to.contact[k] = order[k].contact;
    to.body[0][k] = from[k]->state.body_a;
    to.body[1][k] = from[k]->state.body_b;
    to.takes[0][k] = is_positive(from[k]->inverse_mass_a) ? 1 : 0;
    to.takes[1][k] = is_positive(from[k]->inverse_mass_b) ? 1 : 0;
  }
  to.state.point_count = from[0]->state.point_count;
  to.angular_rows = from[0]->angular_rows;
  read_rows(from, to);
  read_inverse_inertias(bodies, to);
  each_impulse(to, [&](const auto& pick, auto& impulses) { read_all(from, pick, impulses); });
  read_all(
      from, [](const ContactWork& contact) { return contact.separation; }, to.separation);
  to.push_max = read_real({&from[0]->push_max, &from[1]->push_max, &from[2]->push_max, &from[3]->push_max});
}

void renew_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace& lanes) {
  LaneContact& to = contact_in(lanes);
  read_rows({&contacts[to.contact[0]], &contacts[to.contact[1]], &contacts[to.contact[2]], &contacts[to.contact[3]]},
            to);
  read_inverse_inertias(bodies, to);
}

void take_from_lanes(const LaneSpace& lanes, Span<ContactWork> contacts) {
  const LaneContact& from = reinterpret_cast<const LaneContact&>(lanes);
  ContactWork* const to[4] = {&contacts[from.contact[0]], &contacts[from.contact[1]], &contacts[from.contact[2]],
                              &contacts[from.contact[3]]};
  each_impulse(from, [&](const auto& pick, const auto& impulses) {
    for (unsigned i = 0; i < sizeof(impulses) / sizeof(impulses[0]); ++i)
      write_real(impulses[i], {pick(*to[0]) + i, pick(*to[1]) + i, pick(*to[2]) + i, pick(*to[3]) + i});
  });
}

void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes) {
  pass(settings, bodies, lanes, false, [](ContactSolver<Four>& solver) { solver.warm_start(); });
}

void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes) {
  pass(settings, bodies, lanes, true, [](ContactSolver<Four>& solver) { solver.solve_normals(); });
}

void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes) {
  pass(settings, bodies, lanes, false, [](ContactSolver<Four>& solver) { solver.relax(); });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
