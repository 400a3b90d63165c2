#pragma once
#include "solver/lane_contact.h"
#include "solver/solve_lanes.h"

/// The passes over groups of contacts in lanes, for any number of lanes. The files that are compiled for one kind of
/// processor instantiate them.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

template <uint32_t count>
using Contacts = const ContactWork* const (&)[count];

/// Words of `count` ContactWorks, from the member at `offset` on. A member is selected by its offset in ContactWork.
template <uint32_t count, uint32_t size>
struct Words {
  LaneWords<count, size> words;
  uint32_t first;

  DETENT_LANES_INLINE Words(Contacts<count> from, uint32_t offset)
      : words(EachLane<const uint8_t*, count>([&](uint32_t k) {
                return reinterpret_cast<const uint8_t*>(from[k]) + offset;
              }).of),
        first(offset) {}
  DETENT_LANES_INLINE uint32_t index(uint32_t offset) const { return (offset - first) / 4; }
  DETENT_LANES_INLINE LaneUnits<count> unit(uint32_t offset) const { return words.unit(index(offset)); }
  DETENT_LANES_INLINE LaneInt32<count> word(uint32_t offset) const { return words.word[index(offset)]; }
  DETENT_LANES_INLINE Vec3<LaneUnits<count>> vector(uint32_t offset) const {
    return {unit(offset), unit(offset + 4), unit(offset + 8)};
  }
  DETENT_LANES_INLINE LaneScaled<count> scaled(uint32_t offset) const { return words.scaled(index(offset)); }
  DETENT_LANES_INLINE LaneShare<count> share(uint32_t offset) const { return words.share(index(offset)); }
  /// Reads mantissas, and multiplies them by 2^exponent.
  template <unsigned used>
  DETENT_LANES_INLINE void units(uint32_t offset, LaneUnits<count> (&to)[used],
                                 LaneInt32<count> exponent = LaneInt32<count>{}) const {
    DETENT_UNROLL
    for (uint32_t i = 0; i < used; ++i) to[i] = words.unit(index(offset) + i, exponent);
  }
};
#define DETENT_AT(member) static_cast<uint32_t>(__builtin_offsetof(ContactWork, member))

template <uint32_t count>
DETENT_LANES_INLINE void read_rows(Contacts<count> from, LaneContact<count>& to) {
  {
    const Words<count, 56> words(from, DETENT_AT(normal));
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
    to.coupling_power = LaneWords<count, 4>::power(24 - words.word(DETENT_AT(coupling_exponent)));
    to.coupling_step = LaneWords<count, 4>::power(words.word(DETENT_AT(coupling_exponent)) - 24);
#endif
    to.static_pair = words.word(DETENT_AT(static_pair)) != 0;
    words.units(DETENT_AT(x), to.x);
    words.units(DETENT_AT(y), to.y);
    words.units(DETENT_AT(normal_mass), to.normal_mass);
    to.inverse_mass_a = words.share(DETENT_AT(inverse_mass_a));
    to.inverse_mass_b = words.share(DETENT_AT(inverse_mass_b));
  }
  const Words<count, DETENT_FIXED ? 44 : 36> words(from, DETENT_AT(middle_a));
  to.middle_a = words.vector(DETENT_AT(middle_a));
  to.middle_b = words.vector(DETENT_AT(middle_b));
  words.units(DETENT_AT(response), to.response, words.word(DETENT_AT(response_exponent)));
  to.friction_mass = words.unit(DETENT_AT(friction_mass));
  to.friction = words.scaled(DETENT_AT(friction));
  to.twist_arm = words.scaled(DETENT_AT(twist_arm));
  to.rolling_arm = words.scaled(DETENT_AT(rolling_arm));
  to.twist_mass = words.scaled(DETENT_AT(twist_mass));
  to.rolling_mass = words.scaled(DETENT_AT(rolling_mass));
}

template <uint32_t count>
DETENT_LANES_INLINE void read_inverse_inertias(const SolverBodies& bodies, LaneContact<count>& to) {
  for (int end = 0; end < 2; ++end) {
    const LaneWords<count, 12> words(EachLane<const uint8_t*, count>([&](uint32_t k) {
                                       return reinterpret_cast<const uint8_t*>(
                                           &bodies.work[to.body[end][k]].inverse_inertia);
                                     }).of);
    LaneInverseInertia<count>& inverse_inertia = to.inverse_inertia[end];
    DETENT_UNROLL
    for (uint32_t i = 0; i < 3; ++i)
      inverse_inertia.row[i] = {words.fine_unit(3 * i), words.fine_unit(3 * i + 1), words.fine_unit(3 * i + 2)};
    inverse_inertia.exponent = words.word[9];
  }
}

/// Bodies, one per lane. Only the bodies that take impulses are written back.
template <uint32_t count>
struct Bodies {
  BodyMotion* motion[count];
  BodyWork* work[count];

