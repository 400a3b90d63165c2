#pragma once
#include <detent/body.h>
#include <detent/joint.h>
#include <detent/world.h>

#include <limits>

#include "tests/common/queries/random.h"
#include "tests/unit/world/lab.h"

/// Arguments for random calls, good and bad: the same on every machine, so no libm.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Draws arguments. `wrong` becomes true where one is outside what its documentation allows, else it stays.
class Draw {
 public:
  /// `wide`: sizes and speeds of all orders, whose ranges may be left.
  Draw(uint64_t seed, bool wide) : random_(seed), wide_(wide) {}
  /// As the tape's bytes have it; the first says whether it is wide.
  Draw(const uint8_t* tape, size_t count)
      : random_(count, tape, count), wide_(count != 0 && tape[0] % 4 == 0), taped_(true) {}

  /// A tape is at its end.
  bool ended() const { return taped_ && random_.tape_left() == 0; }
  bool wide() const { return wide_; }
  bool chance(double probability) { return random_.chance(probability); }
  uint32_t below(uint32_t count) { return random_.below(count); }
  uint32_t word() { return static_cast<uint32_t>(random_.next()); }
  double uniform(double low, double high) { return random_.uniform(low, high); }
  /// Each doubling from `low` to `high` is as likely as the next.
  double order(double low, double high) {
    uint32_t doublings = 1;
    for (double top = low; top * 4 <= high; top *= 2) ++doublings;
    double value = low * random_.uniform(1, 2);
    for (uint32_t i = random_.below(doublings); i != 0; --i) value *= 2;
    return value;
  }

  /// Once in ten: something shall be wrong.
  bool bad() { return random_.chance(0.1); }
  Real number(double low, double high, bool& wrong) {
    if (random_.chance(0.03)) {
      wrong = true;
      return wild();
    }
    return real(random_.uniform(low, high));
  }
  Vec3<Real> vector(double size, bool& wrong) {
    if (wide_) size *= order(0.01, 100);
    const Real x = number(-size, size, wrong), y = number(-size, size, wrong), z = number(-size, size, wrong);
    return {x, y, z};
  }
  Vec3<Scaled> push(double size) {
    if (wide_) size *= order(0.001, 1e6);
    const double x = random_.uniform(-size, size), y = random_.uniform(-size, size), z = random_.uniform(-size, size);
    return scaleds(x, y, z);
  }
  Position place() {
    const double x = random_.uniform(-3, 3), y = random_.uniform(0, 4), z = random_.uniform(-3, 3);
    return position(x, y, z);
  }
  Quat rotation(bool& wrong) {
    const auto q = random_.rotation();
    const double length = bad() ? 0.5 : 1;
    wrong = wrong || length < 1;
    return {unit(q[0] * length), unit(q[1] * length), unit(q[2] * length), unit(q[3] * length)};
  }
  /// A hull or surface may be one that is not bound, or none, or beyond the table.
  Shape shape(bool& wrong) {
    const double size = wide_ ? order(0.1, 50) : 1;
    const Real a = number(0.2 * size, size, wrong), b = number(0.2 * size, size, wrong),
               c = number(0.2 * size, size, wrong);
    switch (random_.below(11)) {
      case 0:
        return sphere(a);
      case 1:
        return capsule(a, b);
      case 2:
        return box({a, b, c});
      case 3:
        return cylinder(a, b);
      case 4:
        return rounded(cone(a, b), c);
      case 5:
        return hull(bad() ? random_.below(8) : 2 + random_.below(2));
      case 6:
        return rounded(hull(3), c);
      case 7:
        return terrain(bad() ? random_.below(8) : random_.below(2));
      case 8:
      case 9:
        return compound(bad() ? random_.below(8) : 4);
      default:
        return half_space();
    }
  }
  /// Of a query: also a point.
  Shape asked_shape(bool& wrong) { return bad() ? sphere(Real(0.0)) : shape(wrong); }
  Filter filter() {
    Filter made;
    made.category = 1u << random_.below(3);
    made.mask = random_.chance(0.5) ? ~0u : random_.below(8);
    made.group = static_cast<int32_t>(random_.below(5)) - 2;
    made.rule = random_.chance(0.2) ? 1 : 0;
    return made;
  }
  Material material(bool& wrong) {
    const Real friction = number(0, 2, wrong), restitution = number(0, 1, wrong), rolling = number(0, 0.2, wrong);
    Material made = {friction, restitution, rolling, RestitutionRule::larger};
    made.restitution_rule = random_.chance(0.5) ? RestitutionRule::larger : RestitutionRule::smaller;
    if (bad()) {
      made.restitution_rule = static_cast<RestitutionRule>(7);
      wrong = true;
    }
    return made;
  }
  BodyType type(bool& wrong) {
    const uint32_t value = bad() ? 4 : 1 + random_.below(3);
    wrong = wrong || value > 3;
    return static_cast<BodyType>(value);
  }
  uint32_t locks(bool& wrong) {
    const uint32_t value = bad() ? 8 : random_.below(8);
    wrong = wrong || value > 7;
    return value;
  }

