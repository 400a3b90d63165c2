#include <algorithm>
#include <chrono>
#include <map>

#include "tests/bench/zoo/peer.h"

namespace detent_zoo {

namespace {

bool same(const Vector& a, const Vector& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
bool same(const Rotation& a, const Rotation& b) { return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w; }
bool same(const AxisFrame& a, const AxisFrame& b) {
  return a.limited == b.limited && a.lower == b.lower && a.upper == b.upper && a.frequency == b.frequency &&
         a.damping_ratio == b.damping_ratio && a.target == b.target && a.speed == b.speed && a.force_max == b.force_max;
}
bool same_joint(const JointFrame& a, const JointFrame& b) {
  return same(a.anchor_a, b.anchor_a) && same(a.anchor_b, b.anchor_b) && same(a.frame_a, b.frame_a) &&
         same(a.frame_b, b.frame_b) && same(a.axes[0], b.axes[0]) && same(a.axes[1], b.axes[1]);
}
bool same_state(const BodyFrame& a, const BodyFrame& b) {
  return same(a.position, b.position) && same(a.rotation, b.rotation) && same(a.linear_velocity, b.linear_velocity) &&
         same(a.angular_velocity, b.angular_velocity);
}
bool has(const std::vector<Id>& ids, Id id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); }

/// What there is, by its numbers.
struct Cast {
  Frame frame;
  std::vector<Id> bodies, joints;
};

class PeerPlay : public Play {
 public:
  PeerPlay(std::unique_ptr<Script> script, MakePeer make)
      : script_(std::move(script)), cast_(cast_of(*script_)), peer_(make(cast_.frame.tick_time)) {}

  bool begin(std::string& problem) {
    peer_->set_gravity(cast_.frame.gravity);
    return add_new({}, problem);
  }

  bool call(std::string& problem) override {
    if (!script_->calls_at(tick_)) return false;
    const Frame now = frame();
    script_->place(now.bodies);
    const Cast before = cast_of(*script_);
    script_->call(tick_, problem);
    if (!problem.empty()) return false;
    cast_ = cast_of(*script_);
    follow(before, problem);
    return problem.empty();
  }

  StepFigures step() override {
    follow_springs();
    const auto start = std::chrono::steady_clock::now();
    peer_->step();
    StepFigures figures;
    figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++tick_;
    figures.awake = peer_->awake();
    const std::vector<Id> broken = peer_->broken();
    for (const Id joint : broken) script_->remove_joint(joint);
    if (!broken.empty()) cast_ = cast_of(*script_);
    return figures;
  }

  Frame frame() const override {
    Frame frame = cast_.frame;
    std::map<Id, uint32_t> places;
    for (uint32_t i = 0; i < frame.bodies.size(); ++i) {
      places[cast_.bodies[i]] = i;
      if (frame.bodies[i].kind != Kind::fixed) peer_->read(cast_.bodies[i], frame.bodies[i]);
    }
    for (const Touch& touch : peer_->contacts()) {
      const auto a = places.find(touch.a), b = places.find(touch.b);
      if (a == places.end() || b == places.end()) continue;  // of a body that is gone
      frame.contacts.push_back({std::min(a->second, b->second), std::max(a->second, b->second), touch.depth});
    }
    return frame;
  }

  uint32_t ticks() const override { return script_->ticks(); }
  std::string body_name(uint32_t index) const override {
    return index < cast_.bodies.size() ? script_->body_name(cast_.bodies[index]) : "body";
  }
  std::string joint_name(uint32_t index) const override {
    if (index >= cast_.frame.joints.size()) return "joint " + std::to_string(index);
    const JointFrame& joint = cast_.frame.joints[index];
    return body_name(joint.a) + " - " + body_name(joint.b);
  }

 private:
  static Cast cast_of(const Script& script) { return {script.frame(), script.bodies(), script.joints()}; }

  /// What is there and was not.
  bool add_new(const Cast& before, std::string& problem) {
    for (size_t i = 0; i < cast_.bodies.size(); ++i) {
      if (has(before.bodies, cast_.bodies[i])) continue;
      const Properties properties = script_->properties(cast_.bodies[i]);
      problem = properties.sensor ? "sensor" : peer_->add_body(cast_.bodies[i], cast_.frame.bodies[i], properties);
      if (!problem.empty()) return false;
    }
    const Frame now = frame();
    for (size_t i = 0; i < cast_.joints.size(); ++i) {
      if (has(before.joints, cast_.joints[i])) continue;
      const JointFrame& joint = cast_.frame.joints[i];
      problem = peer_->add_joint(cast_.joints[i], joint, script_->ties(cast_.joints[i]), cast_.bodies[joint.a],
                                 cast_.bodies[joint.b], state_of(joint, now));
      if (!problem.empty()) return false;
    }
    return true;
  }

  /// Does to the peer what the calls did to the scene. What they remade is taken out and put in anew.
  void follow(Cast before, std::string& problem) {
    bool gone = false;
    const auto forget = [](std::vector<Id>& ids, size_t i) { ids[i] = 0; };
    for (size_t i = 0; i < before.joints.size(); ++i) {
      const auto found = std::find(cast_.joints.begin(), cast_.joints.end(), before.joints[i]);
      const size_t now = static_cast<size_t>(found - cast_.joints.begin());
      if (found != cast_.joints.end() && same_joint(before.frame.joints[i], cast_.frame.joints[now])) continue;
      peer_->remove_joint(before.joints[i]);
      forget(before.joints, i);
    }
    for (size_t i = 0; i < before.bodies.size(); ++i) {
      const BodyFrame& was = before.frame.bodies[i];
      const auto found = std::find(cast_.bodies.begin(), cast_.bodies.end(), before.bodies[i]);
      const size_t now = static_cast<size_t>(found - cast_.bodies.begin());
      if (found == cast_.bodies.end() || cast_.frame.bodies[now].kind != was.kind) {
        peer_->remove_body(before.bodies[i]);
        forget(before.bodies, i);
        gone = true;
      } else if (!same_state(was, cast_.frame.bodies[now])) {
        peer_->set_state(before.bodies[i], cast_.frame.bodies[now]);
      }
    }
    if (!same(before.frame.gravity, cast_.frame.gravity)) {
      peer_->set_gravity(cast_.frame.gravity);
      gone = true;
    }
    if (add_new(before, problem) && gone) peer_->wake_all();
  }

  void follow_springs() {
    Frame now;
    for (size_t i = 0; i < cast_.joints.size(); ++i) {
      const JointFrame& joint = cast_.frame.joints[i];
      if (!is_sprung(joint.axes[0]) && !is_sprung(joint.axes[1])) continue;
      if (now.bodies.empty()) now = frame();
      peer_->set_springs(cast_.joints[i], joint, state_of(joint, now));
    }
  }

  std::unique_ptr<Script> script_;
  Cast cast_;
  std::unique_ptr<Peer> peer_;
  uint32_t tick_ = 0;
};

}  // namespace

std::unique_ptr<Play> open_peer_play(const std::string& path, detent_test::Ground ground, MakePeer make,
                                     std::string& problem) {
  std::unique_ptr<Script> script = open_script(path, ground, problem);
  if (script == nullptr) return nullptr;
  auto play = std::make_unique<PeerPlay>(std::move(script), make);
  if (!play->begin(problem)) return nullptr;
  return play;
}

Spring spring_of(const AxisFrame& axis, double mass) {
  const double rate = 2 * M_PI * axis.frequency;
  return {mass * rate * rate, 2 * axis.damping_ratio * rate * mass};
}

}  // namespace detent_zoo
