#include "solver/contact_rows.h"

#include "base/cycle.h"
#include "base/unroll.h"
#include "math/root.h"
#include "motion/angular_velocity.h"
#include "motion/contact_motion.h"
#include "motion/inverse_inertia.h"
#include "shape/shape_properties.h"
#include "solver/contact_arms.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The exponent of mantissas for values up to `value`, such that a sum of four mantissas fits. It is at most 19,
/// because of the range of Real, and always 0 in float.
int32_t exponent_for(Real value) { return DETENT_FIXED ? exponent_above(value) + 2 : 0; }

#if DETENT_FIXED
static_assert(63 - k_real_frac + 2 <= 22);  // with larger exponents the products of a contact exceed 53 bits
/// The factor that converts mantissas of values / 2^exponent to raw Reals. A multiplication costs less than a shift of
/// each mantissa. Range: the conversion must not drop bits of a mantissa.
uint64_t real_power(int exponent) {
  DETENT_VERIFY_RANGE(exponent >= k_unit_frac - k_real_frac);
  return static_cast<uint64_t>(shift_64(1, exponent + k_real_frac - k_unit_frac));
}
Real real_part(Unit mantissa, uint64_t power) {
  return Real::from_raw(static_cast<int64_t>(static_cast<uint64_t>(int64_t{mantissa.raw}) * power));
}
#else
uint64_t real_power(int) { return 1; }
#endif
Real real_part(Real value, uint64_t) { return value; }

/// Adds one body's part of K = J M^-1 J^T to `response`. In the frame of the contact, e_i are the axes (n, t, s), r the
/// arm, G (`turning`) the inverse inertia of the body, u (`unit`) the pair's unit of length in units of the body, and
/// `share` the relative inverse mass:
///
///     linear i, linear k:   share (delta_ik + (r x e_i) . G (r x e_k))
///     angular i, linear k:  share u e_i . G (r x e_k)
///     angular i, angular k: share u^2 G_ik
///
/// The elements of `turning` are Reals with `exponent` 0, or mantissas of values / 2^exponent.
template <class Number>
void add_response(const ContactWork& work, const Number (&turning)[3][3], int exponent, const Vec3<Unit>& arm,
                  Unit unit, Scaled share, PairResponse& response) {
  const Unit along[3] = {dot(arm, work.normal), dot(arm, work.tangent[0]), dot(arm, work.tangent[1])};
  const bool whole = share == Scaled(1.0);
  const uint64_t power = real_power(exponent);
  const auto add_part = [&](int i, int k, Number part, bool moves) {
    Real value = real_part(part, power);
    if (moves) value += Real(1.0);
    response.part[response_index(i, k)] += whole ? value : multiply(value, share);
  };
  DETENT_UNROLL
  for (int k = 0; k < 3; ++k) {
    // r x e_k only has components along the two other axes.
    const int next = next_of_three(k), last = previous_of_three(k);
    Number angular_velocity[3];
    DETENT_UNROLL
    for (int i = 0; i < 3; ++i) {
      angular_velocity[i] = turning[i][next] * along[last] - turning[i][last] * along[next];
      add_part(i + 3, k, angular_velocity[i] * unit, false);
    }
    DETENT_UNROLL
    for (int i = 0; i < 3; ++i) {
      if (i > k) continue;
      const int after = next_of_three(i), before = previous_of_three(i);
      add_part(i, k, angular_velocity[after] * along[before] - angular_velocity[before] * along[after], i == k);
      add_part(i + 3, k + 3, (turning[i][k] * unit) * unit, false);
    }
  }
}

