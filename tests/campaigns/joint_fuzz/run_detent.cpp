#include "tests/campaigns/joint_fuzz/run_detent.h"

#include <detent/body.h>
#include <detent/numbers.h>
#include <detent/world.h>

#define DETENT_JOINT_FUZZ_TEXT_OF(name) #name
#define DETENT_JOINT_FUZZ_TEXT(name) DETENT_JOINT_FUZZ_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_joint_fuzz::Counts;
using detent_joint_fuzz::Inertia;
using detent_joint_fuzz::Rotation;
using detent_joint_fuzz::Scene;
using detent_joint_fuzz::SceneAxis;
using detent_joint_fuzz::SceneBody;
using detent_joint_fuzz::SceneJoint;
using detent_joint_fuzz::Settings;
using detent_joint_fuzz::Solid;
using detent_joint_fuzz::States;
using detent_joint_fuzz::Triple;

/// Converts to the library's numbers and keeps the first refusal.
struct Numbers {
  Status status = Status::ok;

  void take(Status next) {
    if (status == Status::ok) status = next;
  }
  Real real(double value) {
    Real result{};
    take(real_from_host(value, result));
    return result;
  }
  Scaled scaled(double value) {
    Scaled result{};
    take(scaled_from_host(value, result));
    return result;
  }
  Vec3<Real> vector(const Triple& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
  Position position(const Triple& v) {
    Position result;
    take(coord_from_host(v[0], result.x));
    take(coord_from_host(v[1], result.y));
    take(coord_from_host(v[2], result.z));
    return result;
  }
  Quat rotation(const Rotation& q) {
    Quat result;
    take(unit_from_host(q[0], result.x));
    take(unit_from_host(q[1], result.y));
    take(unit_from_host(q[2], result.z));
    take(unit_from_host(q[3], result.w));
    return result;
  }
  JointAxis axis(const SceneAxis& given) {
    JointAxis result;
    result.limited = given.limited;
    result.lower = real(given.lower);
    result.upper = real(given.upper);
    result.frequency = real(given.frequency);
    result.damping_ratio = real(given.damping_ratio);
    result.target = real(given.target);
    result.speed = real(given.speed);
    result.force_max = scaled(given.force_max);
    return result;
  }
};

Triple triple_of(const Vec3<Real>& v) { return {real_to_host(v.x), real_to_host(v.y), real_to_host(v.z)}; }

class DetentRun : public detent_joint_fuzz::Run {
 public:
  Status make(const Scene& scene, const Settings& settings) {
    Numbers numbers;
    WorldDef def;
    const uint32_t bodies = static_cast<uint32_t>(scene.bodies.size());
    def.capacity.bodies = bodies + 1;
    def.capacity.contacts = 16 * bodies + 16;
    def.capacity.joints = static_cast<uint32_t>(scene.joints.size());
    def.gravity = numbers.vector({0, -scene.gravity, 0});
    def.substeps = settings.substeps;
    def.sleeping = false;
    words_.resize((world_bytes(def.capacity) + 7) / 8);
    numbers.take(create_world(reinterpret_cast<uint8_t*>(words_.data()), world_bytes(def.capacity), def, {}, world_));
    if (numbers.status != Status::ok) return numbers.status;
    if (scene.ground) {
      BodyId ground;
      numbers.take(create_body(world_, {.type = BodyType::fixed, .shape = half_space()}, ground));
    }
    for (const SceneBody& body : scene.bodies) add(body, scene, numbers);
    for (const SceneJoint& joint : scene.joints) add(joint, numbers);
    return numbers.status;
  }

  Counts step() override {
    const StepReport report = detent::step(world_);
    return {report.substeps_max, report.saturations, report.joints.undecided, report.contacts.count, report.islands};
  }

  void states(States& states) const override {
    states.resize(ids_.size());
    for (size_t i = 0; i < ids_.size(); ++i) {
      Pose pose;
      Vec3<Real> linear_velocity, angular_velocity;
      if (get_pose(world_, ids_[i], pose) != Status::ok ||
          get_velocity(world_, ids_[i], linear_velocity, angular_velocity) != Status::ok)
        continue;
      const Position& p = pose.position;
      const Quat& q = pose.rotation;
      states[i] = {{coord_to_host(p.x), coord_to_host(p.y), coord_to_host(p.z)},
                   {unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)},
                   triple_of(linear_velocity),
                   triple_of(angular_velocity)};
    }
  }

  std::vector<Inertia> inertia() const override {
    std::vector<Inertia> result(ids_.size());
    for (size_t i = 0; i < ids_.size(); ++i) {
      BodyType type;
      Scaled mass;
      Vec3<Scaled> moments;
      if (get_type(world_, ids_[i], type) != Status::ok || type != BodyType::dynamic) continue;
      if (get_mass(world_, ids_[i], mass) != Status::ok || get_inertia(world_, ids_[i], moments) != Status::ok)
        continue;
      result[i] = {scaled_to_host(mass),
                   {scaled_to_host(moments.x), scaled_to_host(moments.y), scaled_to_host(moments.z)}};
    }
    return result;
  }

 private:
  void add(const SceneBody& body, const Scene& scene, Numbers& numbers) {
    BodyDef def;
    switch (body.solid) {
      case Solid::sphere:
        def.shape = sphere(numbers.real(body.size[0]));
        break;
      case Solid::capsule:
        def.shape = capsule(numbers.real(body.size[0]), numbers.real(body.size[1]));
        break;
      case Solid::box:
        def.shape = box(numbers.vector(body.size));
        break;
    }
    def.type = body.fixed ? BodyType::fixed : BodyType::dynamic;
    def.position = numbers.position(body.position);
    def.rotation = numbers.rotation(body.rotation);
    def.linear_velocity = numbers.vector(body.linear_velocity);
    def.angular_velocity = numbers.vector(body.angular_velocity);
    def.mass = numbers.scaled(body.mass);
    // The group keeps the bodies from colliding with each other; they still collide with the ground.
    if (!scene.collisions) def.filter.group = -1;
    BodyId id;
    if (numbers.status == Status::ok) numbers.take(create_body(world_, def, id));
    ids_.push_back(id);
  }

  void add(const SceneJoint& joint, Numbers& numbers) {
    JointDef def;
    def.type = static_cast<JointType>(joint.hold);
    def.a = ids_[joint.a];
    def.b = ids_[joint.b];
    def.anchor_a = numbers.vector(joint.anchor_a);
    def.anchor_b = numbers.vector(joint.anchor_b);
    def.frame_a = numbers.rotation(joint.frame_a);
    def.frame_b = numbers.rotation(joint.frame_b);
    def.axis = numbers.axis(joint.axis);
    def.second = numbers.axis(joint.second);
    JointId id;
    if (numbers.status == Status::ok) numbers.take(create_joint(world_, def, id));
  }

  std::vector<uint64_t> words_;
  std::vector<BodyId> ids_;
  World world_;
};

std::unique_ptr<detent_joint_fuzz::Run> make_run(const Scene& scene, const Settings& settings, std::string& problem) {
  std::unique_ptr<DetentRun> run(new DetentRun);
  if (const Status status = run->make(scene, settings); status != Status::ok) {
    problem = "the scene of seed " + std::to_string(scene.seed) + " cannot be made: " + status_text(status);
    return nullptr;
  }
  return run;
}

}  // namespace

detent_joint_fuzz::Engine joint_fuzz_engine() { return {DETENT_JOINT_FUZZ_TEXT(DETENT_NAMESPACE), make_run}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
