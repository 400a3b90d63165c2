#if !defined(DETENT_VERIFY)
#define DETENT_VERIFY 1  // a sum that does not fit a double traps (fits_double() in lib/motion/block.h)
#endif
#include <math.h>
#include <string.h>

#include "solver/contact_solver.h"
#include "solver/solve_lanes.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"

// Compares the passes over up to eight contacts at once with those over one, on rows, impulses and motions at the ends
// of their ranges. `--gtest_repeat=100` gives millions of contacts, of other numbers in each repetition.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_groups = 25000;

struct Rows : Samples {
  bool full = false;      ///< all numbers are close to the ends of their ranges
  bool apart = false;     ///< the points are far apart, and the bodies approach faster than they move
  uint32_t lengths = 60;  ///< speeds and impulses are below 2^(lengths - 46) m/s

  Unit positive(Unit value) { return value < Unit(0.0) ? -value : value; }
  /// 1 - 2^-5 < |.| <= 1 if full.
  Unit part() {
    if (!full) return fraction();
    const Unit little = scale_by_power(positive(uniform()), -5);
    return below(2) == 0 ? Unit(1.0) - little : little - Unit(1.0);
  }
  static Unit unit_from(double value) {
#if DETENT_FIXED
    return Unit::from_raw(static_cast<int32_t>(fmin(fmax(value, -1.999999), 1.999999) * 0x1p30));
#else
    return static_cast<Unit>(value);
#endif
  }
  /// Three orthogonal vectors of this length.
  void frame(double length, Vec3<Unit> (&axes)[3]) {
    double q[4], square = 0;
    for (double& part : q) {
      part = static_cast<double>(static_cast<int32_t>(bits() >> 32)) + 0.5;
      square += part * part;
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3], two = 2 * length / square;
    axes[0] = {unit_from(length - two * (y * y + z * z)), unit_from(two * (x * y - w * z)),
               unit_from(two * (x * z + w * y))};
    axes[1] = {unit_from(two * (x * y + w * z)), unit_from(length - two * (x * x + z * z)),
               unit_from(two * (y * z - w * x))};
    axes[2] = {unit_from(two * (x * z - w * y)), unit_from(two * (y * z + w * x)),
               unit_from(length - two * (x * x + y * y))};
  }
  /// |.| < 2.
  Vec3<Unit> arm() {
    Vec3<Unit> axes[3];
    frame(full ? 1.99999 : 1.99999 * below(1u << 20) / (1 << 20), axes);
    return fine_arm(axes[0]);
  }
  Unit power() { return full ? Unit(1.0) : fine(scale_by_power(Unit(1.0), -static_cast<int>(below(25)))); }
  Scaled scaled(int exponent_least, uint32_t exponents) {
    const int exponent = exponent_least + static_cast<int>(below(exponents));
#if DETENT_FIXED
    if (below(8) == 0) return Scaled(0.0);
    return Scaled::from_parts(static_cast<int32_t>((1u << 30) | bits() >> 34), exponent - 30);
#else
    return scale_by_power(positive(uniform()), exponent);
#endif
  }
  Real number(int length) { return full ? scale_by_power(real_from_unit(part(), 0), length - 46) : real(length); }
  /// A length, speed or impulse of any magnitude.
  Real number(uint32_t most = 60) { return number(static_cast<int>(full ? 50 : below(most))); }
  Real impulse() { return number(lengths); }
  Real zero() { return DETENT_FIXED || below(2) == 0 ? k_zero : -k_zero; }
  Vec3<Real> vector(uint32_t most = 60) {
    if (!full && below(8) == 0) return {zero(), zero(), zero()};
    const int length = static_cast<int>(full ? 50 : below(most));
    return {number(length), number(length), number(length)};
  }

