#pragma once
#include "base/unroll.h"
#include "motion/block.h"
#include "motion/step_settings.h"

/// The relative motion of the two bodies of a contact, and the effect of an impulse between them. The frame is the
/// contact frame: its axes are the normal n and the tangents t and s, its origin is the middle of the contact's points.
/// With r the arm from a body's centre to this middle, v the velocity and w the angular velocity of a body, the parts
/// of the motion are the components along n, t and s of these two vectors:
///
///     linear:  n, t, s . ((v_B + w_B x r_B) - (v_A + w_A x r_A)), m/s
///     angular: n, t, s . (w_B - w_A) u, m/s; u is the pair's unit of length, m
///
/// The templates have a parameter `Kind`, which names types and operations: those of One solve one contact at a time,
/// those of LaneKind (lib/solver/lane_contact.h) solve several contacts at once.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The components of a motion or of a wrench in the contact frame: linear ones along the normal and the two tangents,
/// then angular ones about them.
enum Part { k_along_normal, k_along_first, k_along_second, k_about_normal, k_about_first, k_about_second, k_parts };

/// Index of element (i, k) of the symmetric response matrix: the effect of component `k` of a wrench on component `i`
/// of the relative motion (both are values of Part).
constexpr int response_index(int i, int k) { return i < k ? k * (k + 1) / 2 + i : i * (i + 1) / 2 + k; }

constexpr int k_responses = response_index(k_parts - 1, k_parts - 1) + 1;

/// A body on which impulses act. The solver stores its angular velocity in addition to its angular momentum.
struct SolvedBody {
  Vec3<Real>&linear_velocity, &angular_momentum, &angular_velocity;
  Vec3<Real>&contact_velocity, &contact_angular_momentum;
  const Vec3<Real>&displacement, &rotation_vector;
  const WorldInverseInertia& inverse_inertia;

  SolvedBody(Vec3<Real>& of_velocity, Vec3<Real>& of_angular_momentum, Vec3<Real>& of_angular_velocity,
             Vec3<Real>& from_contacts, Vec3<Real>& rotated_by_contacts, const Vec3<Real>& translation,
             const Vec3<Real>& turned, const WorldInverseInertia& own)
      : linear_velocity(of_velocity),
        angular_momentum(of_angular_momentum),
        angular_velocity(of_angular_velocity),
        contact_velocity(from_contacts),
        contact_angular_momentum(rotated_by_contacts),
        displacement(translation),
        rotation_vector(turned),
        inverse_inertia(own) {}
  SolvedBody(BodyMotion& motion, BodyWork& work)
      : linear_velocity(motion.linear_velocity),
        angular_momentum(motion.angular_momentum),
        angular_velocity(work.angular_velocity),
        contact_velocity(work.contact_velocity),
        contact_angular_momentum(work.contact_angular_momentum),
        displacement(work.displacement),
        rotation_vector(work.rotation_vector),
        inverse_inertia(work.inverse_inertia) {}
};

/// The types and operations with which the generic code solves one contact at a time.
struct One {
  using Number = Ulps;
  using Factor = detent::Factor;
  using Sum = UlpSum;
  using Vector = Mantissas;
  using Block = detent::Block;
  using Real = detent::Real;
  using Unit = detent::Unit;
  using Scaled = detent::Scaled;
  using Contact = ContactWork;
  using Body = SolvedBody;
  using Mask = bool;