  /// All of a joint but the bodies and the place.
  JointDef joint(bool& wrong) {
    constexpr uint32_t k_types = static_cast<uint32_t>(k_joint_type_last);
    JointDef def;
    def.type = static_cast<JointType>(1 + (bad() ? k_types : random_.below(k_types)));
    wrong = wrong || def.type > k_joint_type_last;
    def.axis = joint_axis(wrong);
    def.second = joint_axis(wrong);
    def.collide = random_.chance(0.5);
    if (random_.chance(0.2)) def.friction_force = scaled(order(1, 10000));
    if (random_.chance(0.2)) def.friction_torque = scaled(order(1, 10000));
    if (random_.chance(0.3)) def.break_force = scaled(order(1, 10000));
    if (random_.chance(0.3)) def.break_torque = scaled(order(1, 10000));
    def.user_data = word();
    return def;
  }
  void joint_place(JointDef& def, bool& wrong) {
    def.anchor_a = vector(0.5, wrong);
    def.anchor_b = vector(0.5, wrong);
    def.frame_a = rotation(wrong);
    def.frame_b = rotation(wrong);
  }

  /// `now` with other settings.
  WorldDef settings(WorldDef now, bool& wrong) {
    const bool too_long = bad();
    wrong = wrong || too_long;
    now.tick = too_long ? real(0.5) : real(random_.uniform(0.005, 0.05));
    now.gravity = vector(10, wrong);
    now.substeps = random_.chance(0.5) ? 0 : 1 + random_.below(6);
    now.substeps_max = 1 + random_.below(16);
    now.resting_penetration = number(0x1p-8, 0x1p-4, wrong);
    now.iterations = 1 + random_.below(3);
    now.convergence = random_.below(31);
    now.relaxation = number(0.5, 1.5, wrong);
    now.damping_ratio = number(1, 20, wrong);
    now.contact_recycle_distance = random_.chance(0.5) ? real(0) : real(0.004);
    now.stabilisation = random_.chance(0.5) ? Stabilisation::soft : Stabilisation::post;
    now.reduction = random_.chance(0.5) ? ManifoldReduction::projected_extremes : ManifoldReduction::deepest_area;
    now.continuous = random_.chance(0.7);
    now.sleeping = random_.chance(0.7);
    if (random_.chance(0.02)) {
      now.stabilisation = static_cast<Stabilisation>(3);
      wrong = true;
    }
    return now;
  }

 private:
  Real wild() {
#if DETENT_FIXED
    return Real::from_raw(INT64_MIN);  // the largest of all is an angular velocity that a small body may have
#else
    return random_.chance(0.5) ? std::numeric_limits<Real>::quiet_NaN() : std::numeric_limits<Real>::infinity();
#endif
  }
  JointAxis joint_axis(bool& wrong) {
    JointAxis axis;
    axis.limited = random_.chance(0.5);
    axis.lower = number(-2, 0, wrong);
    axis.upper = random_.chance(0.2) ? axis.lower : number(0, 2, wrong);
    if (random_.chance(0.02)) {
      axis.lower = real(2.5);
      wrong = true;
    }
    if (random_.chance(0.4)) axis.frequency = number(0.5, 30, wrong);
    axis.damping_ratio = number(0, 2, wrong);
    axis.target = number(-1, 1, wrong);
    axis.speed = number(-5, 5, wrong);
    if (random_.chance(0.5)) axis.force_max = scaled(order(0.1, 1000));
    if (random_.chance(0.02)) {
      axis.force_max = scaled(-1);
      wrong = true;
    }
    return axis;
  }

  detent_queries::Random random_;
  const bool wide_, taped_ = false;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