PairResponse respond(const WorldInverseInertia& a, const WorldInverseInertia& b, const ContactWork& work) {
  PairResponse response = {};
  const auto add_body = [&](const WorldInverseInertia& inverse_inertia, const Vec3<Unit>& arm, Unit unit,
                            Scaled share) {
    if (!is_positive(share)) return;
    const Vec3<Unit>* const axis[3] = {&work.normal, &work.tangent[0], &work.tangent[1]};
    Unit turning[3][3];
    DETENT_UNROLL
    for (int k = 0; k < 3; ++k) {
      const Vec3<Unit> turned = multiply(inverse_inertia, *axis[k]);
      for (int i = 0; i <= k; ++i) turning[i][k] = turning[k][i] = dot(*axis[i], turned);
    }
    add_response(work, turning, inverse_inertia.exponent, arm, unit, share, response);
  };
  add_body(a, work.middle_a, work.unit_a, work.inverse_mass_a);
  add_body(b, work.middle_b, work.unit_b, work.inverse_mass_b);
  return response;
}

/// Effective mass 1 / K divided by the reference mass. `response` is K times the reference mass. A response is at least
/// 1, except for rounding, because the relative inverse mass of the lighter body is 1.
Unit mass_of(Real response) {
  if (!(response > Real(1.0))) return 1.0;
#if DETENT_FIXED
  // 2^(2 x 30) divided by the response as a mantissa of 31 bits.
  const int power = bit_length_64(magnitude_64(response.raw)) - 31;
  const uint64_t quotient = (uint64_t{1} << 60) / static_cast<uint64_t>(response.raw >> power);
  return Unit::from_raw(
      static_cast<int32_t>(shift_64(static_cast<int64_t>(quotient), k_real_frac - k_unit_frac - power)));
#else
  return Real(1.0) / response;
#endif
}
Scaled angular_mass_of(Real response) {
  return response > Real(0.0) ? divide(Scaled(1.0), scaled_from(response)) : Scaled(0.0);
}

/// The greatest eigenvalue of the 2 x 2 response of the parts i and i + 1 of the motion to each other. It is computed
/// from mantissas of the responses / 2^exponent.
Real greatest_response(const PairResponse& response, int exponent, Part i) {
  const Real* const row = response.part + response_index(i + 1, i);
  const Unit first = unit_from_real(response.part[response_index(i, i)], exponent);
  const Unit second = unit_from_real(row[1], exponent), both = unit_from_real(row[0], exponent);
  const Unit apart = scale_by_power(first - second, -1);
  const Unit root = both == Unit(0.0) ? abs(apart) : length(Vec3<Unit>{apart, both, Unit(0.0)});
  return real_from_unit(scale_by_power(first + second, -1) + root, exponent);
}

/// Computes the matrix K that couples the normal rows of a contact's points, and the effective mass 1 / K_ii of each
/// point. A unit impulse of row i is the wrench j_i = (1, y_i, -x_i) at the middle of the points: an impulse along the
/// normal, and angular impulses about the first and the second tangent. With the response R to these parts of a wrench,
/// K_ik = j_i R j_k^T.
void couple(const PairResponse& response, ContactWork& work) {
  const auto part = [&](Part i, Part k) { return response.part[response_index(i, k)]; };
  const uint32_t count = work.state.point_count;
  Real coupling[k_manifold_points_max][k_manifold_points_max];
  Real most = 1.0;
  for (uint32_t i = 0; i < count; ++i) {
    const auto shows = [&](Part in) {
      return part(in, k_along_normal) + (part(in, k_about_first) * work.y[i] - part(in, k_about_second) * work.x[i]);
    };
    const Real along = shows(k_along_normal), first = shows(k_about_first), second = shows(k_about_second);
    for (uint32_t k = 0; k <= i; ++k) {
      const Real sum = along + (first * work.y[k] - second * work.x[k]);
      coupling[i][k] = coupling[k][i] = sum;
      most = max(most, abs(sum));
    }
    work.normal_mass[i] = fine(mass_of(coupling[i][i]));
  }
  work.coupling_exponent = exponent_for(most);
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t k = 0; k < k_manifold_points_max; ++k)
      work.coupling[i][k] = k < count ? fine(unit_from_real(coupling[i][k], work.coupling_exponent)) : Unit(0.0);
  }
}