  static Factor zero() { return k_no_ulps; }
  static Unit unit(Unit value) { return value; }
  static constexpr bool has_point(const Contact&, uint32_t) { return true; }
#if DETENT_FIXED
  using Wide = int64_t;
  // The next functions are for the factor L D L^T of the normal rows of a contact. Mantissas of the matrix
  // (ContactWork::coupling) have 24 fraction bits, elements of L have 20, inverse pivots have 16.
  static Factor mantissa(const Contact& contact, uint32_t i, uint32_t k) { return contact.coupling[i][k].raw >> 6; }
  static Wide widened(Factor value) { return int64_t{value} << 20; }
  static Wide wide(Factor a, Factor b) { return int64_t{a} * b; }
  static Ulps narrowed(Wide sum) { return rounded_shift(sum, 20); }
  DETENT_SHARED static Ulps scaled_product(Factor a, Factor b) { return narrowed(wide(a, b)); }
  static Factor held_row(Ulps a) { return static_cast<Factor>(clamp(a, -k_row_max, k_row_max)); }
  static Factor eightfold(Factor a) { return a * 8; }
  static Factor inverse(Ulps pivot) {
    constexpr Ulps k_least = 1 << 13;
    return static_cast<Factor>((uint64_t{1} << 40) / static_cast<uint64_t>(pivot < k_least ? k_least : pivot));
  }
  static Ulps quotient(const Contact& contact, Factor side, Factor inverse_pivot) {
    return rounded_shift(wide(side, inverse_pivot), 16 + contact.coupling_exponent);
  }
  static Ulps soft_speed(const Contact& contact, Factor impulse, Factor mantissa) {
    const int n = 24 - contact.coupling_exponent;
    return n > 0 ? rounded_shift(wide(impulse, mantissa), n) : shift_64(wide(impulse, mantissa), -n);
  }
#else
  using Wide = detent::Real;
  static Factor mantissa(const Contact& contact, uint32_t i, uint32_t k) { return contact.coupling[i][k]; }
  static Wide widened(Factor value) { return value; }
  static Wide wide(Factor a, Factor b) { return a * b; }
  static Ulps narrowed(Wide sum) { return sum; }
  static Ulps scaled_product(Factor a, Factor b) { return a * b; }
  static Factor held_row(Factor a) { return a; }
  static Factor eightfold(Factor a) { return a * detent::Real(8.0); }
  static Factor inverse(Ulps pivot) { return detent::Real(1.0) / pivot; }
  static Ulps quotient(const Contact&, Factor side, Factor inverse_pivot) { return side * inverse_pivot; }
  static Ulps soft_speed(const Contact&, Factor impulse, Factor mantissa) { return impulse * mantissa; }
#endif
  static bool is_positive(Unit value) { return value > Unit(0.0); }
  static Factor factor(Ulps value) { return static_cast<Factor>(value); }
  /// Clamps a normal impulse to its range: at least 0, and in fixed point at most k_factor_max.
  static Ulps impulse(Ulps value) {
#if DETENT_FIXED
    return value < 0 ? 0 : value > k_factor_max ? k_factor_max : value;
#else
    return max(value, k_no_ulps);
#endif
  }
  static bool takes_impulses(Scaled share) { return detent::is_positive(share); }
  static uint32_t flag(bool mask) { return mask ? 1 : 0; }
  static bool all() { return true; }
  static bool any(bool mask) { return mask; }
  static bool is_unset(uint32_t flag) { return flag == 0; }
  static const Softness& softness(const StepSettings& settings, const Contact& contact) {
    return contact.static_pair != 0 ? settings.static_softness : settings.dynamic_softness;
  }
};

/// The motions of two bodies, as integers with one common exponent (a block, block.h): the relative linear motion
/// (velocity or displacement), and the angular motion of each body.
template <class Kind>
struct PairMotion {
  typename Kind::Block block;
  typename Kind::Vector translation, angular_velocity_a, angular_velocity_b;

  PairMotion(const typename Kind::Block& room, const Vec3<typename Kind::Real>& relative,
             const Vec3<typename Kind::Real>& of_a, const Vec3<typename Kind::Real>& of_b, int exponent)
      : block(room) {
    block.include(relative, 0);
    block.include(of_a, exponent);
    block.include(of_b, exponent);
    block.settle();
    translation = block.mantissas(relative, 0);
    angular_velocity_a = block.mantissas(of_a, exponent);
    angular_velocity_b = block.mantissas(of_b, exponent);
  }

