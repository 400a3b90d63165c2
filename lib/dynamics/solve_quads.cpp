#include "dynamics/solve_quads.h"

#if DETENT_QUADS
#include "dynamics/quad_contact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_QUAD_INLINE void hold_lane(Quad (&v)[2], Quad limit, int lane) {
#if DETENT_FIXED
  Factor own[2] = {static_cast<Factor>(v[0].v[lane]), static_cast<Factor>(v[1].v[lane])};
  hold_to_circle(own, static_cast<Factor>(limit.v[lane]));
#else
  Factor own[2] = {v[0].v[lane], v[1].v[lane]};
  hold_to_circle(own, limit.v[lane]);
#endif
  v[0].v[lane] = own[0];
  v[1].v[lane] = own[1];
}

}  // namespace

/// Few contacts slide: those lanes one by one.
DETENT_QUAD_INLINE void hold_to_circle(Quad (&v)[2], Quad limit) {
  const Quad none = quad_of(0);
  const Quad size = select(none > v[0], -v[0], v[0]) + select(none > v[1], -v[1], v[1]);
  const QuadMask out = size > limit;
  if (!any(out)) return;
  for (int lane = 0; lane < 4; ++lane) {
    if (out.v[lane] != 0) hold_lane(v, limit, lane);
  }
}

namespace {

using Contacts = ContactWork* const (&)[4];

/// Words of ContactWork from a member on.
template <unsigned count>
struct Words {
  QuadInt32 word[count];
  uint32_t first;

  DETENT_QUAD_INLINE Words(Contacts from, uint32_t offset) : first(offset) {
    const void* start[4];
    for (int k = 0; k < 4; ++k) start[k] = reinterpret_cast<const uint8_t*>(from[k]) + offset;
    read_words(start, word);
  }
  DETENT_QUAD_INLINE QuadInt32 at(uint32_t offset, uint32_t i = 0) const { return word[(offset - first) / 4 + i]; }
  DETENT_QUAD_INLINE Quad unit(uint32_t offset, uint32_t i = 0) const { return quad_from_words(at(offset, i)); }
  DETENT_QUAD_INLINE Vec3<Quad> vector(uint32_t offset) const {
    return {unit(offset), unit(offset, 1), unit(offset, 2)};
  }
  DETENT_QUAD_INLINE QuadScaled scaled(uint32_t offset, uint32_t i = 0) const {
#if DETENT_FIXED
    return {unit(offset, 2 * i), unit(offset, 2 * i + 1)};
#else
    return unit(offset, i);
#endif
  }
  template <unsigned used>
  DETENT_QUAD_INLINE void units(uint32_t offset, Quad (&to)[used]) const {
    DETENT_UNROLL
    for (uint32_t i = 0; i < used; ++i) to[i] = unit(offset, i);
  }
};
#define DETENT_AT(member) static_cast<uint32_t>(__builtin_offsetof(ContactWork, member))

template <unsigned count>
DETENT_QUAD_INLINE void read_reals_at(Contacts from, uint32_t offset, Quad (&to)[count]) {
  const auto at = [&](int k) {
    return reinterpret_cast<const Real*>(reinterpret_cast<const uint8_t*>(from[k]) + offset);
  };
  QuadRow row[4];
  read_reals({at(0), at(1), at(2), at(3)}, row);
  DETENT_UNROLL
  for (unsigned i = 0; i < count; ++i) to[i] = {row[i]};
}
DETENT_QUAD_INLINE void write_reals_at(const Quad (&from)[4], Contacts to, uint32_t offset) {
  const auto at = [&](int k) { return reinterpret_cast<Real*>(reinterpret_cast<uint8_t*>(to[k]) + offset); };
  QuadRow row[4] = {from[0].v, from[1].v, from[2].v, from[3].v};
  write_reals(row, {at(0), at(1), at(2), at(3)});
}
DETENT_QUAD_INLINE QuadMask mask_of(QuadInt32 flags) {
#if DETENT_FIXED
  return {__builtin_convertvector(flags != 0, QuadInt64)};
#else
  return {flags != 0};
#endif
}

static_assert(__builtin_offsetof(ContactState, normal_impulse) + 4 * sizeof(Real) <= sizeof(ContactState));
static_assert(DETENT_AT(angular_impulse) == DETENT_AT(friction_impulse) + 2 * sizeof(Real));

DETENT_QUAD_INLINE void read_contact(const StepSettings& settings, Contacts from, QuadContact& to) {
  const Words<56> words(from, DETENT_AT(normal));
  to.normal = words.vector(DETENT_AT(normal));
  to.tangent[0] = words.vector(DETENT_AT(tangent[0]));
  to.tangent[1] = words.vector(DETENT_AT(tangent[1]));
  to.lever_a = words.vector(DETENT_AT(lever_a));
  to.lever_b = words.vector(DETENT_AT(lever_b));
  to.unit_a = words.unit(DETENT_AT(unit_a));
  to.unit_b = words.unit(DETENT_AT(unit_b));
  DETENT_UNROLL
  for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
    words.units(DETENT_AT(coupling) + 16 * i, to.coupling[i]);
    to.apart[i] = mask_of(words.at(DETENT_AT(apart), i));
  }
  to.coupling_exponent = exponent_from_words(words.at(DETENT_AT(coupling_exponent)));
  words.units(DETENT_AT(x), to.x);
  words.units(DETENT_AT(y), to.y);
  words.units(DETENT_AT(inverse_mass), to.inverse_mass);
  to.share_a = words.scaled(DETENT_AT(share_a));
  to.share_b = words.scaled(DETENT_AT(share_b));
  to.state.point_count = from[0]->state.point_count;
  to.angular_rows = from[0]->angular_rows;
  read_reals_at(from, DETENT_AT(state.normal_impulse), to.state.normal_impulse);
  read_reals_at(from, DETENT_AT(impulse_max), to.impulse_max);
  const QuadMask is_static = mask_of(words.at(DETENT_AT(static_pair)));
  const Softness &of_static = settings.static_softness, &of_dynamic = settings.dynamic_softness;
  to.softness = {select(is_static, quad_of(of_static.rate), quad_of(of_dynamic.rate)),
                 select(is_static, quad_of(of_static.mass_scale), quad_of(of_dynamic.mass_scale)),
                 select(is_static, quad_of(of_static.impulse_scale), quad_of(of_dynamic.impulse_scale))};
}

