#include <detent/body_access.h>
#include <detent/contacts.h>
#include <detent/query.h>
#include <detent/world_access.h>

#include <limits>
#include <map>
#include <vector>

#include "tests/oracle/effort.h"
#include "tests/queries/random.h"
#include "tests/replay/match.h"
#include "tests/world/joint_lab.h"

/// Random calls, good and bad, against a model of what their documentation says: statuses, what getters return, that a
/// call that fails changes nothing, that every state can be loaded, and that a recording of the calls replays.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Random = detent_queries::Random;

constexpr uint32_t k_bodies = 10, k_joints = 6, k_calls = 40, k_segments = 3;

/// What is known of a body without asking.
struct Known {
  BodyType type = BodyType::dynamic;
  ShapeType shape = ShapeType::sphere;
  Material material = {};
  Real linear_damping = 0.0, angular_damping = 0.0, gravity_scale = 1.0;
  Scaled mass = 0.0;  ///< 0: not known
  uint32_t user_data = 0, turn_locks = 0;
  Filter filter = {};
};

struct Model {
  std::map<uint32_t, std::pair<BodyId, Known>> bodies;  ///< by slot
  std::vector<BodyId> gone;
  std::map<uint32_t, std::pair<JointId, JointDef>> joints;  ///< by slot
  std::vector<JointId> joints_gone;
};

class Game {
 public:
  /// Every fourth is of sizes and speeds of all orders, whose ranges may be left.
  explicit Game(uint64_t seed) : random_(seed), wide_(seed % 4 == 0), owned_(settings()) {
    world().joint_events = {broken_, k_joints};
  }

  /// Calls in segments: each is recorded, and replayed at its end; between them the world may go back.
  void play() {
    for (uint32_t segment = 0; segment < k_segments && !failed(); ++segment) {
      const Model before = model_;
      std::vector<uint64_t> snapshot = save_all();
      play_recorded();
      if (!random_.chance(0.3)) continue;
      const bool quick = random_.chance(0.5);
      EXPECT_OK(quick ? restore(world(), bytes_of(snapshot), byte_count(snapshot))
                      : load(world(), bytes_of(snapshot), byte_count(snapshot)));
      for (const auto& [slot, body] : model_.bodies) {
        if (!before.bodies.count(slot) || !(before.bodies.at(slot).first == body.first)) continue;
        EXPECT_TRUE(is_valid(world(), body.first));
      }
      model_ = before;
    }
  }

 private:
  static bool failed() { return testing::Test::HasFailure(); }
  static WorldDef settings() {
    WorldDef def;
    def.capacity = {k_bodies, 24, 1, true, k_joints};
    return def;
  }
  World& world() { return owned_.world; }

  std::vector<uint64_t> save_all() {
    std::vector<uint64_t> bytes(snapshot_bytes(settings().capacity) / 8);
    EXPECT_OK(save(world(), bytes_of(bytes), byte_count(bytes)));
    return bytes;
  }