  typename Kind::Factor along_normal(const typename Kind::Contact& contact) const {
    return held(rounded(dot(translation, contact.normal) +
                        (dot(angular_velocity_b, contact.moment_b) - dot(angular_velocity_a, contact.moment_a))));
  }
  /// Relative velocity or displacement at the middle of the contact's points, world axes.
  typename Kind::Vector at_middle(const typename Kind::Contact& contact) const {
    const auto &a = contact.middle_a, &b = contact.middle_b;
    return rounded(whole(translation.x) + (cross_part(angular_velocity_b.y, b.z, angular_velocity_b.z, b.y) -
                                           cross_part(angular_velocity_a.y, a.z, angular_velocity_a.z, a.y)),
                   whole(translation.y) + (cross_part(angular_velocity_b.z, b.x, angular_velocity_b.x, b.z) -
                                           cross_part(angular_velocity_a.z, a.x, angular_velocity_a.x, a.z)),
                   whole(translation.z) + (cross_part(angular_velocity_b.x, b.y, angular_velocity_b.y, b.x) -
                                           cross_part(angular_velocity_a.x, a.y, angular_velocity_a.y, a.x)));
  }
  /// Relative angular velocity, or rotation vector, times the pair's unit of length, world axes.
  typename Kind::Vector turning(const typename Kind::Contact& contact) const {
    const auto a = contact.unit_a, b = contact.unit_b;
    return rounded(product(angular_velocity_b.x, b) - product(angular_velocity_a.x, a),
                   product(angular_velocity_b.y, b) - product(angular_velocity_a.y, a),
                   product(angular_velocity_b.z, b) - product(angular_velocity_a.z, a));
  }

 private:
  using Factor = typename Kind::Factor;
  using Unit = typename Kind::Unit;
  static typename Kind::Sum cross_part(Factor p, Unit q, Factor r, Unit s) { return product(p, q) - product(r, s); }
};

/// The parts of the relative motion that determine the normal velocity of the points. A point at the coordinates (x, y)
/// along the two tangents, relative to the middle of the points, has this normal velocity: `along` + `about_first` y -
/// `about_second` x.
template <class Kind>
struct NormalMotion {
  typename Kind::Factor along, about_first, about_second;

  NormalMotion(typename Kind::Factor normal, typename Kind::Factor first, typename Kind::Factor second)
      : along(normal), about_first(first), about_second(second) {}
  NormalMotion(const PairMotion<Kind>& motion, const typename Kind::Contact& contact)
      : along(motion.along_normal(contact)) {
    const typename Kind::Vector turning = motion.turning(contact);
    about_first = held(rounded(dot(turning, contact.tangent[0])));
    about_second = held(rounded(dot(turning, contact.tangent[1])));
  }
  typename Kind::Factor at(const typename Kind::Contact& contact, uint32_t i) const {
    return held(along + rounded(product(about_first, contact.y[i]) - product(about_second, contact.x[i])));
  }
};

/// Returns the change of a body's motion (velocity or angular momentum) by contacts in this substep. In fixed point
/// `kept` is minus the motion before the contacts changed it, and the difference is exact. In float `kept` is the sum
/// of the changes, because a difference would lose small impulses at high speeds.
inline Vec3<Real> added_by_contacts(const Vec3<Real>& motion, const Vec3<Real>& kept) {
  return DETENT_FIXED ? motion + kept : kept;
}
/// Returns the first value of `kept` in a substep. `motion`: the motion before contacts change it. `added`: the change
/// that the warm start then adds to it.
inline Vec3<Real> kept_at_start(const Vec3<Real>& motion, const Vec3<Real>& added) {
  return DETENT_FIXED ? -motion : added;
}

/// Applies the wrench (force, torque) to a body, or the opposite wrench if `adds` is false. `share` is the relative
/// inverse mass of the body. `torque` is in the body's unit of length. The changes are:
///
///     velocity += share force;  momentum += share torque;  angular velocity += share inverse inertia torque
template <class Kind, bool adds>
inline void push(const typename Kind::Block& block, const typename Kind::Vector& force,
                 const typename Kind::Vector& torque, const typename Kind::Scaled& share, typename Kind::Body& body) {
  const auto& inverse_inertia = body.inverse_inertia;
  const auto add = [](auto& to, const auto& more) {
    if constexpr (adds)
      to += more;
    else
      to -= more;
  };
  const auto linear_velocity = block.real(force, share, 0), angular_momentum = block.real(torque, share, 0);
  add(body.linear_velocity, linear_velocity);
  add(body.angular_momentum, angular_momentum);
  if constexpr (!DETENT_FIXED) {
    add(body.contact_velocity, linear_velocity);
    add(body.contact_angular_momentum, angular_momentum);
  }
  const typename Kind::Vector turned =
      rounded(dot(torque, fine(inverse_inertia.row[0])), dot(torque, fine(inverse_inertia.row[1])),
              dot(torque, fine(inverse_inertia.row[2])));
  add(body.angular_velocity, block.real(turned, share, inverse_inertia.exponent - k_angular_velocity_power));
}

