#include <math.h>

#include <algorithm>

#include "tests/campaigns/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void expect_near(Real a, Real b) {
  const double expected = real_to_host(b);
  EXPECT_NEAR(real_to_host(a), expected, 1e-6 * (1 + fabs(expected)));
}
void expect_near(const Vec3<Real>& a, const Vec3<Real>& b) {
  expect_near(a.x, b.x);
  expect_near(a.y, b.y);
  expect_near(a.z, b.z);
}
bool is_none(const Vec3<Real>& v) { return v == Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}; }

/// In the sizes that its type uses.
void expect_same(const Shape& is, const Shape& was) {
  ASSERT_EQ(is.type, was.type);
  switch (was.type) {
    case ShapeType::box:
      expect_near(is.half_extents, was.half_extents);
      break;
    case ShapeType::hull:
      EXPECT_EQ(is.asset, was.asset);
      break;
    case ShapeType::terrain:
    case ShapeType::compound:
      EXPECT_EQ(is.asset, was.asset);
      return;
    case ShapeType::half_space:
    case ShapeType::triangle:
      return;
    default:
      expect_near(is.radius, was.radius);
      if (was.type != ShapeType::sphere) expect_near(is.half_length, was.half_length);
      break;
  }
  expect_near(is.rounding, was.rounding);
}

}  // namespace

/// A body, or an id that names none.
BodyId Game::pick() {
  if (model_.bodies.empty() || draw_.bad()) {
    if (!model_.gone.empty() && draw_.chance(0.5))
      return model_.gone[draw_.below(static_cast<uint32_t>(model_.gone.size()))];
    if (draw_.chance(0.5)) return {};
    const uint32_t slot = draw_.below(20), generation = 1000 + draw_.below(3);
    return {slot, generation};
  }
  auto body = model_.bodies.begin();
  std::advance(body, draw_.below(static_cast<uint32_t>(model_.bodies.size())));
  return body->second.first;
}

/// Assets 0 and 1 are surfaces, 2 and 3 hulls, 4 is a compound.
bool Game::lacks_asset(const Shape& shape) const {
  constexpr ShapeType k_types[] = {ShapeType::terrain, ShapeType::terrain, ShapeType::hull, ShapeType::hull,
                                   ShapeType::compound};
  if (shape.type != ShapeType::terrain && shape.type != ShapeType::hull && shape.type != ShapeType::compound)
    return false;
  return shape.asset > 4 || k_types[shape.asset] != shape.type || (model_.bound >> shape.asset & 1) == 0;
}

void Game::create() {
  bool wrong = false;
  BodyDef def;
  def.type = draw_.type(wrong);
  def.position = draw_.place();
  def.rotation = draw_.rotation(wrong);
  if (def.type == BodyType::kinematic || def.type == BodyType::dynamic) {
    def.linear_velocity = draw_.vector(5, wrong);
    def.angular_velocity = draw_.vector(5, wrong);
  }
  bool size_wrong = false;
  def.shape = draw_.shape(size_wrong);
  wrong = wrong || lacks_asset(def.shape) || (def.shape.type == ShapeType::half_space && def.type != BodyType::fixed) ||
          (def.shape.type == ShapeType::terrain && def.type == BodyType::dynamic);
  def.material = draw_.material(wrong);
  def.linear_damping = draw_.number(0, 2, wrong);
  def.angular_damping = draw_.number(0, 2, wrong);
  def.gravity_scale = draw_.number(-1, 2, wrong);
  def.mass = scaled(draw_.order(0.1, 100));
  def.rotation_locks = draw_.chance(0.5) ? 0 : draw_.locks(wrong);
  def.filter = draw_.filter();
  def.user_data = draw_.word();
  def.sensor = draw_.chance(0.15);
  BodyId id = {99, 99};
  const Status status = recorder_->create_body(def, id);
  note(static_cast<uint64_t>(status));
  note(id);
  if (wrong || size_wrong) {  // a number that cannot be recorded is refused also where the shape does not use it
    EXPECT_TRUE(status != Status::ok || !wrong);
  } else if (!(draw_.wide() && status == Status::out_of_range)) {
    const bool full = model_.bodies.size() == k_bodies || (def.sensor && capacity().sensed == 0);
    EXPECT_EQ(status, full ? Status::pool_full : Status::ok) << status_text(status);
  }
  if (status != Status::ok) {
    expect_unchanged();
    EXPECT_TRUE((id == BodyId{99, 99}));
    return;
  }
  EXPECT_EQ(model_.bodies.count(id.slot), 0u);
  for (uint32_t slot = 1; slot < id.slot; ++slot) EXPECT_EQ(model_.bodies.count(slot), 1u) << "the lowest free slot";
  Known known = {def.type,          def.shape, def.material,  def.linear_damping, def.angular_damping,
                 def.gravity_scale, def.mass,  def.user_data, def.rotation_locks, def.filter,
                 def.sensor};
  model_.bodies[id.slot] = {id, known};
}

