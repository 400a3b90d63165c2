#include "tests/campaigns/stress/run_detent.h"

#include <detent/numbers.h>
#include <detent/world.h>
#include <string.h>

#include <type_traits>

#include "base/digest.h"
#include "tests/campaigns/stress/icosahedron.h"

#define DETENT_STRESS_TEXT_OF(name) #name
#define DETENT_STRESS_TEXT(name) DETENT_STRESS_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_stress::BodyState;
using detent_stress::CookedIcosahedron;
using detent_stress::Counts;
using detent_stress::Role;
using detent_stress::Settings;
using detent_stress::Solid;
using detent_stress::Stage;
using detent_stress::StageBody;
using detent_stress::StageJoint;
using detent_stress::States;

bool to_vector(const double (&v)[3], Vec3<Real>& result) {
  return real_from_host(v[0], result.x) == Status::ok && real_from_host(v[1], result.y) == Status::ok &&
         real_from_host(v[2], result.z) == Status::ok;
}
bool to_position(const double (&v)[3], Position& result) {
  return coord_from_host(v[0], result.x) == Status::ok && coord_from_host(v[1], result.y) == Status::ok &&
         coord_from_host(v[2], result.z) == Status::ok;
}
bool to_rotation(const double (&q)[4], Quat& result) {
  return unit_from_host(q[0], result.x) == Status::ok && unit_from_host(q[1], result.y) == Status::ok &&
         unit_from_host(q[2], result.z) == Status::ok && unit_from_host(q[3], result.w) == Status::ok;
}
void from_vector(const Vec3<Real>& v, double (&result)[3]) {
  result[0] = real_to_host(v.x);
  result[1] = real_to_host(v.y);
  result[2] = real_to_host(v.z);
}

/// The product a b of quaternions x, y, z, w; `sign` -1 uses the inverse of b.
void rotation_vector(const double (&a)[4], const std::array<double, 4>& b, double sign, double (&result)[4]) {
  const double x = sign * b[0], y = sign * b[1], z = sign * b[2], w = b[3];
  const double product[4] = {a[3] * x + a[0] * w + a[1] * z - a[2] * y, a[3] * y - a[0] * z + a[1] * w + a[2] * x,
                             a[3] * z + a[0] * y - a[1] * x + a[2] * w, a[3] * w - a[0] * x - a[1] * y - a[2] * z};
  memcpy(result, product, sizeof product);
}

/// The bits of a number, for a digest.
template <class T>
uint64_t bits_of(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof value);
    return bits;
  } else {
    return static_cast<uint64_t>(value.raw);
  }
}

class DetentRun : public detent_stress::Run {
 public:
  Status make(const Stage& stage, const Settings& settings) {
    WorldDef def;
    def.capacity.bodies = static_cast<uint32_t>(stage.bodies.size());
    // A body in a heap touches about 12 others, and each pair counts once; a body in a row of boxes has 2 more near it.
    def.capacity.contacts = 8 * def.capacity.bodies + 16;
    def.capacity.joints = static_cast<uint32_t>(stage.joints.size());
    for (const StageBody& body : stage.bodies) {
      if (body.solid == Solid::icosahedron) hulls_.push_back(detent_stress::cook_icosahedron(body.size[0]));
    }
    for (const CookedIcosahedron& hull : hulls_)
      assets_.push_back({reinterpret_cast<const uint8_t*>(hull.words.data()), hull.byte_count});
    def.capacity.assets = static_cast<uint32_t>(assets_.size());
    Vec3<Real> gravity;
    if (!to_vector({0, -stage.gravity, 0}, gravity)) return Status::out_of_range;
    def.gravity = gravity;
    if (const Status status = real_from_host(stage.tick, def.tick); status != Status::ok) return status;
    if (settings.substeps) def.substeps = *settings.substeps;
    if (settings.iterations) def.iterations = *settings.iterations;
    for (const auto& [given, to] : {std::pair(settings.resting_penetration, &def.resting_penetration),
                                    std::pair(settings.contact_recycle_distance, &def.contact_recycle_distance)}) {
      if (!given) continue;
      if (const Status status = real_from_host(*given, *to); status != Status::ok) return status;
    }
    if (settings.reduction) def.reduction = static_cast<ManifoldReduction>(*settings.reduction);
    def.sleeping = stage.sleeping;
    def.continuous = settings.continuous;
    words_.resize((world_bytes(def.capacity) + 7) / 8);
    Status status = create_world(reinterpret_cast<uint8_t*>(words_.data()), world_bytes(def.capacity), def,
                                 {.assets = {assets_.data(), def.capacity.assets}}, world_);
    for (uint32_t i = 0; i < def.capacity.assets && status == Status::ok; ++i) status = bind_asset(world_, i);
    uint32_t next_hull = 0;
    for (const StageBody& body : stage.bodies) {
      if (status != Status::ok) break;
      status = add(body, stage.collisions, next_hull);
    }
    for (const StageJoint& joint : stage.joints) {
      if (status != Status::ok) break;
      status = add(joint);
    }
    return status;
  }

