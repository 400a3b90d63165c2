#include "match.h"
#include "replay/command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// Writes, reads and writes a command again. The bytes must be equal, and no shorter prefix of them may be accepted.
template <class Command>
void expect_round_trip(Command command) {
  Normaliser normaliser;
  visit(normaliser, command);
  EXPECT_EQ(normaliser.status, Status::ok);
  uint8_t first[512] = {};
  Writer writer{first, sizeof first};
  visit(writer, command);
  ASSERT_FALSE(writer.full);
  EXPECT_LE(writer.count, sizeof(Command));

  const CommandCode* const code = find_command(Command::k_tag);
  ASSERT_NE(code, nullptr);
  alignas(8) uint8_t read[k_command_bytes_max] = {};
  Reader reader{first, writer.count};
  code->visit(reader, read);
  EXPECT_EQ(reader.failed, nullptr) << reader.failed;
  EXPECT_EQ(reader.at, writer.count);
  uint8_t second[512] = {};
  Writer again{second, sizeof second};
  code->visit(again, read);
  EXPECT_EQ(again.count, writer.count);
  EXPECT_EQ(memcmp(first, second, sizeof first), 0);
  for (uint32_t count = 0; count < writer.count; ++count) {
    Reader part{first, count};
    Command cut;
    visit(part, cut);
    EXPECT_NE(part.failed, nullptr);
    EXPECT_LE(part.at, count);
  }
}

constexpr BodyId k_id = {0x01020304, 0xf0f1f2f3};
const Vec3<Real> k_reals = {Real(1.25), Real(-2.5), Real(0.0)};
const Vec3<Real> k_more_reals = {Real(-1024.0), Real(0.0078125), Real(3.0)};
const Vec3<Scaled> k_scaled = {Scaled(1e12), Scaled(-1e-9), Scaled(0.0)};
const Position k_position = {Coord(-100.5), Coord(0.0), Coord(20000.25)};
const Quat k_rotation = {Unit(0.0), Unit(-0.6), Unit(0.0), Unit(0.8)};

}  // namespace

DETENT_TEST(replay_round_trip, every_command_survives_writing_and_reading) {
  CreateBody create;
  create.id = k_id;
  create.def.type = BodyType::kinematic;
  create.def.position = k_position;
  create.def.rotation = k_rotation;
  create.def.linear_velocity = k_reals;
  create.def.angular_velocity = k_more_reals;
  create.def.shape = capsule(Real(0.75), Real(2.0));
  create.def.material = {Real(0.25), Real(0.5), Real(0.125), RestitutionRule::smaller};
  create.def.density = Scaled(7850.0);
  create.def.mass = Scaled(3e-5);
  create.def.linear_damping = Real(0.5);
  create.def.angular_damping = Real(1.5);
  create.def.gravity_scale = Real(-2.0);
  create.def.user_data = 0xdeadbeef;
  create.def.rotation_locks = 6;
  create.def.sensor = true;
  create.def.filter = {6, 0x80000001, -7, 3};
  expect_round_trip(create);
  create.def.shape = rounded(hull(0x12345678), Real(0.375));
  expect_round_trip(create);
  expect_round_trip(DestroyBody{k_id});
  expect_round_trip(SetPose{k_id, k_position, k_rotation});
  expect_round_trip(SetVelocity{k_id, k_reals, k_more_reals});
  expect_round_trip(ApplyForce{k_id, k_scaled});
  expect_round_trip(ApplyTorque{k_id, k_scaled});
  expect_round_trip(ApplyImpulse{k_id, k_scaled});
  expect_round_trip(ApplyImpulseAt{k_id, k_scaled, k_more_reals});
  expect_round_trip(ApplyAngularImpulse{k_id, k_scaled});
  expect_round_trip(SetGravity{k_more_reals});
  expect_round_trip(SetUserData{k_id, 0x80000001});
  expect_round_trip(BindAsset{0x12345678});
  expect_round_trip(WakeBody{k_id});
  expect_round_trip(SleepBody{k_id});
  expect_round_trip(SetFilter{k_id, {6, 0x80000001, INT32_MIN, 3}});
  JointDef joint;
  joint.type = JointType::wheel;
  joint.a = {7, 8};
  joint.b = {9, 10};
  joint.anchor_a = k_reals;
  joint.anchor_b = k_more_reals;
  joint.frame_a = k_rotation;
  joint.axis = {true, Real(-0.5), Real(0.75), Real(2.0), Real(0.5), Real(0.25), Real(-3.0), Scaled(1e9)};
  joint.second = {false, Real(0.0), Real(1.0), Real(0.0), Real(1.0), Real(0.0), Real(40.0), Scaled(50.0)};
  joint.collide = true;
  joint.break_force = 1e6;
  joint.break_torque = 1e-6;
  joint.friction_force = 0.25;
  joint.friction_torque = 1e9;
  joint.user_data = 0xfeedbeef;
  expect_round_trip(CreateJoint{{11, 12}, joint});
  expect_round_trip(DestroyJoint{{11, 12}});
  expect_round_trip(SetJoint{{11, 12}, joint});
  expect_round_trip(SetType{k_id, BodyType::kinematic});
  expect_round_trip(SetShape{k_id, rounded(box({Real(0.25), Real(0.5), Real(2.0)}), Real(0.125))});
  expect_round_trip(SetMass{k_id, Scaled(1e-9)});
  expect_round_trip(SetInertia{k_id, {Scaled(1e-9), Scaled(2.0), Scaled(3e5)}});
  expect_round_trip(SetDensity{k_id, Scaled(7850.0)});
  expect_round_trip(SetMaterial{k_id, {Real(0.25), Real(0.5), Real(0.125), RestitutionRule::smaller}});
  expect_round_trip(SetDamping{k_id, Real(0.5), Real(0.25)});
  expect_round_trip(SetGravityScale{k_id, Real(-2.0)});
  expect_round_trip(SetRotationLocks{k_id, 5});
  expect_round_trip(SetSensor{k_id, true});
  WorldDef def;
  def.gravity = k_reals;
  def.substeps = 0x01020304;
  def.stabilisation = Stabilisation::post;
  def.continuous = false;
  def.reduction = ManifoldReduction::deepest_area;
  expect_round_trip(SetSettings{def});
  expect_round_trip(ApplyForceAt{k_id, k_scaled, k_more_reals});
  expect_round_trip(ApplyForceAtPoint{k_id, k_scaled, k_position});
  expect_round_trip(ApplyImpulseAtPoint{k_id, k_scaled, k_position});
  expect_round_trip(Explode{{k_position, Real(3.0), Scaled(-50.0)}});
  expect_round_trip(MoveKinematic{k_id, k_position, k_rotation});
}