/// Two tangents that form a right-handed frame with the normal.
/// Source: Duff and others, "Building an Orthonormal Basis, Revisited", JCGT 2017.
void make_tangents(const Vec3<Unit>& n, Vec3<Unit> tangent[2]) {
  const Unit zero = 0.0, one = 1.0;
  const bool down = n.z < zero;
#if DETENT_FIXED
  const uint64_t sum = static_cast<uint64_t>(one.raw) + magnitude_32(n.z.raw);
  const Unit part = Unit::from_raw(static_cast<int32_t>(((uint64_t{1} << 60) + sum / 2) / sum));
#else
  const Unit part = one / (one + abs(n.z));
#endif
  const Unit both = zero - (n.x * n.y) * part;
  const Unit first = one - (n.x * n.x) * part, second = one - (n.y * n.y) * part;
  tangent[0] = {first, both, down ? n.x : zero - n.x};
  tangent[1] = {down ? zero - both : both, down ? zero - second : second, zero - n.y};
}

/// The geometric mean of two coefficients.
Scaled geometric_mean(Scaled a, Scaled b) {
  if (a == b) return a;
  return is_positive(a) && is_positive(b) ? square_root(multiply(a, b)) : Scaled(0.0);
}

Scaled pair_restitution(const BodyProperties& a, const BodyProperties& b) {
  constexpr uint32_t k_smaller = static_cast<uint32_t>(RestitutionRule::smaller);
  const bool smaller = a.restitution_rule == k_smaller || b.restitution_rule == k_smaller;
  return less(a.restitution, b.restitution) == smaller ? a.restitution : b.restitution;
}

/// Sets the relative inverse masses: the reference mass over the mass of the body; 0 for a body that is not dynamic.
void share_mass(const BodyProperties& a, const BodyProperties& b, ContactWork& work) {
  const Scaled none = 0.0, one = 1.0;
  const bool dynamic_a = is_dynamic(a), dynamic_b = is_dynamic(b);
  work.inverse_mass_a = dynamic_a ? one : none;
  work.inverse_mass_b = dynamic_b ? one : none;
  work.static_pair = dynamic_a && dynamic_b ? 0 : 1;
  if (!dynamic_a || !dynamic_b || a.mass == b.mass) return;
  if (less(a.mass, b.mass))
    work.inverse_mass_b = divide(a.mass, b.mass);
  else
    work.inverse_mass_a = divide(b.mass, a.mass);
}

/// Sets `unit_a` and `unit_b`: the pair's unit of length, measured in the unit of each body. Returns the exponent of
/// the pair's unit, which is 2^exponent m.
int32_t share_length(const BodyProperties& a, const BodyProperties& b, ContactWork& work) {
  const bool moves_a = type_of(a) != BodyType::fixed, moves_b = type_of(b) != BodyType::fixed;
  int32_t unit = moves_a ? a.size_exponent : b.size_exponent;
  if (moves_b && b.size_exponent < unit) unit = b.size_exponent;
  const auto in_unit_of = [unit](bool moves, const BodyProperties& body) {
    return moves ? fine(scale_by_power(Unit(1.0), unit - body.size_exponent)) : Unit(0.0);
  };
  work.unit_a = in_unit_of(moves_a, a);
  work.unit_b = in_unit_of(moves_b, b);
  return unit;
}

Real gravity_along(const StepSettings& settings, const BodyProperties& body, const Vec3<Unit>& normal) {
  bool saturated = false;
  if (!is_dynamic(body)) return 0.0;
  const Real whole = dot(settings.gravity, normal);
  return body.gravity_scale == Scaled(1.0) ? whole : multiply(whole, body.gravity_scale, saturated);
}

/// The normal velocity that an approaching point will have when it touches: -sqrt(v^2 - 2 pull s). v (`velocity`) < 0
/// is its current normal velocity, m/s; s (`separation`) is the gap, m; `pull` < 0 is the relative acceleration along
/// the normal, m/s^2. With this value, a ball with restitution 1 bounces to the height from which it fell.
Real approach_at_touch(Real velocity, Real separation, Real pull) {
  // Above 256 m/s the acceleration over a gap is negligible, and squares leave the range of Real.
  const Real zero = 0.0, fast = 256.0;
  if (!(velocity < zero && velocity > -fast && separation > zero && pull < zero && pull > -fast)) return velocity;
  const Real gain = scale_by_power(pull * min(separation, Real(64.0)), 1);
  return -square_root(velocity * velocity - gain);
}