  DETENT_LANES_INLINE Bodies(const SolverBodies& bodies, const uint32_t (&slots)[count]) {
    for (uint32_t k = 0; k < count; ++k) {
      motion[k] = &bodies.motions[slots[k]];
      work[k] = &bodies.work[slots[k]];
    }
  }
  DETENT_LANES_INLINE void read(LaneBody<count>& to, bool with_displacement) const {
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
  DETENT_LANES_INLINE void write(const LaneBody<count>& from, const uint32_t (&takes)[count]) const {
    // `no_motion` and `no_work` receive the results for bodies that take no impulses. Such a body must not be written
    // back, because it may belong to several contacts of the group.
    BodyMotion no_motion;
    BodyWork no_work;
    BodyMotion* motions[count];
    BodyWork* works[count];
    for (uint32_t k = 0; k < count; ++k) {
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

template <uint32_t count>
DETENT_LANES_INLINE LaneContact<count>& contact_in(LaneSpace* lanes) {
  static_assert(sizeof(LaneContact<count>) <= count / 4 * sizeof(LaneSpace) &&
                alignof(LaneContact<count>) <= alignof(LaneSpace));
  return *reinterpret_cast<LaneContact<count>*>(lanes);
}

/// Reads the bodies of a group of contacts, calls `solve` on them, and writes the bodies back.
template <uint32_t count, class Solve>
DETENT_LANES_INLINE void pass(const StepSettings& settings, const SolverBodies& bodies, LaneContact<count>& contact,
                              bool with_displacement, const Solve& solve) {
  const Bodies<count> all_a(bodies, contact.body[0]), all_b(bodies, contact.body[1]);
  LaneBody<count> a(contact.inverse_inertia[0]), b(contact.inverse_inertia[1]);
  all_a.read(a, with_displacement);
  all_b.read(b, with_displacement);
  ContactSolver<LaneKind<count>> solver = {settings, contact, a, b};
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

/// Sets the rows of absent points of contacts that have fewer points than the group. These rows get no impulse, and
/// their products change no sum, not even the sign of a zero.
template <uint32_t count>
DETENT_LANES_INLINE void clear_absent_points(LaneContact<count>& to) {
  for (uint32_t lane = 0; lane < count; ++lane) {
    for (uint32_t i = static_cast<uint32_t>(to.points[lane]); i < to.state.point_count; ++i) {
      for (LaneUnits<count>& element : to.coupling[i]) element.v[lane] = -0.0f;
      to.coupling[i][i].v[lane] = 1;  // a pivot, so not 0
      to.x[i].v[lane] = to.normal_mass[i].v[lane] = 0;
      to.y[i].v[lane] = -0.0f;
      to.separation[i].v[lane] = 0;
    }
  }
}

template <uint32_t count, class Pick, unsigned size>
DETENT_LANES_INLINE void read_all(Contacts<count> from, const Pick& pick, LaneReals<count> (&to)[size]) {
  for (unsigned i = 0; i < size; ++i)
    to[i] = read_real(EachLane<const Real*, count>([&](uint32_t k) { return pick(*from[k]) + i; }).of);
}

/// The passes for groups in `count` lanes.
template <uint32_t count>
struct GroupPasses {
  static void put(const SolverBodies& bodies, Span<const ContactWork> contacts, Span<const ContactOrder> group,
                  LaneSpace* lanes) {
    LaneContact<count>& to = contact_in<count>(lanes);
    to.used = group.count;
    const ContactWork* from[count];
    for (uint32_t k = 0; k < count; ++k) {
      const bool used = k < to.used;
      to.contact[k] = group[used ? k : to.used - 1].contact;
      from[k] = &contacts[to.contact[k]];
      to.body[0][k] = from[k]->state.body_a;
      to.body[1][k] = from[k]->state.body_b;
      to.takes[0][k] = used && is_positive(from[k]->inverse_mass_a) ? 1 : 0;
      to.takes[1][k] = used && is_positive(from[k]->inverse_mass_b) ? 1 : 0;
      to.points[k] = static_cast<int32_t>(from[k]->state.point_count);
    }
    to.state.point_count = from[count - 1]->state.point_count;
    to.angular_rows = from[0]->angular_rows;
    read_rows<count>(from, to);
    read_inverse_inertias(bodies, to);
    each_impulse(to, [&](const auto& pick, auto& impulses) { read_all<count>(from, pick, impulses); });
    read_all<count>(
        from, [](const ContactWork& contact) { return contact.separation; }, to.separation);
    to.deep = read_real(EachLane<const Real*, count>([&](uint32_t k) { return &from[k]->deep; }).of);
    to.push_max = read_real(EachLane<const Real*, count>([&](uint32_t k) { return &from[k]->push_max; }).of);
    clear_absent_points(to);
  }
  static void renew(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace* lanes) {
    LaneContact<count>& to = contact_in<count>(lanes);
    read_rows<count>(EachLane<const ContactWork*, count>([&](uint32_t k) { return &contacts[to.contact[k]]; }).of, to);
    read_inverse_inertias(bodies, to);
    clear_absent_points(to);
  }
  static void take(const LaneSpace* lanes, Span<ContactWork> contacts) {
    const LaneContact<count>& from = *reinterpret_cast<const LaneContact<count>*>(lanes);
    ContactWork no_contact;  // receives the results of lanes without a contact
    const auto to = [&](uint32_t k) -> ContactWork& { return k < from.used ? contacts[from.contact[k]] : no_contact; };
    each_impulse(from, [&](const auto& pick, const auto& impulses) {
      for (unsigned i = 0; i < sizeof(impulses) / sizeof(impulses[0]); ++i)
        write_real(impulses[i], EachLane<Real*, count>([&](uint32_t k) { return pick(to(k)) + i; }).of);
    });
  }
  static void warm_start(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes) {
    pass(settings, bodies, contact_in<count>(lanes), false, [](auto& solver) { solver.warm_start(); });
  }
  static void solve_normals(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes) {
    pass(settings, bodies, contact_in<count>(lanes), true, [](auto& solver) { solver.solve_normals(); });
  }
  static void relax(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes) {
    pass(settings, bodies, contact_in<count>(lanes), false, [](auto& solver) { solver.relax(); });
  }
};
template <uint32_t count>
inline constexpr LanePasses k_group_passes = {GroupPasses<count>::put,           GroupPasses<count>::renew,
                                              GroupPasses<count>::take,          GroupPasses<count>::warm_start,
                                              GroupPasses<count>::solve_normals, GroupPasses<count>::relax};

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