  void play_recorded() {
    MemorySink memory;
    uint8_t buffer[k_recording_buffer_bytes];
    Recorder recorder(world(), memory.sink(), buffer, sizeof buffer);
    EXPECT_OK(recorder.begin());
    recorder_ = &recorder;
    for (uint32_t i = 0; i < k_calls && !failed(); ++i) {
      call();
      check_bodies();
      check_joints();
    }
    EXPECT_OK(recorder.end());
    const Replay outcome = replay(memory.bytes);
    EXPECT_TRUE(outcome.finished) << outcome.error.field << ": " << status_text(outcome.error.status);
    EXPECT_EQ(outcome.digest, digest(world()));
    Lab other(settings().capacity);
    std::vector<uint64_t> bytes = save_all();
    ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes)));
    const uint64_t again = digest(other.world);
    EXPECT_EQ(again, digest(world()));
  }

  // Numbers, one in ten of them outside its range.
  bool bad() { return random_.chance(0.1); }
  Real wild() {
#if DETENT_FIXED
    return Real::from_raw(INT64_MIN);  // the largest of all is a spin that a small body may have
#else
    return random_.chance(0.5) ? std::numeric_limits<Real>::quiet_NaN() : std::numeric_limits<Real>::infinity();
#endif
  }
  Real number(double low, double high, bool& wrong) {
    if (random_.chance(0.03)) {
      wrong = true;
      return wild();
    }
    return real(random_.uniform(low, high));
  }
  Vec3<Real> vector(double size, bool& wrong) {
    if (wide_) size *= random_.log_uniform(0.01, 100);
    const Real x = number(-size, size, wrong), y = number(-size, size, wrong), z = number(-size, size, wrong);
    return {x, y, z};
  }
  Vec3<Scaled> push(double size) {
    if (wide_) size *= random_.log_uniform(0.001, 1e6);
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
  Shape shape(bool& wrong) {
    const double size = wide_ ? random_.log_uniform(0.1, 50) : 1;
    const Real a = number(0.2 * size, size, wrong), b = number(0.2 * size, size, wrong),
               c = number(0.2 * size, size, wrong);
    switch (random_.below(6)) {
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
      default:
        return half_space();
    }
  }
  Filter filter() {
    Filter made;
    made.category = 1u << random_.below(3);
    made.mask = random_.chance(0.5) ? ~0u : random_.below(8);
    made.group = static_cast<int32_t>(random_.below(5)) - 2;
    return made;
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
    if (random_.chance(0.5)) axis.force_max = scaled(random_.log_uniform(0.1, 1000));
    if (random_.chance(0.02)) {
      axis.force_max = scaled(-1);
      wrong = true;
    }
    return axis;
  }
  void place_anyhow(JointDef& def, bool& wrong) {
    def.anchor_a = vector(0.5, wrong);
    def.anchor_b = vector(0.5, wrong);
    def.frame_a = rotation(wrong);
    def.frame_b = rotation(wrong);
  }
  /// All but the bodies and the place.
  JointDef joint(bool& wrong) {
    JointDef def;
    def.type = static_cast<JointType>(bad() ? 8 : 1 + random_.below(7));
    wrong = wrong || def.type > JointType::wheel;
    def.axis = joint_axis(wrong);
    def.second = joint_axis(wrong);
    def.collide = random_.chance(0.5);
    if (random_.chance(0.3)) def.break_force = scaled(random_.log_uniform(1, 10000));
    if (random_.chance(0.3)) def.break_torque = scaled(random_.log_uniform(1, 10000));
    def.user_data = static_cast<uint32_t>(random_.next());
    return def;
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

  /// A body, or an id that names none; null if there is none.
  BodyId pick() {
    if (model_.bodies.empty() || bad()) {
      if (!model_.gone.empty() && random_.chance(0.5))
        return model_.gone[random_.below(static_cast<uint32_t>(model_.gone.size()))];
      return random_.chance(0.5) ? BodyId{} : BodyId{random_.below(20), 1000 + random_.below(3)};
    }
    auto body = model_.bodies.begin();
    std::advance(body, random_.below(static_cast<uint32_t>(model_.bodies.size())));
    return body->second.first;
  }
  JointId pick_joint() {
    if (model_.joints.empty() || bad()) {
      if (!model_.joints_gone.empty() && random_.chance(0.5))
        return model_.joints_gone[random_.below(static_cast<uint32_t>(model_.joints_gone.size()))];
      return random_.chance(0.5) ? JointId{} : JointId{random_.below(12), 1000 + random_.below(3)};
    }
    auto joint = model_.joints.begin();
    std::advance(joint, random_.below(static_cast<uint32_t>(model_.joints.size())));
    return joint->second.first;
  }
  Known* find(BodyId id) {
    const auto body = model_.bodies.find(id.slot);
    return body != model_.bodies.end() && body->second.first == id ? &body->second.second : nullptr;
  }

  /// Judges a call: an id that names no body gives bad_id; `wrong` arguments give no ok; `may_fail` says that a right
  /// one may be refused as out_of_range. True if it was made.
  bool judge(const char* name, Status status, const Known* body, bool wrong, bool may_fail = false) {
    const bool refused =
        status == Status::out_of_range || status == Status::bad_argument || status == Status::not_normalised;
    if (body == nullptr) {  // the recorder looks at the arguments first
      EXPECT_TRUE(status == Status::bad_id || (wrong && refused)) << name << ": " << status_text(status);
    } else if (wrong) {
      EXPECT_TRUE(refused) << name << ": " << status_text(status);
    } else if (!((may_fail || wide_) && status == Status::out_of_range)) {
      EXPECT_STREQ(status_text(status), "ok") << name;
    }
    if (status != Status::ok) {
      EXPECT_EQ(digest(world()), before_) << name << ": " << status_text(status);
    }
    return status == Status::ok;
  }

  void create() {
    bool wrong = false;
    BodyDef def;
    def.type = type(wrong);
    def.position = place();
    def.rotation = rotation(wrong);
    if (def.type == BodyType::kinematic || def.type == BodyType::dynamic) {
      def.velocity = vector(5, wrong);
      def.spin = vector(5, wrong);
    }
    bool size_wrong = false;
    def.shape = shape(size_wrong);
    const bool plane = def.shape.type == ShapeType::half_space;
    wrong = wrong || (plane && def.type != BodyType::fixed);
    def.material = material(wrong);
    def.linear_damping = number(0, 2, wrong);
    def.angular_damping = number(0, 2, wrong);
    def.gravity_scale = number(-1, 2, wrong);
    def.mass = scaled(random_.log_uniform(0.1, 100));
    def.turn_locks = random_.chance(0.5) ? 0 : locks(wrong);
    def.filter = filter();
    def.user_data = static_cast<uint32_t>(random_.next());
    BodyId id = {99, 99};
    const Status status = recorder_->create_body(def, id);
    if (wrong || size_wrong) {  // a size that the shape doesn't use is refused by the recorder, and not by the world
      EXPECT_TRUE(status != Status::ok || (size_wrong && !wrong));
    } else if (!(wide_ && status == Status::out_of_range)) {
      EXPECT_EQ(status, model_.bodies.size() == k_bodies ? Status::pool_full : Status::ok) << status_text(status);
    }
    if (status != Status::ok) {
      EXPECT_EQ(digest(world()), before_);
      EXPECT_TRUE((id == BodyId{99, 99}));
      return;
    }
    EXPECT_EQ(model_.bodies.count(id.slot), 0u);
    Known known = {def.type,          def.shape.type, def.material,  def.linear_damping, def.angular_damping,
                   def.gravity_scale, def.mass,       def.user_data, def.turn_locks,     def.filter};
    model_.bodies[id.slot] = {id, known};
  }

  void destroy(BodyId id) {
    const bool made = judge("destroy_body", recorder_->destroy_body(id), find(id), false);
    if (!made) return;
    model_.bodies.erase(id.slot);
    model_.gone.push_back(id);
    for (auto joint = model_.joints.begin(); joint != model_.joints.end();) {
      const auto& [joint_id, def] = (joint++)->second;
      if (def.a == id || def.b == id) forget(joint_id);
    }
  }

  void forget(JointId id) {
    model_.joints_gone.push_back(id);
    model_.joints.erase(id.slot);
  }

  void create_any_joint() {
    bool wrong = false;
    JointDef def = joint(wrong);
    def.a = pick();
    def.b = pick();
    const Known *a = find(def.a), *b = find(def.b);
    if (random_.chance(0.7)) {
      const Position point = place();
      bool frame_wrong = false;
      const Quat frame = rotation(frame_wrong);
      const Status status = place_joint(world(), point, frame, def);
      if (a == nullptr || b == nullptr) {
        EXPECT_EQ(status, Status::bad_id);
      } else if (frame_wrong) {
        EXPECT_EQ(status, Status::not_normalised);
      } else {
        EXPECT_TRUE(status == Status::ok || wide_) << status_text(status);
      }
    } else {
      place_anyhow(def, wrong);
    }
    const auto dynamic = [](const Known& body) { return body.type == BodyType::dynamic; };
    if (a != nullptr && b != nullptr) wrong = wrong || def.a == def.b || (!dynamic(*a) && !dynamic(*b));
    JointId id = {99, 99};
    const Status status = recorder_->create_joint(def, id);
    if (!wrong && a != nullptr && b != nullptr && status == Status::pool_full) {
      EXPECT_EQ(model_.joints.size(), k_joints);
    } else {
      judge("create_joint", status, a != nullptr ? b : a, wrong, true);
    }
    if (status != Status::ok) {
      EXPECT_EQ(digest(world()), before_);
      EXPECT_TRUE((id == JointId{99, 99}));
      return;
    }
    EXPECT_EQ(model_.joints.count(id.slot), 0u);
    model_.joints[id.slot] = {id, def};
  }

  void change_joint() {
    const JointId id = pick_joint();
    const auto known = model_.joints.find(id.slot);
    const bool there = known != model_.joints.end() && known->second.first == id;
    const Known any, *const found = there ? &any : nullptr;
    if (random_.chance(0.3)) {
      if (judge("destroy_joint", recorder_->destroy_joint(id), found, false)) forget(id);
      return;
    }
    bool wrong = false;
    JointDef def = joint(wrong);
    place_anyhow(def, wrong);
    if (!judge("set_joint", recorder_->set_joint(id, def), found, wrong, true)) return;
    def.a = known->second.second.a;
    def.b = known->second.second.b;
    known->second.second = def;
  }

  void query() {
    bool wrong = false;
    QueryHit hit[4];
    QueryReport report;
    QueryFilter filter;
    filter.mask = random_.chance(0.5) ? ~0u : random_.below(8);
    filter.ignore = pick();
    const Position from = place();
    const Vec3<Real> way = vector(8, wrong);
    const bool all = random_.chance(0.5);
    const bool ray = random_.chance(0.5);
    const QueryHits hits = {hit, 4};
    const Status status =
        ray ? recorder_->query_ray({from, way, filter, all}, hits, report)
            : recorder_->query_overlap({sphere(real(1.5)), from, BodyDef().rotation, filter, all}, hits, report);
    EXPECT_EQ(digest(world()), before_);
    EXPECT_EQ(status, ray && wrong ? Status::out_of_range : Status::ok) << status_text(status);
    if (status != Status::ok) return;
    EXPECT_LE(report.hits, all ? 4u : 1u);
    for (uint32_t i = 0; i < report.hits; ++i) {
      const Known* body = find(hit[i].body);
      ASSERT_NE(body, nullptr);
      EXPECT_TRUE((body->filter.category & filter.mask) != 0 && (body->filter.mask & filter.category) != 0);
      EXPECT_FALSE(hit[i].body == filter.ignore);
      if (i != 0) {
        EXPECT_TRUE(!ray || !(hit[i].fraction < hit[i - 1].fraction));
      }
    }
  }

  /// A step: what breaks has borne too much, and nothing touches that may not.
  void step_once() {
    const StepReport report = recorder_->step();
    EXPECT_EQ(report.joint_events, report.joints_broken);
    for (uint32_t i = 0; i < report.joint_events; ++i) {
      const JointEvent& event = broken_[i];
      const auto known = model_.joints.find(event.joint.slot);
      ASSERT_TRUE(known != model_.joints.end() && known->second.first == event.joint);
      const JointDef& def = known->second.second;
      EXPECT_TRUE(event.a == def.a && event.b == def.b && event.user_data == def.user_data);
      const auto over = [](const Vec3<Scaled>& load, Scaled most) {
        const double bound = scaled_to_host(most);
        const Vector borne = {scaled_to_host(load.x), scaled_to_host(load.y), scaled_to_host(load.z)};
        return bound > 0 && length(borne) > bound * (1 - 1e-5);
      };
      EXPECT_TRUE(over(event.reaction.force, def.break_force) || over(event.reaction.torque, def.break_torque));
      forget(event.joint);
    }
    for (uint32_t i = 0; i < get_info(world()).contacts; ++i) {
      Contact contact;
      ASSERT_OK(get_contact(world(), i, contact));
      const Known *a = find(contact.a), *b = find(contact.b);
      ASSERT_TRUE(a != nullptr && b != nullptr);
      bool awake_a = false, awake_b = false;
      EXPECT_OK(is_awake(world(), contact.a, awake_a));
      EXPECT_OK(is_awake(world(), contact.b, awake_b));
      if (!awake_a && !awake_b) continue;  // put to sleep before the step that would have ended it
      const Filter &of_a = a->filter, &of_b = b->filter;
      if (of_a.group != 0 && of_a.group == of_b.group) {
        EXPECT_GT(of_a.group, 0);
      } else {
        EXPECT_TRUE((of_a.category & of_b.mask) != 0 && (of_b.category & of_a.mask) != 0);
      }
      for (const auto& [slot, known] : model_.joints) {
        const JointDef& def = known.second;
        const bool same = (def.a == contact.a && def.b == contact.b) || (def.a == contact.b && def.b == contact.a);
        EXPECT_TRUE(def.collide || !same) << "joint " << slot;
      }
    }
  }

  void change(BodyId id, uint32_t which) {
    Recorder& recorder = *recorder_;
    Known* body = find(id);
    const bool plane = body != nullptr && body->shape == ShapeType::half_space;
    bool wrong = false;
    switch (which) {
      case 0: {
        const BodyType to = type(wrong);
        wrong = wrong || (plane && to == BodyType::dynamic);
        if (judge("set_type", recorder.set_type(id, to), body, wrong, true)) body->type = to;
        break;
      }
      case 1: {
        bool size_wrong = false;
        const Shape to = shape(size_wrong);
        const bool to_plane = to.type == ShapeType::half_space;
        if (body != nullptr && to_plane && body->type != BodyType::fixed) wrong = body->type == BodyType::dynamic;
        const Status status = recorder.set_shape(id, to);
        if (size_wrong || (to_plane && !wrong)) {  // a size out of use, or a spin that no plane may have
          EXPECT_TRUE(status != Status::ok || body != nullptr);
        } else {
          judge("set_shape", status, body, wrong, true);
        }
        if (status == Status::ok) body->shape = to.type;
        break;
      }
      case 2: {
        const Scaled mass = scaled(random_.chance(0.1) ? -1 : random_.log_uniform(0.1, 100));
        if (judge("set_mass", recorder.set_mass(id, mass), body, scaled_to_host(mass) < 0)) body->mass = mass;
        break;
      }
      case 3: {
        const Scaled density = scaled(random_.chance(0.1) ? 0 : random_.log_uniform(0.1, 10000));
        if (judge("set_density", recorder.set_density(id, density), body, plane || scaled_to_host(density) == 0, true))
          body->mass = Scaled(0.0);
        break;
      }
      case 4: {
        const Material to = material(wrong);
        if (judge("set_material", recorder.set_material(id, to), body, wrong)) body->material = to;
        break;
      }
      case 5: {
        const Real linear = number(0, 3, wrong), angular = number(0, 3, wrong);
        if (!judge("set_damping", recorder.set_damping(id, linear, angular), body, wrong)) break;
        body->linear_damping = linear;
        body->angular_damping = angular;
        break;
      }
      case 6: {
        const Real to = number(-2, 2, wrong);
        if (judge("set_gravity_scale", recorder.set_gravity_scale(id, to), body, wrong)) body->gravity_scale = to;
        break;
      }
      case 7: {
        const uint32_t to = locks(wrong);
        if (judge("set_turn_locks", recorder.set_turn_locks(id, to), body, wrong)) body->turn_locks = to;
        break;
      }
      case 8: {
        Filter to = filter();
        if (bad()) {  // no world here has rules
          to.rule = 1;
          const Status status = recorder.set_filter(id, to);
          EXPECT_EQ(status, body != nullptr ? Status::rule_missing : Status::bad_id) << status_text(status);
          EXPECT_EQ(digest(world()), before_);
          break;
        }
        if (judge("set_filter", recorder.set_filter(id, to), body, false)) body->filter = to;
        break;
      }
      default: {
        const uint32_t to = static_cast<uint32_t>(random_.next());
        if (judge("set_user_data", recorder.set_user_data(id, to), body, false)) body->user_data = to;
        break;
      }
    }
  }

  void move(BodyId id, uint32_t which) {
    Recorder& recorder = *recorder_;
    const Known* body = find(id);
    const bool dynamic = body != nullptr && body->type == BodyType::dynamic;
    const bool still = body != nullptr && body->type == BodyType::fixed;
    const bool plane = body != nullptr && body->shape == ShapeType::half_space;
    bool wrong = !dynamic;
    const Vec3<Scaled> by = push(20);
    switch (which) {
      case 0: {
        wrong = false;
        const Position to = place();
        const Quat turned = rotation(wrong);
        judge("set_pose", recorder.set_pose(id, to, turned), body, wrong);
        break;
      }
      case 1: {
        wrong = still || plane;
        const Vec3<Real> velocity = vector(10, wrong), spin = vector(10, wrong);
        judge("set_velocity", recorder.set_velocity(id, velocity, spin), body, wrong);
        break;
      }
      case 2: {
        wrong = body != nullptr && body->type != BodyType::kinematic;
        const Position to = place();
        const Quat turned = rotation(wrong);
        judge("move_kinematic", recorder.move_kinematic(id, to, turned), body, wrong || plane, true);
        break;
      }
      case 3:
        judge("apply_force", recorder.apply_force(id, by), body, wrong, true);
        break;
      case 4:
        judge("apply_torque", recorder.apply_torque(id, by), body, wrong, true);
        break;
      case 5: {
        const Vec3<Real> arm = vector(0.2, wrong);
        judge("apply_impulse_at", recorder.apply_impulse_at(id, by, arm), body, wrong, true);
        break;
      }
      case 6: {
        const Vec3<Real> arm = vector(0.2, wrong);
        judge("apply_force_at", recorder.apply_force_at(id, by, arm), body, wrong, true);
        break;
      }
      case 7:
        judge("apply_impulse_at_point", recorder.apply_impulse_at_point(id, by, place()), body, wrong, true);
        break;
      case 8:
        judge("apply_force_at_point", recorder.apply_force_at_point(id, by, place()), body, wrong, true);
        break;
      case 9:
        judge("apply_angular_impulse", recorder.apply_angular_impulse(id, by), body, wrong, true);
        break;
      case 10:
        judge("wake_body", recorder.wake_body(id), body, wrong);
        break;
      default:
        judge("put_to_sleep", recorder.put_to_sleep(id), body, wrong);
        break;
    }
  }

  void change_world() {
    bool wrong = false;
    const Known any;
    switch (random_.below(3)) {
      case 0: {
        const Vec3<Real> gravity = vector(10, wrong);
        judge("set_gravity", recorder_->set_gravity(gravity), &any, wrong);
        break;
      }
      case 1: {
        Explosion explosion;
        explosion.centre = place();
        explosion.radius = number(0.5, 5, wrong);
        explosion.impulse = scaled(random_.uniform(-10, 10));
        judge("explode", recorder_->explode(explosion), &any, wrong, true);
        break;
      }
      default: {
        WorldDef def = get_settings(world());
        const bool too_long = bad();
        wrong = too_long;
        def.tick = too_long ? real(0.5) : real(random_.uniform(0.005, 0.05));
        def.gravity = vector(10, wrong);
        def.substeps = random_.chance(0.5) ? 0 : 1 + random_.below(6);
        def.reuse = random_.chance(0.5) ? real(0) : real(0.004);
        def.stabilisation = random_.chance(0.5) ? Stabilisation::soft : Stabilisation::post;
        def.continuous = random_.chance(0.7);
        def.sleeping = random_.chance(0.7);
        if (!judge("set_settings", recorder_->set_settings(def), &any, wrong)) break;
        const WorldDef now = get_settings(world());
        EXPECT_TRUE(now.tick == def.tick && now.gravity == def.gravity && now.substeps == def.substeps);
        EXPECT_TRUE(now.reuse == def.reuse && now.stabilisation == def.stabilisation);
        EXPECT_TRUE(now.continuous == def.continuous && now.sleeping == def.sleeping);
        break;
      }
    }
  }

  void call() {
    before_ = digest(world());
    const uint32_t which = random_.below(13);
    if (which < 2) return create();
    if (which == 2) return change_world();
    if (which == 10) return create_any_joint();
    if (which == 11) return change_joint();
    if (which == 12) return query();
    const BodyId id = pick();
    if (which == 3 && random_.chance(0.4)) return destroy(id);
    if (which < 6) return change(id, random_.below(10));
    if (which < 8) return move(id, random_.below(12));
    const uint32_t ticks = 1 + random_.below(4);
    for (uint32_t tick = 0; tick < ticks; ++tick) step_once();
  }

  static void expect_near(Real a, Real b) { EXPECT_NEAR(real_to_host(a), real_to_host(b), 1e-6); }

  void check(BodyId id, const Known& known) {
    BodyDef def;
    ASSERT_OK(get_body_def(world(), id, def));
    EXPECT_EQ(def.type, known.type);
    EXPECT_EQ(def.shape.type, known.shape);
    EXPECT_EQ(def.user_data, known.user_data);
    EXPECT_EQ(def.turn_locks, known.turn_locks);
    EXPECT_TRUE(def.filter == known.filter);
    expect_near(def.material.friction, known.material.friction);
    expect_near(def.material.restitution, known.material.restitution);
    expect_near(def.material.rolling_resistance, known.material.rolling_resistance);
    EXPECT_EQ(def.material.restitution_rule, known.material.restitution_rule);
    expect_near(def.linear_damping, known.linear_damping);
    expect_near(def.angular_damping, known.angular_damping);
    expect_near(def.gravity_scale, known.gravity_scale);
    if (scaled_to_host(known.mass) != 0) {
      EXPECT_TRUE(def.mass == known.mass);
    }
    if (known.type == BodyType::fixed) {
      EXPECT_TRUE((def.velocity == Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}));
    }
  }

  void check_joints() {
    EXPECT_EQ(get_info(world()).joints, model_.joints.size());
    JointId id = next_joint(world(), {});
    for (const auto& [slot, joint] : model_.joints) {
      EXPECT_TRUE(joint.first == id) << "joints come in the order of their slots";
      JointDef def;
      ASSERT_OK(get_joint(world(), joint.first, def));
      const JointDef& known = joint.second;
      EXPECT_TRUE(def.type == known.type && def.a == known.a && def.b == known.b);
      EXPECT_TRUE(def.anchor_a == known.anchor_a && def.anchor_b == known.anchor_b);
      for (const auto axis : {&JointDef::axis, &JointDef::second}) {
        const JointAxis &is = def.*axis, &was = known.*axis;
        EXPECT_TRUE(is.limited == was.limited && is.lower == was.lower && is.upper == was.upper);
        EXPECT_TRUE(is.frequency == was.frequency && is.damping_ratio == was.damping_ratio);
        EXPECT_TRUE(is.target == was.target && is.speed == was.speed && is.force_max == was.force_max);
      }
      EXPECT_TRUE(def.collide == known.collide && def.user_data == known.user_data);
      EXPECT_TRUE(def.break_force == known.break_force && def.break_torque == known.break_torque);
      id = next_joint(world(), id);
    }
    EXPECT_TRUE(id == JointId{});
    for (const JointId gone : model_.joints_gone) EXPECT_FALSE(is_valid(world(), gone));
  }

  void check_bodies() {
    EXPECT_EQ(get_info(world()).bodies, model_.bodies.size());
    BodyId id = next_body(world(), {});
    for (const auto& [slot, body] : model_.bodies) {
      EXPECT_TRUE(body.first == id) << "bodies come in the order of their slots";
      check(body.first, body.second);
      id = next_body(world(), id);
    }
    EXPECT_TRUE(id == BodyId{});
    for (const BodyId gone : model_.gone) EXPECT_FALSE(is_valid(world(), gone));
    const uint32_t contacts = get_info(world()).contacts;
    for (uint32_t i = 0; i < contacts; ++i) {
      Contact contact;
      EXPECT_OK(get_contact(world(), i, contact));
      EXPECT_TRUE(find(contact.a) != nullptr && find(contact.b) != nullptr);
    }
  }

  Random random_;
  const bool wide_;
  OwnedWorld owned_;
  Recorder* recorder_ = nullptr;
  Model model_;
  uint64_t before_ = 0;
  JointEvent broken_[k_joints];
};

DETENT_TEST(sequence, random_calls_do_what_is_written_of_them) {
  const uint32_t count = detent_oracle::rounds(200);
  for (uint32_t seed = 1; seed <= count; ++seed) {
    Game game(seed);
    game.play();
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