/// The growth, m, of the gap of two round bodies in a tick, because the contact normal rotates while they slide past
/// each other. Returns s^2 / D, twice the second-order term of the gap. s is the relative tangential displacement of
/// the centres of curvature in the tick; D is the distance of these centres. Without this growth, the solver would stop
/// bodies that only pass each other, because it uses the normal at the start of the tick.
__attribute__((noinline)) Real parted_by_sliding(const StepSettings& settings, const RowBody& a, const RowBody& b,
                                                 const Vec3<Unit>& normal, const ContactGeometryPoint& point) {
  const Unit round_a = round_radius(a.properties), round_b = round_radius(b.properties);
  // The velocity of a body's centre of curvature. `away`: direction from the other body to this body. `arm` ends in the
  // middle of the gap.
  const auto velocity_of = [&](const RowBody& body, const Vec3<Unit>& arm, const Vec3<Unit>& away, Unit round) {
    const int unit = body.properties.size_exponent;
    const Real half_gap = min(scale_by_power(point.separation, -1), real_from_unit(Unit(1.0), unit));
    const Vec3<Real> turning = cross(body.angular_velocity, arm + away * (round + unit_from_real(half_gap, unit)));
    return body.motion.linear_velocity + scale_by_power(turning, k_angular_velocity_power);
  };
  const Vec3<Real> velocity =
      velocity_of(b, point.arm_b, normal, round_b) - velocity_of(a, point.arm_a, -normal, round_a);
  const Vec3<Real> across = velocity - normal * dot(velocity, normal);
  const Real distance = real_from_unit(round_a, a.properties.size_exponent) +
                        real_from_unit(round_b, b.properties.size_exponent) + point.separation;
  // The displacement is limited to 16 D, so that the result fits a Real.
  const Real displacement = min(length(across) * settings.tick_time, scale_by_power(distance, 4));
  return displacement * divide(displacement, distance);
}

/// The weight 1 / count of each of `count` points in a mean.
Unit share_of_points(uint32_t count) {
  constexpr Unit k_share[k_manifold_points_max] = {1.0, 0.5, 1.0 / 3.0, 0.25};
  return k_share[count - 1];
}

Vec3<Unit> mean(const ContactGeometry& geometry, Vec3<Unit> ContactGeometryPoint::*arm) {
  const Unit share = share_of_points(geometry.count);
  Vec3<Unit> sum = {0.0, 0.0, 0.0};
  for (uint32_t i = 0; i < geometry.count; ++i) sum += geometry.point[i].*arm * share;
  return sum;
}

/// Sets the coordinates of the points along the tangents, relative to the middle of the points. `arm` is the arm of the
/// body whose unit of length is the pair's. Returns the root mean square of the distances from the middle.
Unit place_points(const ContactGeometry& geometry, Vec3<Unit> ContactGeometryPoint::*arm, const Vec3<Unit>& middle,
                  ContactWork& work) {
  const Unit share = share_of_points(geometry.count);
  Unit sum = 0.0;  // a quarter of the mean square
  for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
    work.x[i] = work.y[i] = work.normal_mass[i] = Unit(0.0);
    if (i >= geometry.count) continue;
    const Vec3<Unit> offset = geometry.point[i].*arm - middle;
    const Vec3<Unit> place = fine_arm({dot(offset, work.tangent[0]), dot(offset, work.tangent[1]), Unit(0.0)});
    work.x[i] = place.x;
    work.y[i] = place.y;
    const Unit x = scale_by_power(work.x[i], -1), y = scale_by_power(work.y[i], -1);
    sum += (x * x + y * y) * share;
  }
  return scale_by_power(square_root(max(sum, Unit(0.0))), 1);
}

/// Rotates the points about the normal by a small angle, rad, to first order.
void rotate_points(Unit angle, ContactWork& work) {
  for (uint32_t i = 0; i < work.state.point_count; ++i) {
    const Unit x = work.x[i], y = work.y[i];
    const Vec3<Unit> place = fine_arm({x - angle * y, y + angle * x, Unit(0.0)});
    work.x[i] = place.x;
    work.y[i] = place.y;
  }
}

}  // namespace