DETENT_TEST(replay_round_trip, a_tag_of_no_call_is_unknown) {
  for (uint32_t tag = 0; tag < 256; ++tag) {
    EXPECT_EQ(find_command(static_cast<RecordTag>(tag)) != nullptr, (tag >= 1 && tag <= 12) || tag == 15 || tag == 16 ||
                                                                        (tag >= 32 && tag <= 46) || tag == 48 ||
                                                                        tag == 50 || (tag >= 64 && tag <= 66))
        << tag;
  }
}

DETENT_TEST(replay_round_trip, integers_are_little_endian_on_every_machine) {
  uint8_t bytes[16] = {};
  Writer writer{bytes, sizeof bytes};
  SetUserData command{{0x04030201, 0x08070605}, 0x0c0b0a09};
  visit(writer, command);
  for (uint32_t i = 0; i < 12; ++i) EXPECT_EQ(bytes[i], i + 1);
}

DETENT_TEST(replay_round_trip, an_enumeration_outside_its_list_is_refused) {
  for (uint32_t value = 0; value < 256; ++value) {
    const uint8_t byte = static_cast<uint8_t>(value);
    Reader reader{&byte, 1};
    ShapeType type = ShapeType::sphere;
    visit_choice(reader, "shape type", type, ShapeType::sphere, ShapeType::half_space);
    EXPECT_EQ(reader.failed == nullptr, value >= 1 && value <= 4) << value;
  }
}

#if DETENT_FIXED
DETENT_TEST(replay_round_trip, a_scaled_number_that_is_not_canonical_is_refused) {
  const Scaled wrong[] = {Scaled::from_parts(0, 1),         Scaled::from_parts(1, 0),
                          Scaled::from_parts(1 << 29, 0),   Scaled::from_parts(-(1 << 29), 0),
                          Scaled::from_parts(1 << 30, 257), Scaled::from_parts(1 << 30, -257),
                          Scaled::from_parts(INT32_MIN, 0)};
  for (Scaled value : wrong) {
    Normaliser normaliser;
    visit_number(normaliser, "mass", value);
    EXPECT_EQ(normaliser.status, Status::out_of_range);
    uint8_t bytes[8];
    Writer writer{bytes, sizeof bytes};
    visit_number(writer, "mass", value);
    Reader reader{bytes, sizeof bytes};
    visit_number(reader, "mass", value);
    EXPECT_STREQ(reader.failed, "mass");
  }
}
#else
DETENT_TEST(replay_round_trip, not_a_number_infinity_and_negative_zero_are_refused) {
  const Real wrong[] = {__builtin_nanf(""), __builtin_inff(), -__builtin_inff(), Real(-0.0)};
  for (Real value : wrong) {
    uint8_t bytes[8];
    Writer writer{bytes, sizeof bytes};
    visit_number(writer, "friction", value);
    Reader reader{bytes, writer.count};
    Real read = 0;
    visit_number(reader, "friction", read);
    EXPECT_STREQ(reader.failed, "friction");
  }
}

DETENT_TEST(replay_round_trip, a_negative_zero_becomes_zero_before_it_is_applied) {
  Real value = Real(-0.0);
  Normaliser normaliser;
  visit_number(normaliser, "friction", value);
  EXPECT_EQ(normaliser.status, Status::ok);
  EXPECT_FALSE(__builtin_signbit(value));
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