/// Applies a wrench to B, and the opposite wrench to A. The wrench is an impulse along the normal at the middle of the
/// points, and an angular impulse about each tangent.
template <class Kind>
inline void apply_normal(const typename Kind::Contact& contact, typename Kind::Block block, typename Kind::Number along,
                         typename Kind::Number about_first, typename Kind::Number about_second, typename Kind::Body& a,
                         typename Kind::Body& b) {
  typename Kind::Number sum[3] = {along, about_first, about_second};
  block.coarsen(sum);
  const typename Kind::Factor part[3] = {held(sum[0]), held(sum[1]), held(sum[2])};
  const auto &n = contact.normal, &t = contact.tangent[0], &s = contact.tangent[1];
  const auto force = rounded(product(part[0], n.x), product(part[0], n.y), product(part[0], n.z));
  const auto rotation_vector =
      rounded(product(part[1], t.x) + product(part[2], s.x), product(part[1], t.y) + product(part[2], s.y),
              product(part[1], t.z) + product(part[2], s.z));
  const auto torque = [&](const auto& lever, const auto& unit) {
    return rounded(product(part[0], lever.x) + product(rotation_vector.x, unit),
                   product(part[0], lever.y) + product(rotation_vector.y, unit),
                   product(part[0], lever.z) + product(rotation_vector.z, unit));
  };
  if (Kind::takes_impulses(contact.inverse_mass_a))
    push<Kind, false>(block, force, torque(contact.moment_a, contact.unit_a), contact.inverse_mass_a, a);
  if (Kind::takes_impulses(contact.inverse_mass_b))
    push<Kind, true>(block, force, torque(contact.moment_b, contact.unit_b), contact.inverse_mass_b, b);
}

/// Applies a wrench at the middle of the points to B, and the opposite wrench to A.
template <class Kind>
inline void apply_wrench(const typename Kind::Contact& contact, typename Kind::Block block,
                         const typename Kind::Number (&wrench)[k_parts], typename Kind::Body& a,
                         typename Kind::Body& b) {
  typename Kind::Number sum[k_parts];
  typename Kind::Factor part[k_parts];
  DETENT_UNROLL
  for (int i = 0; i < k_parts; ++i) sum[i] = wrench[i];
  block.coarsen(sum);
  DETENT_UNROLL
  for (int i = 0; i < k_parts; ++i) part[i] = held(sum[i]);
  const auto &n = contact.normal, &t = contact.tangent[0], &s = contact.tangent[1];
  const auto in_world = [&](int first) {
    const auto along = [&](const auto& x, const auto& y, const auto& z) {
      return product(part[first], x) + product(part[first + 1], y) + product(part[first + 2], z);
    };
    return rounded(along(n.x, t.x, s.x), along(n.y, t.y, s.y), along(n.z, t.z, s.z));
  };
  const auto force = in_world(k_along_normal), rotation_vector = in_world(k_about_normal);
  const auto torque = [&](const auto& arm, const auto& unit) {
    return rounded(product(force.z, arm.y) - product(force.y, arm.z) + product(rotation_vector.x, unit),
                   product(force.x, arm.z) - product(force.z, arm.x) + product(rotation_vector.y, unit),
                   product(force.y, arm.x) - product(force.x, arm.y) + product(rotation_vector.z, unit));
  };
  if (Kind::takes_impulses(contact.inverse_mass_a))
    push<Kind, false>(block, force, torque(contact.middle_a, contact.unit_a), contact.inverse_mass_a, a);
  if (Kind::takes_impulses(contact.inverse_mass_b))
    push<Kind, true>(block, force, torque(contact.middle_b, contact.unit_b), contact.inverse_mass_b, b);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