void Game::destroy(BodyId id) {
  if (judge("destroy_body", recorder_->destroy_body(id), model_.find(id) != nullptr, false)) model_.forget(id);
}

void Game::change(BodyId id, uint32_t which) {
  Recorder& recorder = *recorder_;
  Known* body = model_.find(id);
  const bool there = body != nullptr;
  bool wrong = false;
  switch (which) {
    case 10: {
      const bool to = draw_.chance(0.5);
      const Status status = recorder.set_sensor(id, to);
      if (there && to && capacity().sensed == 0) {
        note(static_cast<uint64_t>(status));
        EXPECT_EQ(status, Status::pool_full);
        expect_unchanged();
      } else if (judge("set_sensor", status, there, false)) {
        body->sensor = to;
      }
      break;
    }
    case 0: {
      const BodyType to = draw_.type(wrong);
      wrong = wrong || (there && body->open() && to == BodyType::dynamic);
      if (judge("set_type", recorder.set_type(id, to), there, wrong, true)) body->type = to;
      break;
    }
    case 1:
      change_shape(id);
      break;
    case 2: {
      const Scaled mass = scaled(draw_.chance(0.1) ? -1 : draw_.order(0.1, 100));
      if (judge("set_mass", recorder.set_mass(id, mass), there, scaled_to_host(mass) < 0)) body->mass = mass;
      break;
    }
    case 3: {
      Vec3<Scaled> inertia = {};
      EXPECT_EQ(get_inertia(world(), id, inertia), there ? Status::ok : Status::bad_id);
      wrong = there && (body->type != BodyType::dynamic || draw_.chance(0.1));
      for (Scaled* about : {&inertia.x, &inertia.y, &inertia.z})
        *about = scaled(scaled_to_host(*about) * draw_.order(0.5, 1) * (wrong ? -1 : 1));
      judge("set_inertia", recorder.set_inertia(id, inertia), there, wrong, true);
      break;
    }
    case 4: {
      const Scaled density = scaled(draw_.chance(0.1) ? 0 : draw_.order(0.1, 10000));
      wrong = scaled_to_host(density) == 0 || (there && body->open());
      if (judge("set_density", recorder.set_density(id, density), there, wrong, true)) body->mass = Scaled(0.0);
      break;
    }
    case 5: {
      const Material to = draw_.material(wrong);
      if (judge("set_material", recorder.set_material(id, to), there, wrong)) body->material = to;
      break;
    }
    case 6: {
      const Real linear = draw_.number(0, 3, wrong), angular = draw_.number(0, 3, wrong);
      if (!judge("set_damping", recorder.set_damping(id, linear, angular), there, wrong)) break;
      body->linear_damping = linear;
      body->angular_damping = angular;
      break;
    }
    case 7: {
      const Real to = draw_.number(-2, 2, wrong);
      if (judge("set_gravity_scale", recorder.set_gravity_scale(id, to), there, wrong)) body->gravity_scale = to;
      break;
    }
    case 8: {
      const uint32_t to = draw_.locks(wrong);
      if (judge("set_rotation_locks", recorder.set_rotation_locks(id, to), there, wrong)) body->rotation_locks = to;
      break;
    }
    case 9:
      change_filter(id);
      break;
    default: {
      const uint32_t to = draw_.word();
      if (judge("set_user_data", recorder.set_user_data(id, to), there, false)) body->user_data = to;
      break;
    }
  }
}

void Game::change_shape(BodyId id) {
  Known* body = model_.find(id);
  bool size_wrong = false;
  const Shape to = draw_.shape(size_wrong);
  const bool plane = to.type == ShapeType::half_space;
  const bool open = plane || to.type == ShapeType::terrain;
  const bool wrong = lacks_asset(to) || (open && body != nullptr && body->type == BodyType::dynamic);
  const Status status = recorder_->set_shape(id, to);
  if (size_wrong || (plane && !wrong)) {  // a size out of use, or an angular velocity that no plane may have
    note(static_cast<uint64_t>(status));
    EXPECT_TRUE(status != Status::ok || (body != nullptr && !wrong));
    if (status != Status::ok) expect_unchanged();
  } else {
    judge("set_shape", status, body != nullptr, wrong, true);
  }
  if (status == Status::ok) body->shape = to;
}

void Game::change_filter(BodyId id) {
  Known* body = model_.find(id);
  Filter to = draw_.filter();
  if (!draw_.bad()) {
    if (judge("set_filter", recorder_->set_filter(id, to), body != nullptr, false)) body->filter = to;
    return;
  }
  to.rule = 2;  // which is not there
  const Status status = recorder_->set_filter(id, to);
  EXPECT_EQ(status, body != nullptr ? Status::rule_missing : Status::bad_id) << status_text(status);
  expect_unchanged();
}