void renew_response(const WorldInverseInertia& a, const WorldInverseInertia& b, ContactWork& work) {
  const PairResponse response = respond(a, b, work);
  const auto own = [&](Part part) { return response.part[response_index(part, part)]; };
  Real most = 1.0;
  for (const Real& part : response.part) most = max(most, abs(part));
  work.response_exponent = exponent_for(most);
  for (int i = 0; i < k_responses; ++i)
    work.response[i] = fine(unit_from_real(response.part[i], work.response_exponent));
  couple(response, work);
  work.friction_mass = fine(mass_of(greatest_response(response, work.response_exponent, k_along_first)));
  const Scaled none = 0.0;
  work.twist_mass = work.angular_rows != 0 ? fine(angular_mass_of(own(k_about_normal))) : none;
  work.rolling_mass = work.angular_rows == 3
                          ? fine(angular_mass_of(greatest_response(response, work.response_exponent, k_about_first)))
                          : none;
}

void make_rows(const StepSettings& settings, const RowBody& a, const RowBody& b, const ContactGeometry& geometry,
               Real ahead, ContactWork& work) {
  work.normal = fine(geometry.normal);
  make_tangents(work.normal, work.tangent);
  for (Vec3<Unit>& tangent : work.tangent) tangent = fine(tangent);
  share_mass(a.properties, b.properties, work);
  const int32_t unit = share_length(a.properties, b.properties, work);
  Vec3<Unit> middle_a = mean(geometry, &ContactGeometryPoint::arm_a);
  Vec3<Unit> middle_b = mean(geometry, &ContactGeometryPoint::arm_b);
  const Unit patch = work.unit_a == Unit(1.0) ? place_points(geometry, &ContactGeometryPoint::arm_a, middle_a, work)
                                              : place_points(geometry, &ContactGeometryPoint::arm_b, middle_b, work);
  if (ahead != k_zero) rotate_points(advance_arms(a, b, work.normal, ahead, middle_a, middle_b), work);
  work.middle_a = fine_arm(middle_a);
  work.middle_b = fine_arm(middle_b);
  work.moment_a = fine_arm(cross(work.middle_a, work.normal));
  work.moment_b = fine_arm(cross(work.middle_b, work.normal));

  work.friction = fine(geometric_mean(a.properties.friction, b.properties.friction));
  work.restitution = pair_restitution(a.properties, b.properties);
  const Scaled &rolls_a = a.properties.rolling_resistance, &rolls_b = b.properties.rolling_resistance;
  const Scaled rolling = less(rolls_a, rolls_b) ? rolls_b : rolls_a;
  const Real extent = min(a.extent, b.extent);
  work.rolling_arm = Scaled(0.0);
  if (is_positive(rolling)) work.rolling_arm = fine(multiply(rolling, scaled_by_power(scaled_from(extent), -1 - unit)));
  work.twist_arm = fine(add(multiply(work.friction, scaled_from(patch)), work.rolling_arm));
  work.angular_rows = is_positive(work.rolling_arm) ? 3 : is_positive(work.twist_arm) ? 1 : 0;

  renew_response(a.inverse_inertia, b.inverse_inertia, work);

  const Real pull =
      gravity_along(settings, b.properties, work.normal) - gravity_along(settings, a.properties, work.normal);
  const PairMotion<One> motion(Block(), b.motion.linear_velocity - a.motion.linear_velocity, a.angular_velocity,
                               b.angular_velocity, k_angular_velocity_power);
  const NormalMotion<One> start(motion, work);
  const bool is_round = geometry.turns && !a.jointed && !b.jointed &&
                        (round_radius(a.properties) > Unit(0.0) || round_radius(b.properties) > Unit(0.0));
  for (uint32_t i = 0; i < geometry.count; ++i) {
    const ContactGeometryPoint& point = geometry.point[i];
    work.separation[i] = point.separation;
    if (is_round && point.separation > Real(0.0))
      work.separation[i] += parted_by_sliding(settings, a, b, work.normal, point);
    work.approach[i] = approach_at_touch(motion.block.real(start.at(work, i)), work.separation[i], pull);
    work.impulse_max[i] = Real(0.0);
  }
  for (int i = 0; i < 2; ++i) work.friction_impulse[i] = dot(work.state.friction_impulse, work.tangent[i]);

  const Vec3<Unit>* axes[3] = {&work.normal, &work.tangent[0], &work.tangent[1]};
  for (uint32_t i = 0; i < 3; ++i) {
    work.angular_impulse[i] = Real(0.0);
    if (i >= work.angular_rows) continue;
    work.angular_impulse[i] = dot(work.state.angular_impulse, *axes[i]);
  }
  // The limits of speed below are multiples of the fall_speed() of the smaller body's extent.
  const Real fall = min(a.fall, b.fall);
  work.deep = scale_by_power(extent, -6);
  work.push_max = scale_by_power(fall, -1);
  work.rebound_min = settings.restitution_threshold * fall;
}

