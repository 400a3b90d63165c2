#include "tests/campaigns/zoo/watch.h"

#include <algorithm>
#include <limits>
#include <set>

namespace detent_zoo {

namespace {

constexpr double k_gravity_least = 9.81;  // m/s^2, for the work of kinematic bodies
constexpr double k_weights_pushed = 10;

/// `lag`: the time by which the velocities of bodies with joints are older than their positions, s.
double energy_of(const Frame& frame, double lag = 0) {
  double energy = 0;
  for (const BodyFrame& body : frame.bodies) energy += kinetic_energy(body) + potential_energy(body, frame.gravity);
  if (lag == 0) return energy;
  std::set<uint32_t> jointed;
  for (const JointFrame& joint : frame.joints) jointed.insert({joint.a, joint.b});
  for (const uint32_t index : jointed) {
    BodyFrame then = frame.bodies[index];
    then.position = then.position - lag * then.linear_velocity;
    energy += potential_energy(then, frame.gravity) - potential_energy(frame.bodies[index], frame.gravity);
  }
  return energy;
}

/// The velocity of a body with joints is that in the middle of the last substep. The number of substeps is known if
/// there is one island.
double lag_of(const Frame& frame, const StepFigures& step) {
  return step.islands == 1 && step.substeps != 0 ? frame.tick_time / (2.0 * step.substeps) : 0;
}

double kinetic_of(const Frame& frame) {
  double energy = 0;
  for (const BodyFrame& body : frame.bodies) energy += kinetic_energy(body);
  return energy;
}

double mass_of(const Frame& frame) {
  double mass = 0;
  for (const BodyFrame& body : frame.bodies) mass += body.kind == Kind::dynamic ? body.mass : 0;
  return mass;
}

/// The diagonal of the dynamic bodies' extent, plus the size of the largest body, m.
double span_of(const Frame& frame) {
  Vector low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
  double size = 0;
  bool any = false;
  for (const BodyFrame& body : frame.bodies) {
    if (body.kind != Kind::dynamic) continue;
    any = true;
    const Vector& p = body.position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    size = std::max(size, size_of(body));
  }
  return any ? length(high - low) + size : 0;
}

/// The height difference of the highest and the lowest body, including fixed ones, m.
double height_of(const Frame& frame) {
  double low = 1e300, high = -1e300;
  for (const BodyFrame& body : frame.bodies) {
    low = std::min(low, body.position.y);
    high = std::max(high, body.position.y);
  }
  return std::max(0.0, high - low);
}

/// The speed of a body's centre, or of the ends of rods that rotate with it about its axes, m/s.
double speed_of(const BodyFrame& body) {
  const double turning = body.mass > 0 ? dot(body.angular_velocity, angular_momentum_of(body)) / body.mass : 0;
  return std::max(length(body.linear_velocity), sqrt(3 * turning));
}

void sum_momentum(const Frame& frame, Vector& momentum, Vector& angular_momentum) {
  for (const BodyFrame& body : frame.bodies) {
    if (body.kind != Kind::dynamic) continue;
    const Vector own = body.mass * body.linear_velocity;
    momentum = momentum + own;
    angular_momentum = angular_momentum + cross(body.position, own) + angular_momentum_of(body);
  }
}

/// Converts NaN to infinity, so that it counts as the greatest value.
double finite(double value) { return isfinite(value) ? value : std::numeric_limits<double>::infinity(); }

}  // namespace

Watch::Watch(const Frame& start) : before_(start), first_(start), settled_(start) {
  energy_ = least_ = first_energy_ = energy_of(start);
  widen(start);
  sum_momentum(start, momentum_, angular_momentum_);
}

void Watch::widen(const Frame& frame) {
  span_ = std::max({span_, span_of(frame), height_of(frame)});
  const double lever = 0.1 * mass_of(frame) * length(frame.gravity) * span_of(frame);
  scale_ = std::max(scale_, kinetic_of(frame) + lever);
  Vector centre;
  const double mass = mass_of(frame);
  double momentum = 0, angular_momentum = 0;
  for (const BodyFrame& body : frame.bodies) {
    if (body.kind == Kind::dynamic) centre = centre + (body.mass / mass) * body.position;
  }
  for (const BodyFrame& body : frame.bodies) {
    if (body.kind != Kind::dynamic) continue;
    const double own = body.mass * length(body.linear_velocity);
    momentum += own;
    angular_momentum += own * length(body.position - centre) + length(angular_momentum_of(body));
  }
  momentum_scale_ = std::max(momentum_scale_, momentum);
  angular_momentum_scale_ = std::max(angular_momentum_scale_, angular_momentum);
  for (const BodyFrame& body : frame.bodies) speed_first_ = std::max(speed_first_, speed_of(body));
  double size = 0;  // size of the longest body that a motor may rotate
  for (const BodyFrame& body : frame.bodies) size = std::max(size, size_of(body));
  for (const JointFrame& joint : frame.joints) {
    for (const AxisFrame& axis : joint.axes)
      motor_speed_ = std::max(motor_speed_, std::max(1.0, size) * fabs(axis.speed));
  }
}

void Watch::calls(const Frame& after) {
  Vector momentum, angular_momentum, momentum_before, angular_momentum_before;
  sum_momentum(after, momentum, angular_momentum);
  sum_momentum(before_, momentum_before, angular_momentum_before);
  momentum_ = momentum_ + momentum - momentum_before;
  angular_momentum_ = angular_momentum_ + angular_momentum - angular_momentum_before;
  const double energy = energy_of(after);
  allowed_ += energy - energy_;
  least_ = std::min(least_, energy - allowed_);
  energy_ = energy;
  widen(after);
  if (after.bodies.size() != before_.bodies.size()) {
    first_ = settled_ = after;
    depths_.clear();
  }
  before_ = after;
}

double Watch::mover_power(const Frame& now) const {
  const double weight = mass_of(now) * std::max(length(now.gravity), k_gravity_least);
  double power = 0;
  for (size_t i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies[i].kind != Kind::kinematic) continue;
    double distance_max = 0;
    for (const JointFrame& joint : now.joints) {
      if (joint.a == i) distance_max = std::max(distance_max, length(joint.anchor_a));
      if (joint.b == i) distance_max = std::max(distance_max, length(joint.anchor_b));
    }
    for (const Frame* frame : {&before_, &now}) {
      for (const ContactFrame& contact : frame->contacts) {
        if (contact.a != i && contact.b != i) continue;
        const BodyFrame& other = frame->bodies[contact.a == i ? contact.b : contact.a];
        distance_max = std::max(distance_max, length(other.position - frame->bodies[i].position));
      }
    }
    const auto speed = [distance_max](const BodyFrame& body) {
      return length(body.linear_velocity) + distance_max * length(body.angular_velocity);
    };
    double most = speed(now.bodies[i]);
    if (i < before_.bodies.size()) most = std::max(most, speed(before_.bodies[i]));
    power += k_weights_pushed * weight * most;
  }
  return power;
}