void Game::move(BodyId id) {
  const Known* body = model_.find(id);
  const bool there = body != nullptr, plane = there && body->plane();
  bool wrong = there && body->type != BodyType::dynamic;
  switch (draw_.below(5)) {
    case 0: {
      wrong = false;
      const Position to = draw_.place();
      const Quat turned = draw_.rotation(wrong);
      if (!judge("set_pose", recorder_->set_pose(id, to, turned), there, wrong)) break;
      Pose pose;
      EXPECT_OK(get_pose(world(), id, pose));
      EXPECT_TRUE(pose.position == to);
      break;
    }
    case 1: {
      wrong = there && (body->type == BodyType::fixed || plane);
      const Vec3<Real> linear_velocity = draw_.vector(10, wrong), angular_velocity = draw_.vector(10, wrong);
      if (!judge("set_velocity", recorder_->set_velocity(id, linear_velocity, angular_velocity), there, wrong)) break;
      Vec3<Real> now, turning;
      EXPECT_OK(get_velocity(world(), id, now, turning));
      expect_near(now, linear_velocity);
      break;
    }
    case 2: {
      wrong = there && (body->type != BodyType::kinematic || plane);
      const Position to = draw_.place();
      const Quat turned = draw_.rotation(wrong);
      judge("move_kinematic", recorder_->move_kinematic(id, to, turned), there, wrong, true);
      break;
    }
    case 3:
      judge("wake_body", recorder_->wake_body(id), there, wrong);
      break;
    default: {
      if (!judge("sleep_body", recorder_->sleep_body(id), there, wrong)) break;
      bool awake = true;
      EXPECT_OK(is_awake(world(), id, awake));
      EXPECT_FALSE(awake);
      break;
    }
  }
}

void Game::push(BodyId id) {
  Recorder& recorder = *recorder_;
  const Known* body = model_.find(id);
  const bool there = body != nullptr;
  bool wrong = there && body->type != BodyType::dynamic;
  const Vec3<Scaled> by = draw_.push(20);
  switch (draw_.below(8)) {
    case 0:
      judge("apply_force", recorder.apply_force(id, by), there, wrong, true);
      break;
    case 1:
      judge("apply_torque", recorder.apply_torque(id, by), there, wrong, true);
      break;
    case 2:
      judge("apply_impulse", recorder.apply_impulse(id, by), there, wrong, true);
      break;
    case 3:
      judge("apply_angular_impulse", recorder.apply_angular_impulse(id, by), there, wrong, true);
      break;
    case 4: {
      const Vec3<Real> arm = draw_.vector(0.2, wrong);
      judge("apply_impulse_at", recorder.apply_impulse_at(id, by, arm), there, wrong, true);
      break;
    }
    case 5: {
      const Vec3<Real> arm = draw_.vector(0.2, wrong);
      judge("apply_force_at", recorder.apply_force_at(id, by, arm), there, wrong, true);
      break;
    }
    case 6:
      judge("apply_impulse_at_point", recorder.apply_impulse_at_point(id, by, draw_.place()), there, wrong, true);
      break;
    default:
      judge("apply_force_at_point", recorder.apply_force_at_point(id, by, draw_.place()), there, wrong, true);
      break;
  }
}

/// Who is within it.
void Game::read_sensor(BodyId id) {
  const Known* body = model_.find(id);
  BodyId within[k_sensed];
  uint32_t count = 0;
  const uint32_t room = draw_.below(k_sensed + 1);
  const Status status = get_sensed(world(), id, room == 0 ? nullptr : within, room, count);
  EXPECT_EQ(status, body == nullptr ? Status::bad_id : body->sensor ? Status::ok : Status::bad_argument);
  if (status != Status::ok) return;
  ASSERT_LE(count, capacity().sensed);
  note(uint64_t{count});
  for (uint32_t i = 0; i < std::min(count, room); ++i) {
    const Known* other = model_.find(within[i]);
    ASSERT_NE(other, nullptr);
    EXPECT_FALSE(other->sensor || within[i] == id);
    EXPECT_TRUE(i == 0 || within[i - 1].slot < within[i].slot);
    note(within[i]);
  }
}

/// The triangles of a surface, in their order.
void Game::read_triangles(BodyId id) {
  const Known* body = model_.find(id);
  struct Visited {
    Game& game;
    uint32_t count = 0, last = 0;
  } visited = {*this};
  const auto visit = [](void* user, const BodyTriangle& triangle) {
    Visited& so_far = *static_cast<Visited*>(user);
    EXPECT_TRUE(so_far.count == 0 || so_far.last < triangle.index);
    so_far.last = triangle.index;
    if (so_far.count++ % 16 == 0) so_far.game.note_number(real(coord_to_host(triangle.corner[1].y)));
  };
  const bool is_terrain = body != nullptr && body->shape.type == ShapeType::terrain;
  const Status status = visit_triangles(world(), id, &visited, visit);
  EXPECT_EQ(status, body == nullptr ? Status::bad_id : is_terrain ? Status::ok : Status::bad_argument);
  EXPECT_EQ(visited.count != 0, is_terrain);
  note(uint64_t{visited.count});
}