DETENT_QUAD_INLINE void read_gaps(Contacts from, QuadContact& to) {
  read_reals_at(from, DETENT_AT(separation), to.separation);
  Quad one[1];
  read_reals_at(from, DETENT_AT(push_max), one);
  to.push_max = one[0];
}

DETENT_QUAD_INLINE void read_friction(Contacts from, QuadContact& to) {
  const Words<DETENT_FIXED ? 44 : 36> words(from, DETENT_AT(middle_a));
  to.middle_a = words.vector(DETENT_AT(middle_a));
  to.middle_b = words.vector(DETENT_AT(middle_b));
  DETENT_UNROLL
  for (int i = 0; i < 7; ++i) {
    for (int k = 0; k < 3; ++k)
      to.response[3 * i + k] = words.unit(DETENT_AT(response), static_cast<uint32_t>(3 * i + k));
  }
  to.response_exponent = exponent_from_words(words.at(DETENT_AT(response_exponent)));
  words.units(DETENT_AT(friction_mass), to.friction_mass);
  to.friction = words.scaled(DETENT_AT(friction));
  to.twist_arm = words.scaled(DETENT_AT(twist_arm));
  to.rolling_arm = words.scaled(DETENT_AT(rolling_arm));
  for (uint32_t i = 0; i < 3; ++i) to.angular_mass[i] = words.scaled(DETENT_AT(angular_mass), i);
  Quad impulses[4], last[1];
  read_reals_at(from, DETENT_AT(friction_impulse), impulses);
  read_reals_at(from, DETENT_AT(angular_impulse[2]), last);
  to.friction_impulse[0] = impulses[0];
  to.friction_impulse[1] = impulses[1];
  to.angular_impulse[0] = impulses[2];
  to.angular_impulse[1] = impulses[3];
  to.angular_impulse[2] = last[0];
}

DETENT_QUAD_INLINE void write_normals(const QuadContact& from, Contacts to) {
  write_reals_at(from.state.normal_impulse, to, DETENT_AT(state.normal_impulse));
  write_reals_at(from.impulse_max, to, DETENT_AT(impulse_max));
}

DETENT_QUAD_INLINE void write_apart(const QuadContact& from, Contacts to) {
  QuadInt32 words[4];
  DETENT_UNROLL
  for (int i = 0; i < 4; ++i) {
#if DETENT_FIXED
    words[i] = __builtin_convertvector(from.apart[i].v, QuadInt32) & 1;
#else
    words[i] = from.apart[i].v & 1;
#endif
  }
  write_words(words, {to[0]->apart, to[1]->apart, to[2]->apart, to[3]->apart});
}