  void fill(uint32_t points, uint32_t angular_rows, bool fixed_a, ContactWork& work) {
    work.state.point_count = static_cast<uint8_t>(points);
    work.angular_rows = angular_rows;
    Vec3<Unit> axes[3];
    frame(1, axes);
    work.normal = fine(axes[0]);
    for (int i = 0; i < 2; ++i) work.tangent[i] = fine(axes[i + 1]);
    for (Vec3<Unit>* const lever : {&work.moment_a, &work.moment_b, &work.middle_a, &work.middle_b}) *lever = arm();
    work.unit_a = fixed_a ? Unit(0.0) : power();
    work.unit_b = power();
    work.inverse_mass_a = fixed_a ? Scaled(0.0) : Scaled(1.0);
    work.inverse_mass_b = below(2) == 0 ? Scaled(1.0) : scaled(-20, 20);
    work.static_pair = fixed_a ? 1 : 0;
    work.coupling_exponent = DETENT_FIXED ? static_cast<int32_t>(below(23)) : 0;
    work.response_exponent = DETENT_FIXED ? static_cast<int32_t>(below(23)) : 0;
    const Unit least = DETENT_FIXED ? Unit(0.0) : Unit(0.125);
    const auto has_point = [points](uint32_t i) { return i < points; };
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      const Vec3<Unit> place = arm();
      work.x[i] = has_point(i) ? place.x : Unit(0.0);
      work.y[i] = has_point(i) ? place.y : Unit(0.0);
      work.normal_mass[i] = has_point(i) && below(8) != 0 ? fine(positive(part())) : Unit(0.0);
      for (uint32_t k = 0; k <= i; ++k) {
        // A sum of four of them fits. In float only a definite matrix has finite results.
        const bool own = i == k;
        const Unit between = scale_by_power(part(), DETENT_FIXED || own ? -2 : -6);
        work.coupling[i][k] = work.coupling[k][i] = !has_point(i) || !has_point(k) ? Unit(0.0)
                                                    : own                          ? fine(positive(between) + least)
                                                                                   : fine(between);
      }
      work.state.normal_impulse[i] = has_point(i) ? max(impulse(), k_zero) : k_zero;
      work.impulse_max[i] = work.state.normal_impulse[i];
      work.separation[i] = apart ? Real(16.0) : number();
    }
    for (uint32_t i = points; i < k_manifold_points_max; ++i) {
      for (Unit& unused : work.coupling[i]) unused = part();
    }
    for (Unit& response : work.response) response = fine(part());
    work.friction_mass = fine(positive(part()));
    for (Scaled* const factor :
         {&work.friction, &work.twist_arm, &work.rolling_arm, &work.twist_mass, &work.rolling_mass})
      *factor = fine(scaled(-30, DETENT_FIXED ? 60 : 31));
    for (Real& accumulated : work.friction_impulse) accumulated = impulse();
    for (uint32_t i = 0; i < 3; ++i) work.angular_impulse[i] = i < angular_rows ? impulse() : k_zero;
    work.push_max = apart ? abs(number(50)) : max(number(), k_zero);
  }
  void fill(BodyMotion& motion, BodyWork& work) {
    motion.linear_velocity = vector(lengths);
    motion.angular_momentum = vector(lengths);
    work.angular_velocity = vector(lengths);
    work.displacement = vector(apart ? 50 : 60);
    work.rotation_vector = vector(lengths);
    work.contact_velocity = vector();
    work.contact_angular_momentum = vector();
    frame(full ? 1 : 1.0 / (1 + below(1000)), work.inverse_inertia.row);
    work.inverse_inertia.exponent = DETENT_FIXED ? static_cast<int32_t>(below(21)) - 10 : 0;
  }
};

/// Contacts that are solved at once, each of two bodies.
struct Group {
  uint32_t count = lanes_of_machine();
  BodyProperties properties[16] = {};
  BodyMotion motions[16] = {};
  BodyWork work[16] = {};
  ContactWork contacts[8] = {};
  ContactOrder order[8] = {};
  LaneSpace lanes[2] = {};

  SolverBodies bodies() { return {{properties, 16}, {motions, 16}, {work, 16}}; }
  void fill(Rows& rows) {
    count = 2 + rows.below(lanes_of_machine() - 1);
    rows.apart = rows.below(3) == 0;
    rows.lengths = rows.apart ? 36 : 60;
    const bool single = rows.below(4) == 0;
    const uint32_t angular_rows = rows.below(3);
    uint32_t points = single ? 1 : 2;
    for (uint32_t i = 0; i < 2 * count; ++i) rows.fill(motions[i], work[i]);
    for (uint32_t i = 0; i < count; ++i) {
      if (!single && points < k_manifold_points_max) points += rows.below(2);
      contacts[i].state.body_a = 2 * i;
      contacts[i].state.body_b = 2 * i + 1;
      rows.fill(points, angular_rows == 2 ? 3 : angular_rows, rows.below(4) == 0, contacts[i]);
      order[i].contact = i;
    }
  }
  template <class Pass>
  void take_one_by_one(const StepSettings& settings, const Pass& pass) {
    for (ContactWork& contact : Span<ContactWork>{contacts, count}) {
      const uint32_t a = contact.state.body_a, b = contact.state.body_b;
      SolvedBody body_a(motions[a], work[a]), body_b(motions[b], work[b]);
      ContactSolver<One> solver = {settings, contact, body_a, body_b};
      pass(solver);
    }
  }
};