/// One by one what get_body_def() gives at once.
void Game::read_parts(BodyId id, const Known& body) {
  BodyType type;
  Shape shape;
  Material material;
  Filter filter;
  Real linear, angular, scale;
  uint32_t locks = 8, user_data = 0;
  bool sensor = false;
  EXPECT_OK(get_type(world(), id, type));
  EXPECT_OK(get_shape(world(), id, shape));
  EXPECT_OK(get_material(world(), id, material));
  EXPECT_OK(get_damping(world(), id, linear, angular));
  EXPECT_OK(get_gravity_scale(world(), id, scale));
  EXPECT_OK(get_rotation_locks(world(), id, locks));
  EXPECT_OK(get_user_data(world(), id, user_data));
  EXPECT_OK(get_filter(world(), id, filter));
  EXPECT_OK(get_sensor(world(), id, sensor));
  EXPECT_EQ(type, body.type);
  expect_same(shape, body.shape);
  expect_near(material.friction, body.material.friction);
  expect_near(linear, body.linear_damping);
  expect_near(angular, body.angular_damping);
  expect_near(scale, body.gravity_scale);
  EXPECT_TRUE(locks == body.rotation_locks && user_data == body.user_data && filter == body.filter &&
              sensor == body.sensor);
}

/// What else can be asked of a body.
void Game::read(BodyId id) {
  const Known* body = model_.find(id);
  const Status expected = body != nullptr ? Status::ok : Status::bad_id;
  Scaled mass = 0.0;
  Vec3<Scaled> inertia = {};
  Vec3<Real> linear_velocity = {}, angular_velocity = {}, at = {};
  bool awake = false, wrong = false;
  EXPECT_EQ(get_mass(world(), id, mass), expected);
  EXPECT_EQ(get_inertia(world(), id, inertia), expected);
  EXPECT_EQ(get_velocity(world(), id, linear_velocity, angular_velocity), expected);
  EXPECT_EQ(is_awake(world(), id, awake), expected);
  const Vec3<Real> arm = draw_.vector(0.2, wrong);
  judge("get_velocity_at", get_velocity_at(world(), id, arm, at), body != nullptr, wrong, true);
  expect_unchanged();
  if (body == nullptr) return;
  read_parts(id, *body);
  if (body->type != BodyType::dynamic) {
    EXPECT_TRUE(mass == Scaled(0.0) && inertia.x == Scaled(0.0) && inertia.y == Scaled(0.0) &&
                inertia.z == Scaled(0.0));
  } else {
    EXPECT_GT(scaled_to_host(mass), 0);
  }
  if (body->type == BodyType::fixed) {
    EXPECT_TRUE(is_none(linear_velocity) && is_none(angular_velocity) && !awake);
  }
  note_number(mass);
  note(inertia);
  note(linear_velocity);
  note(angular_velocity);
  note(at);
  note(uint64_t{awake});
  uint32_t count = 0;
  for (uint32_t i = next_contact(world(), id, 0); i < get_info(world()).contacts;
       i = next_contact(world(), id, i + 1)) {
    Contact contact;
    ASSERT_OK(get_contact(world(), i, contact));
    EXPECT_TRUE(contact.a == id || contact.b == id);
    ++count;
  }
  note(uint64_t{count});
  EXPECT_TRUE(count == 0 || !body->sensor);
}

void Game::check(BodyId id, const Known& known) {
  BodyDef def;
  ASSERT_OK(get_body_def(world(), id, def));
  EXPECT_EQ(def.type, known.type);
  expect_same(def.shape, known.shape);
  EXPECT_EQ(def.user_data, known.user_data);
  EXPECT_EQ(def.rotation_locks, known.rotation_locks);
  EXPECT_TRUE(def.filter == known.filter && def.sensor == known.sensor);
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
    EXPECT_TRUE(is_none(def.linear_velocity));
  }
}

void Game::check_bodies() {
  EXPECT_EQ(get_info(world()).bodies, model_.bodies.size());
  BodyId id = next_body(world(), {});
  for (const auto& [slot, body] : model_.bodies) {
    EXPECT_TRUE(body.first == id) << "bodies come in the order of their slots";
    check(body.first, body.second);
    id = next_body(world(), id);
  }
  EXPECT_TRUE(id == BodyId{});
  for (const BodyId gone : model_.gone) EXPECT_FALSE(is_valid(world(), gone));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