double Watch::work(const Frame& now) const {
  double work = mover_power(now) * now.tick_time;
  if (now.joints.size() != before_.joints.size()) return work;  // a joint broke in this tick
  for (size_t i = 0; i < now.joints.size(); ++i) {
    const JointState then = state_of(before_.joints[i], before_), state = state_of(now.joints[i], now);
    for (int j = 0; j < 3; ++j) {
      if (!state.free[j]) continue;
      AxisFrame axis = now.joints[i].axes[now.joints[i].type == Held::ball ? 0 : j];
      if (now.joints[i].type == Held::ball) axis.target = axis.speed = 0;
      if (axis.frequency == 0) {
        work += axis.force_max * fabs(axis.speed) * now.tick_time;
        continue;
      }
      double displacement = state.values[j] - then.values[j];
      if (fabs(displacement) > M_PI && (now.joints[i].type == Held::hinge || now.joints[i].type == Held::parallel))
        displacement -= copysign(2 * M_PI, displacement);
      const double rate = 2 * M_PI * axis.frequency, mass = then.masses[j];
      double force = -mass * rate * rate * (then.values[j] + displacement / 2 - axis.target);
      if (axis.force_max > 0) force = std::clamp(force, -axis.force_max, axis.force_max);
      work += force * displacement + std::max(0.0, 2 * axis.damping_ratio * rate * mass * axis.speed * displacement);
    }
  }
  return work;
}

void Watch::take_energy(const Frame& now, double lag) {
  energy_ = energy_of(now, lag);
  allowed_ += work(now);
  const double own = energy_ - allowed_;
  if (scale_ > 0) figures_.gain.take(finite((own - least_) / scale_), tick_);
  if (scale_ > 0) figures_.loss.take(finite((first_energy_ - own) / scale_), tick_);
  least_ = std::min(least_, own);
}

void Watch::take_joints(const Frame& now) {
  for (uint32_t i = 0; i < now.joints.size(); ++i) {
    const JointFrame& joint = now.joints[i];
    const JointState state = state_of(joint, now);
    double size = std::numeric_limits<double>::infinity();
    for (const uint32_t each : {joint.a, joint.b}) {
      if (now.bodies[each].kind == Kind::dynamic && size_of(now.bodies[each]) > 0) {
        size = std::min(size, size_of(now.bodies[each]));
      }
    }
    figures_.gap.take(finite(state.gap / size), tick_, i);
    figures_.gap_metres.take(finite(state.gap), tick_, i);
    figures_.angle.take(finite(state.angle), tick_, i);
    figures_.limit.take(finite(state.limit), tick_, i);
  }
}