/// The members that a pass can change.
bool have_same_bits(const Group& one, const Group& many) {
  const auto same = [](const auto& a, const auto& b) { return memcmp(&a, &b, sizeof a) == 0; };
  bool all = same(one.motions, many.motions);
  for (int i = 0; i < 16; ++i) {
    const BodyWork &a = one.work[i], &b = many.work[i];
    all = all && same(a.angular_velocity, b.angular_velocity) && same(a.contact_velocity, b.contact_velocity) &&
          same(a.contact_angular_momentum, b.contact_angular_momentum);
  }
  for (int i = 0; i < 8; ++i) {
    const ContactWork &a = one.contacts[i], &b = many.contacts[i];
    all = all && same(a.state.normal_impulse, b.state.normal_impulse) && same(a.impulse_max, b.impulse_max) &&
          same(a.friction_impulse, b.friction_impulse) && same(a.angular_impulse, b.angular_impulse);
  }
  return all;
}

DETENT_TEST(lane_rows, at_the_ends_of_their_ranges_give_the_bits_of_one_contact_at_a_time) {
  if (lanes_of_machine() == 1) GTEST_SKIP() << "this machine, or this build, takes one contact at a time";
  static Rows rows = {{20261127}, false};
  for (uint32_t group = 0; group < k_groups; ++group) {
    rows.full = rows.below(2) == 0;
    StepSettings settings = {};
    settings.relaxation = rows.below(2) == 0 ? Unit(1.0) : fine(rows.positive(rows.unit()));
    settings.rate_mantissa = fine(rows.positive(rows.fraction()));
    settings.rate_exponent = static_cast<int>(rows.below(12));
    for (Softness* const softness : {&settings.static_softness, &settings.dynamic_softness})
      *softness = {fine(rows.positive(rows.fraction())), fine(rows.positive(rows.unit()))};
    Group one;
    one.fill(rows);
    Group many = one;
    const SolverBodies bodies = many.bodies();
    const uint32_t count = many.count;
    const Span<ContactWork> contacts = {many.contacts, count};
    put_in_lanes(bodies, contacts, {many.order, count}, many.lanes);
    const auto expect = [&](const char* pass) {
      take_from_lanes(many.lanes, count, contacts);
      ASSERT_TRUE(have_same_bits(one, many)) << pass << " of group " << group << " of " << count;
    };
    one.take_one_by_one(settings, [](auto& solver) { solver.warm_start(); });
    warm_start_lanes(settings, bodies, many.lanes, count);
    expect("the warm start");
    one.take_one_by_one(settings, [](auto& solver) { solver.solve_normals(); });
    solve_normals_lanes(settings, bodies, many.lanes, count);
    expect("the normal pass");
    one.take_one_by_one(settings, [](auto& solver) { solver.relax(); });
    relax_lanes(settings, bodies, many.lanes, count);
    expect("the relaxation");
    if (HasFatalFailure()) return;
  }
}

/// A contact with two points beside one with four: its bodies approach, but its points stay apart. A third point would
/// touch, and its speed would make the block of all numbers coarser.
DETENT_TEST(lane_rows, that_a_contact_does_not_have_change_nothing) {
  if (lanes_of_machine() == 1) GTEST_SKIP() << "this machine, or this build, takes one contact at a time";
  Rows rows = {{1}};
  StepSettings settings = {};
  settings.relaxation = Unit(1.0);
  settings.rate_mantissa = Unit(0.875);
  settings.rate_exponent = 6;
  settings.static_softness = settings.dynamic_softness = {Unit(0.5), Unit(0.5)};
  Group one;
  for (uint32_t i = 0; i < 2 * one.count; ++i) rows.fill(one.motions[i], one.work[i]);
  for (uint32_t i = 0; i < one.count; ++i) {
    ContactWork& contact = one.contacts[i];
    rows.fill(i == 0 ? 2 : 4, 0, false, contact);
    contact.state.body_a = 2 * i;
    contact.state.body_b = 2 * i + 1;
    one.order[i].contact = i;
  }
  ContactWork& contact = one.contacts[0];
  for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
    contact.separation[i] = Real(16.0);
    contact.state.normal_impulse[i] = i < 2 ? Real(0x1p-20) : k_zero;
    contact.normal_mass[i] = i < 2 ? Unit(0.5) : Unit(0.0);
  }
  contact.push_max = Real(64.0);
  for (uint32_t i = 0; i < 2; ++i) {
    one.motions[i] = {};
    one.work[i].angular_velocity = one.work[i].rotation_vector = one.work[i].displacement = k_zero_vector;
  }
  one.work[1].displacement = contact.normal * Real(-8.0);
  Group many = one;
  put_in_lanes(many.bodies(), {many.contacts, many.count}, {many.order, many.count}, many.lanes);
  one.take_one_by_one(settings, [](auto& solver) { solver.solve_normals(); });
  solve_normals_lanes(settings, many.bodies(), many.lanes, many.count);
  take_from_lanes(many.lanes, many.count, {many.contacts, many.count});
  EXPECT_EQ(contact.state.normal_impulse[0], k_zero);
  EXPECT_TRUE(have_same_bits(one, many));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