  Counts step() override {
    const StepReport report = detent::step(world_);
    Counts counts;
    counts.contacts = report.contacts.count;
    counts.contact_points = report.contacts.points;
    counts.awake = report.awake;
    counts.lost = report.lost.pairs + report.lost.contacts;
    counts.saturations = report.saturations;
    counts.substeps_max = report.substeps_max;
    counts.lost_time = real_to_host(report.ccd.lost_time);
    return counts;
  }

  States states() const override {
    States states;
    for (const Body& body : bodies_) {
      Pose pose;
      Vec3<Real> linear_velocity, angular_velocity;
      BodyState state;
      if (get_pose(world_, body.id, pose) == Status::ok &&
          get_velocity(world_, body.id, linear_velocity, angular_velocity) == Status::ok) {
        const Quat& q = pose.rotation;
        state.position[0] = coord_to_host(pose.position.x);
        state.position[1] = coord_to_host(pose.position.y);
        state.position[2] = coord_to_host(pose.position.z);
        const double rotation[4] = {unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)};
        rotation_vector(rotation, body.cooked, -1, state.rotation);
        from_vector(linear_velocity, state.linear_velocity);
        from_vector(angular_velocity, state.angular_velocity);
      }
      states.push_back(state);
    }
    return states;
  }

  uint64_t digest() const override { return detent::digest(world_); }

  uint64_t relative_digest() const override {
    uint64_t running = 0;
    const auto add = [&running](auto value) { running = digest_step(running, bits_of(value)); };
    Pose origin, pose;
    for (const Body& body : bodies_) {
      Vec3<Real> linear_velocity, angular_velocity;
      if (get_pose(world_, bodies_[0].id, origin) != Status::ok || get_pose(world_, body.id, pose) != Status::ok ||
          get_velocity(world_, body.id, linear_velocity, angular_velocity) != Status::ok)
        continue;
      add(pose.position.x - origin.position.x);
      add(pose.position.y - origin.position.y);
      add(pose.position.z - origin.position.z);
      for (const Unit value : {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w}) add(value);
      for (const Real value : {linear_velocity.x, linear_velocity.y, linear_velocity.z, angular_velocity.x,
                               angular_velocity.y, angular_velocity.z})
        add(value);
    }
    return digest_finish(running);
  }

  uint32_t bytes() const override { return world_bytes(get_info(world_).capacity); }

  World& world() { return world_; }

 private:
  struct Body {
    BodyId id;
    std::array<double, 4> cooked = {0, 0, 0, 1};  ///< from the body's axes in the library to the stage's
  };

  Status add(const StageBody& body, bool collides, uint32_t& next_hull) {
    BodyDef def;
    if (!collides) def.filter.group = -1;
    Body made;
    Vec3<Real> size;
    if (!to_vector(body.size, size)) return Status::out_of_range;
    switch (body.solid) {
      case Solid::box:
        def.shape = box(size);
        break;
      case Solid::sphere:
        def.shape = sphere(size.x);
        break;
      case Solid::capsule:
        def.shape = capsule(size.x, size.y);
        break;
      case Solid::icosahedron:
        made.cooked = hulls_[next_hull].rotation;
        def.shape = hull(next_hull++);
        break;
      case Solid::half_space:
        def.shape = half_space();
        break;
    }
    def.type = body.role == Role::fixed       ? BodyType::fixed
               : body.role == Role::kinematic ? BodyType::kinematic
                                              : BodyType::dynamic;
    double rotation[4];
    rotation_vector(body.rotation, made.cooked, 1, rotation);
    if (!to_position(body.position, def.position) || !to_rotation(rotation, def.rotation) ||
        !to_vector(body.linear_velocity, def.linear_velocity) ||
        !to_vector(body.angular_velocity, def.angular_velocity))
      return Status::out_of_range;
    for (const Status status : {scaled_from_host(body.density, def.density), scaled_from_host(body.mass, def.mass),
                                real_from_host(body.friction, def.material.friction),
                                real_from_host(body.restitution, def.material.restitution)}) {
      if (status != Status::ok) return status;
    }
    const Status status = create_body(world_, def, made.id);
    bodies_.push_back(made);
    return status;
  }

  Status add(const StageJoint& joint) {
    JointDef def;
    def.type = JointType::ball;
    def.a = bodies_[joint.a].id;
    def.b = bodies_[joint.b].id;
    if (!to_vector(joint.anchor_a, def.anchor_a) || !to_vector(joint.anchor_b, def.anchor_b))
      return Status::out_of_range;
    JointId id;
    return create_joint(world_, def, id);
  }

  std::vector<CookedIcosahedron> hulls_;
  std::vector<Asset> assets_;
  std::vector<uint64_t> words_;
  std::vector<Body> bodies_;
  World world_;
};

std::unique_ptr<detent_stress::Run> make_run(const Stage& stage, const Settings& settings, std::string& problem) {
  std::unique_ptr<DetentRun> run(new DetentRun);
  if (const Status status = run->make(stage, settings); status != Status::ok) {
    problem = stage.name + " cannot be made: " + status_text(status);
    return nullptr;
  }
  return run;
}

}  // namespace

World& world_of(detent_stress::Run& run) { return static_cast<DetentRun&>(run).world(); }

detent_stress::Engine stress_engine() { return {DETENT_STRESS_TEXT(DETENT_NAMESPACE), make_run}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
