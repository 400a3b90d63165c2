#pragma once
#include "base/unroll.h"
#include "dynamics/block.h"

/// How the two bodies of a contact move against each other, and what an impulse between them does: in the contact's
/// frame (normal, then the tangents), at the middle of its points, in m/s. A spin is over the pair's unit of length.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The parts of a motion or of a wrench: along the normal and the tangents, then about them.
enum Part { k_along_normal, k_along_first, k_along_second, k_about_normal, k_about_first, k_about_second, k_parts };

/// Where the pair's response to part `k` shows in part `i`.
constexpr int response_index(int i, int k) { return i < k ? k * (k + 1) / 2 + i : i * (i + 1) / 2 + k; }

constexpr int k_responses = response_index(k_parts - 1, k_parts - 1) + 1;

/// The motions of two bodies as mantissas of one block.
struct PairMotion {
  Block block;
  Mantissas way, spin_a, spin_b;

  PairMotion(const Block& room, const Vec3<Real>& relative, const Vec3<Real>& of_a, const Vec3<Real>& of_b,
             int exponent)
      : block(room) {
    block.include(relative, 0);
    block.include(of_a, exponent);
    block.include(of_b, exponent);
    way = block.mantissas(relative, 0);
    spin_a = block.mantissas(of_a, exponent);
    spin_b = block.mantissas(of_b, exponent);
  }

  Ulps along_normal(const ContactWork& contact) const {
    return rounded(dot(way, contact.normal) + (dot(spin_b, contact.lever_b) - dot(spin_a, contact.lever_a)));
  }
  /// Relative velocity of the middle, world axes.
  Mantissas at_middle(const ContactWork& contact) const {
    const Vec3<Unit>&a = contact.middle_a, &b = contact.middle_b;
    const Unit one = 1.0;
    return rounded(
        product(way.x, one) + (cross_part(spin_b.y, b.z, spin_b.z, b.y) - cross_part(spin_a.y, a.z, spin_a.z, a.y)),
        product(way.y, one) + (cross_part(spin_b.z, b.x, spin_b.x, b.z) - cross_part(spin_a.z, a.x, spin_a.x, a.z)),
        product(way.z, one) + (cross_part(spin_b.x, b.y, spin_b.y, b.x) - cross_part(spin_a.x, a.y, spin_a.y, a.x)));
  }
  /// Relative spin, world axes.
  Mantissas turning(const ContactWork& contact) const {
    const Unit a = contact.unit_a, b = contact.unit_b;
    return rounded(product(spin_b.x, b) - product(spin_a.x, a), product(spin_b.y, b) - product(spin_a.y, a),
                   product(spin_b.z, b) - product(spin_a.z, a));
  }

 private:
  static UlpSum cross_part(Factor p, Unit q, Factor r, Unit s) { return product(p, q) - product(r, s); }
};

/// The part of a pair's motion that its points show along the normal.
struct NormalMotion {
  Ulps along;
  Factor about_first, about_second;

  NormalMotion(Ulps normal, Factor first, Factor second) : along(normal), about_first(first), about_second(second) {}
  NormalMotion(const PairMotion& motion, const ContactWork& contact) : along(motion.along_normal(contact)) {
    const Mantissas turning = motion.turning(contact);
    about_first = held(rounded(dot(turning, contact.tangent[0])));
    about_second = held(rounded(dot(turning, contact.tangent[1])));
  }
  Ulps at(const ContactPoint& point) const {
    return along + rounded(product(about_first, point.y) - product(about_second, point.x));
  }
};

/// What contacts have added to a body's motion in this substep. Fixed point takes the difference from the start of the
/// substep, which is exact; float keeps a sum, which does not lose a small push to a high speed.
inline Vec3<Real> added_by_contacts(const Vec3<Real>& motion, const Vec3<Real>& kept) {
  return DETENT_FIXED ? motion + kept : kept;
}
/// What to keep from a motion that contacts have not acted on yet.
inline Vec3<Real> kept_at_start(const Vec3<Real>& motion) {
  const Real zero = 0.0;
  return DETENT_FIXED ? -motion : Vec3<Real>{zero, zero, zero};
}

/// A body that impulses act on: its spin is kept beside its momentum.
struct PushedBody {
  BodyMotion& motion;
  BodyWork& work;
};