void Watch::take_speeds(const Frame& now) {
  span_ = std::max(span_, height_of(now));  // bodies may fall off everything
  const double explained = speed_first_ + sqrt(2 * length(now.gravity) * span_) + motor_speed_;
  for (const BodyFrame& body : now.bodies) {
    if (body.kind == Kind::dynamic && explained > 0) figures_.speed.take(finite(speed_of(body) / explained), tick_);
  }
}

void Watch::take_momentum(const Frame& now) {
  Vector momentum, angular_momentum;
  sum_momentum(now, momentum, angular_momentum);
  if (momentum_scale_ > 0) figures_.momentum.take(finite(length(momentum - momentum_) / momentum_scale_), tick_);
  if (angular_momentum_scale_ > 0)
    figures_.angular_momentum.take(finite(length(angular_momentum - angular_momentum_) / angular_momentum_scale_),
                                   tick_);
}

void Watch::take_contacts(const Frame& now) {
  std::map<std::pair<uint32_t, uint32_t>, double> deepest;
  for (const ContactFrame& contact : now.contacts) {
    const auto [pair, is_new] = deepest.emplace(std::pair(contact.a, contact.b), contact.depth);
    if (!is_new) pair->second = std::max(pair->second, contact.depth);
  }
  std::map<std::pair<uint32_t, uint32_t>, std::vector<double>> depths;
  for (const auto& [pair, depth] : deepest) {
    double thickness = std::numeric_limits<double>::infinity();
    uint32_t thinner = pair.first;
    for (const uint32_t each : {pair.first, pair.second}) {
      const BodyFrame& body = now.bodies[each];
      if (body.kind != Kind::dynamic || thickness_of(body) == 0 || thickness_of(body) >= thickness) continue;
      thickness = thickness_of(body);
      thinner = each;
    }
    std::vector<double>& last = depths[pair];
    if (const auto found = depths_.find(pair); found != depths_.end()) last = found->second;
    last.push_back(finite(depth / thickness));
    figures_.pierced.take(last.back(), tick_, thinner);
    if (last.size() > k_lasting_ticks) last.erase(last.begin());
    if (last.size() == k_lasting_ticks && tick_ > k_settled_tick)
      figures_.sunk.take(*std::min_element(last.begin(), last.end()), tick_, thinner);
  }
  depths_ = depths;
}

void Watch::take_places(const Frame& now) {
  if (tick_ <= k_settled_tick) settled_ = now;
  for (uint32_t i = 0; i < now.bodies.size() && i < first_.bodies.size(); ++i) {
    const BodyFrame& body = now.bodies[i];
    if (body.kind != Kind::dynamic) continue;
    figures_.fallen.take(finite(-body.position.y), tick_, i);
    figures_.risen.take(finite(body.position.y - first_.bodies[i].position.y), tick_, i);
    if (size_of(body) == 0) continue;
    figures_.moved.take(finite(length(body.position - settled_.bodies[i].position) / size_of(body)), tick_, i);
  }
}

void Watch::tick(const Frame& now, const StepFigures& step) {
  ++tick_;
  take_energy(now, lag_of(now, step));
  if (tick_ > k_settled_tick) take_joints(now);
  take_contacts(now);
  take_places(now);
  take_speeds(now);
  take_momentum(now);
  if (static_cast<double>(step.lost) > figures_.lost.value) figures_.lost_most = step.lost_most;
  figures_.lost.take(static_cast<double>(step.lost), tick_);
  figures_.impacts.take(step.impacts, tick_);
  figures_.tests.take(step.tests, tick_);
  if (step.awake != 0) figures_.asleep_from = 0;
  if (step.awake == 0 && figures_.asleep_from == 0) figures_.asleep_from = tick_;
  substeps_ += step.substeps;
  figures_.substeps_max = std::max(figures_.substeps_max, step.substeps);
  seconds_ += step.seconds;
  before_ = now;
}

Figures Watch::finish() {
  uint32_t dynamic = 0;
  for (const BodyFrame& body : before_.bodies) {
    if (body.kind != Kind::dynamic) continue;
    ++dynamic;
    figures_.rest_speed += length(body.linear_velocity);
    figures_.rest_angular_velocity += length(body.angular_velocity);
  }
  if (dynamic > 0) {
    figures_.rest_speed = finite(figures_.rest_speed / dynamic);
    figures_.rest_angular_velocity = finite(figures_.rest_angular_velocity / dynamic);
  }
  figures_.ticks = tick_;
  figures_.bodies = before_.bodies.size();
  figures_.joints = before_.joints.size();
  if (tick_ > 0) {
    figures_.substeps_mean = static_cast<double>(substeps_) / tick_;
    figures_.microseconds = seconds_ * 1e6 / tick_;
  }
  return figures_;
}

}  // namespace detent_zoo