DETENT_QUAD_INLINE void write_friction(const QuadContact& from, Contacts to) {
  write_reals_at({from.friction_impulse[0], from.friction_impulse[1], from.angular_impulse[0], from.angular_impulse[1]},
                 to, DETENT_AT(friction_impulse));
  if (from.angular_rows != 3) return;
  for (int k = 0; k < 4; ++k) {
#if DETENT_FIXED
    to[k]->angular_impulse[2].raw = from.angular_impulse[2].v[k];
#else
    to[k]->angular_impulse[2] = from.angular_impulse[2].v[k];
#endif
  }
}

DETENT_QUAD_INLINE void read_vectors(const QuadInt32* words, Vec3<Quad>* to, int count) {
  for (int i = 0; i < count; ++i)
    to[i] = {quad_from_words(words[3 * i]), quad_from_words(words[3 * i + 1]), quad_from_words(words[3 * i + 2])};
}

/// Four bodies: those that take impulses are written back.
struct Bodies {
  BodyMotion* motion[4];
  BodyWork* work[4];

  DETENT_QUAD_INLINE void read(QuadBody& to, bool with_way) const {
    read_vector(
        motion, [](BodyMotion& m) -> Vec3<Real>& { return m.velocity; }, to.velocity);
    read_vector(
        motion, [](BodyMotion& m) -> Vec3<Real>& { return m.momentum; }, to.momentum);
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.spin; }, to.spin);
    if (with_way) {
      read_vector(
          work, [](BodyWork& w) -> Vec3<Real>& { return w.displacement; }, to.displacement);
      read_vector(
          work, [](BodyWork& w) -> Vec3<Real>& { return w.turn; }, to.turn);
    }
#if !DETENT_FIXED
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.contact_velocity; }, to.contact_velocity);
    read_vector(
        work, [](BodyWork& w) -> Vec3<Real>& { return w.contact_momentum; }, to.contact_momentum);
#endif
    const void* const start[4] = {&work[0]->gyration, &work[1]->gyration, &work[2]->gyration, &work[3]->gyration};
    QuadInt32 words[12];
    read_words(start, words);
    read_vectors(words, to.gyration.row, 3);
    to.gyration.exponent = exponent_from_words(words[9]);
  }
  DETENT_QUAD_INLINE void write(const QuadBody& from, Contacts contacts, Scaled ContactWork::*share) const {
    BodyMotion no_motion;  // of what takes no impulses, and may be another contact's body as well
    BodyWork no_work;
    BodyMotion* motions[4];
    BodyWork* works[4];
    for (int k = 0; k < 4; ++k) {
      const bool takes = is_positive(contacts[k]->*share);
      motions[k] = takes ? motion[k] : &no_motion;
      works[k] = takes ? work[k] : &no_work;
    }
    write_vector(from.velocity, motions, [](BodyMotion& m) -> Vec3<Real>& { return m.velocity; });
    write_vector(from.momentum, motions, [](BodyMotion& m) -> Vec3<Real>& { return m.momentum; });
    write_vector(from.spin, works, [](BodyWork& w) -> Vec3<Real>& { return w.spin; });
#if !DETENT_FIXED
    write_vector(from.contact_velocity, works, [](BodyWork& w) -> Vec3<Real>& { return w.contact_velocity; });
    write_vector(from.contact_momentum, works, [](BodyWork& w) -> Vec3<Real>& { return w.contact_momentum; });
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

/// Reads four contacts and their bodies, lets `solve` work on them, and writes back what contacts and bodies share;
/// `read` and `write` take the rest of the contacts.
template <class Read, class Solve, class Write>
DETENT_QUAD_INLINE void pass(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts, bool with_way,
                             const Read& read, const Solve& solve, const Write& write) {
  const Bodies all_a = bodies_of(bodies, contacts, &ContactState::body_a);
  const Bodies all_b = bodies_of(bodies, contacts, &ContactState::body_b);
  QuadContact contact;
  QuadBody a, b;
  read_contact(settings, contacts, contact);
  read(contacts, contact);
  all_a.read(a, with_way);
  all_b.read(b, with_way);
  ContactSolver<Four> solver = {settings, contact, a, b};
  solve(solver);
  all_a.write(a, contacts, &ContactWork::share_a);
  all_b.write(b, contacts, &ContactWork::share_b);
  write_normals(contact, contacts);
  write(contact, contacts);
}

}  // namespace

void soften_quad(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts) {
  pass(
      settings, bodies, contacts, true, read_gaps, [](ContactSolver<Four>& solver) { solver.soften(); }, write_apart);
}

void relax_quad(const StepSettings& settings, const SolverBodies& bodies, Contacts contacts) {
  pass(
      settings, bodies, contacts, false, read_friction, [](ContactSolver<Four>& solver) { solver.relax(); },
      write_friction);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