/// Adds `force` and `torque`, the latter in the body's unit of length, times `share`, or takes them away.
template <bool adds>
inline void push(const Block& block, const Mantissas& force, const Mantissas& torque, Scaled share,
                 const PushedBody& body) {
  const WorldGyration& gyration = body.work.gyration;
  const Mantissas turned =
      rounded(dot(torque, gyration.row[0]), dot(torque, gyration.row[1]), dot(torque, gyration.row[2]));
  const auto add = [](Vec3<Real>& to, const Vec3<Real>& more) {
    if constexpr (adds)
      to += more;
    else
      to -= more;
  };
  const Vec3<Real> velocity = block.real(force, share, 0), momentum = block.real(torque, share, 0);
  add(body.motion.velocity, velocity);
  add(body.motion.momentum, momentum);
  add(body.work.spin, block.real(turned, share, gyration.exponent - k_spin_power));
  if constexpr (!DETENT_FIXED) {
    add(body.work.contact_velocity, velocity);
    add(body.work.contact_momentum, momentum);
  }
}

inline bool takes_impulses(Scaled share) { return is_positive(share); }

/// Applies an impulse along the normal at the middle, and one about each tangent, to B, and their opposite to A.
inline void apply_normal(const ContactWork& contact, Block block, Ulps along, Ulps about_first, Ulps about_second,
                         const PushedBody& a, const PushedBody& b) {
  Ulps sum[3] = {along, about_first, about_second};
  block.coarsen(sum);
  const Factor part[3] = {held(sum[0]), held(sum[1]), held(sum[2])};
  const Vec3<Unit>&n = contact.normal, &t = contact.tangent[0], &s = contact.tangent[1];
  const Mantissas force = rounded(product(part[0], n.x), product(part[0], n.y), product(part[0], n.z));
  const Mantissas turn =
      rounded(product(part[1], t.x) + product(part[2], s.x), product(part[1], t.y) + product(part[2], s.y),
              product(part[1], t.z) + product(part[2], s.z));
  const auto torque = [&](const Vec3<Unit>& lever, Unit unit) {
    return rounded(product(part[0], lever.x) + product(turn.x, unit), product(part[0], lever.y) + product(turn.y, unit),
                   product(part[0], lever.z) + product(turn.z, unit));
  };
  if (takes_impulses(contact.share_a)) {
    push<false>(block, force, torque(contact.lever_a, contact.unit_a), contact.share_a, a);
  }
  if (takes_impulses(contact.share_b)) {
    push<true>(block, force, torque(contact.lever_b, contact.unit_b), contact.share_b, b);
  }
}

/// Applies a wrench at the middle to B, and its opposite to A.
inline void apply_wrench(const ContactWork& contact, Block block, const Ulps (&wrench)[k_parts], const PushedBody& a,
                         const PushedBody& b) {
  Ulps sum[k_parts];
  DETENT_UNROLL
  for (int i = 0; i < k_parts; ++i) sum[i] = wrench[i];
  block.coarsen(sum);
  Factor part[k_parts];
  DETENT_UNROLL
  for (int i = 0; i < k_parts; ++i) part[i] = held(sum[i]);
  const Vec3<Unit>&n = contact.normal, &t = contact.tangent[0], &s = contact.tangent[1];
  const auto in_world = [&](int first) {
    const auto along = [&](Unit x, Unit y, Unit z) {
      return product(part[first], x) + product(part[first + 1], y) + product(part[first + 2], z);
    };
    return rounded(along(n.x, t.x, s.x), along(n.y, t.y, s.y), along(n.z, t.z, s.z));
  };
  const Mantissas force = in_world(k_along_normal), turn = in_world(k_about_normal);
  const auto torque = [&](const Vec3<Unit>& arm, Unit unit) {
    return rounded(product(force.z, arm.y) - product(force.y, arm.z) + product(turn.x, unit),
                   product(force.x, arm.z) - product(force.z, arm.x) + product(turn.y, unit),
                   product(force.y, arm.x) - product(force.x, arm.y) + product(turn.z, unit));
  };
  if (takes_impulses(contact.share_a)) {
    push<false>(block, force, torque(contact.middle_a, contact.unit_a), contact.share_a, a);
  }
  if (takes_impulses(contact.share_b)) {
    push<true>(block, force, torque(contact.middle_b, contact.unit_b), contact.share_b, b);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