void leave_to_impact(const StepSettings& settings, const RowBody& a, const RowBody& b, ContactWork& work) {
  if (!settings.continuous || !is_positive(work.restitution) || a.jointed || b.jointed) return;
  const Real touching = -scale_by_power(min(a.extent, b.extent), -10);
  bool rebounds = false;
  for (uint32_t i = 0; i < work.state.point_count; ++i) {
    if (work.separation[i] < touching) return;
    rebounds = rebounds || work.approach[i] <= -work.rebound_min;
  }
  if (!rebounds) return;
  for (Unit& mass : work.normal_mass) mass = Unit(0.0);
}

PairResponse respond_exactly(const BodyProperties& a, const Quat& rotation_a, const BodyProperties& b,
                             const Quat& rotation_b, const ContactWork& work) {
  PairResponse response = {};
  const auto add_body = [&](const BodyProperties& properties, const Quat& rotation, const Vec3<Unit>& arm, Unit unit,
                            Scaled share) {
    if (!is_positive(share)) return;
    const Vec3<Unit>* const axis[3] = {&work.normal, &work.tangent[0], &work.tangent[1]};
    Real turning[3][3];
    for (int k = 0; k < 3; ++k) {
      const Vec3<Real> angular_momentum = {real_from_unit(axis[k]->x, 0), real_from_unit(axis[k]->y, 0),
                                           real_from_unit(axis[k]->z, 0)};
      const Vec3<Real> turned = angular_velocity_of(properties, rotation, angular_momentum);
      for (int i = 0; i <= k; ++i) turning[i][k] = turning[k][i] = dot(turned, *axis[i]);
    }
    add_response(work, turning, 0, arm, unit, share, response);
  };
  add_body(a, rotation_a, work.middle_a, work.unit_a, work.inverse_mass_a);
  add_body(b, rotation_b, work.middle_b, work.unit_b, work.inverse_mass_b);
  return response;
}

void store_impulses(ContactWork& work) {
  work.state.friction_impulse = work.tangent[0] * work.friction_impulse[0] + work.tangent[1] * work.friction_impulse[1];
  work.state.angular_impulse = work.normal * work.angular_impulse[0] + work.tangent[0] * work.angular_impulse[1] +
                               work.tangent[1] * work.angular_impulse[2];
}

bool keeps_apart(const ContactWork& contact, const Vec3<Real>& displacement_a, const Vec3<Real>& rotation_vector_a,
                 const Vec3<Real>& displacement_b, const Vec3<Real>& rotation_vector_b, Real depth) {
  Block room;
  room.include(contact.separation, contact.state.point_count);
  const PairMotion<One> moved(room, displacement_b - displacement_a, rotation_vector_a, rotation_vector_b, 0);
  const NormalMotion<One> displacement(moved, contact);
  for (uint32_t i = 0; i < contact.state.point_count; ++i) {
    const Real least = -depth - max(contact.separation[i], k_zero);
    if (displacement.at(contact, i) < moved.block.held(least)) return false;
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
