#include <tuple>

#include "fields.h"
#include "session.h"

/// The calls that change a world. Each has the number of its record in docs/recording.md.
namespace detent_web {
namespace {

/// A kind of argument: its type, and how it is taken from the desk. In the float configurations, several kinds have the
/// same type, but different ranges.
template <class T, auto taken>
struct Kind {
  using Type = T;
  static void take(Taker& in, T& to) { taken(in, to); }
};
using Body = Kind<BodyId, [](Taker& in, BodyId& to) { visit(in, to); }>;
using Joint = Kind<JointId, [](Taker& in, JointId& to) { visit(in, to); }>;
using Place = Kind<Position, [](Taker& in, Position& to) { visit_position(in, to); }>;
using Rotation = Kind<Quat, [](Taker& in, Quat& to) { visit(in, to); }>;
using Vector = Kind<Vec3<Real>, [](Taker& in, Vec3<Real>& to) { visit_reals(in, to); }>;
using Push = Kind<Vec3<Scaled>, [](Taker& in, Vec3<Scaled>& to) { visit_scaleds(in, to); }>;
using Number = Kind<Real, [](Taker& in, Real& to) { in.real(to); }>;
using Wide = Kind<Scaled, [](Taker& in, Scaled& to) { in.scaled(to); }>;
using Word = Kind<uint32_t, [](Taker& in, uint32_t& to) { in.word(to); }>;
using Flag = Kind<bool, [](Taker& in, bool& to) { in.flag(to); }>;
using Type = Kind<BodyType, [](Taker& in, BodyType& to) { in.choice(to); }>;
template <class T>
using Fields = Kind<T, [](Taker& in, T& to) { visit(in, to); }>;

template <class... Kinds, class Call>
Status make(Session& session, Taker& in, Call call) {
  std::tuple<typename Kinds::Type...> arguments{};
  std::apply([&in](auto&... argument) { (Kinds::take(in, argument), ...); }, arguments);
  if (in.status != Status::ok) return in.status;
  return std::apply([&](auto&... argument) { return (session.recorder->*call)(argument...); }, arguments);
}

/// A call that gives an id.
template <class Def, class Id, class Call>
Status create(Session& session, Taker& in, Call call) {
  Def def;
  visit(in, def);
  if (in.status != Status::ok) return in.status;
  Id id;
  const Status status = (session.recorder->*call)(def, id);
  Giver out;
  if (status == Status::ok) visit(out, id);
  return status;
}

Status call_body(Session& session, Taker& in, uint32_t call) {
  switch (call) {
    case 1:
      return create<BodyDef, BodyId>(session, in, &Recorder::create_body);
    case 2:
      return make<Body>(session, in, &Recorder::destroy_body);
    case 3:
      return make<Body, Place, Rotation>(session, in, &Recorder::set_pose);
    case 4:
      return make<Body, Vector, Vector>(session, in, &Recorder::set_velocity);
    case 5:
      return make<Body, Push>(session, in, &Recorder::apply_force);
    case 6:
      return make<Body, Push>(session, in, &Recorder::apply_torque);
    case 7:
      return make<Body, Push>(session, in, &Recorder::apply_impulse);
    case 8:
      return make<Body, Push, Vector>(session, in, &Recorder::apply_impulse_at);
    case 9:
      return make<Body, Push>(session, in, &Recorder::apply_angular_impulse);
    case 11:
      return make<Body, Word>(session, in, &Recorder::set_user_data);
    case 15:
      return make<Body>(session, in, &Recorder::wake_body);
    case 16:
      return make<Body>(session, in, &Recorder::sleep_body);
    case 32:
      return make<Body, Type>(session, in, &Recorder::set_type);
    case 33:
      return make<Body, Fields<Shape>>(session, in, &Recorder::set_shape);
    case 34:
      return make<Body, Wide>(session, in, &Recorder::set_mass);
    case 35:
      return make<Body, Wide>(session, in, &Recorder::set_density);
    case 36:
      return make<Body, Fields<Material>>(session, in, &Recorder::set_material);
    case 37:
      return make<Body, Number, Number>(session, in, &Recorder::set_damping);
    case 38:
      return make<Body, Number>(session, in, &Recorder::set_gravity_scale);
    case 39:
      return make<Body, Word>(session, in, &Recorder::set_rotation_locks);
    case 41:
      return make<Body, Push, Vector>(session, in, &Recorder::apply_force_at);
    case 42:
      return make<Body, Push, Place>(session, in, &Recorder::apply_force_at_point);
    case 43:
      return make<Body, Push, Place>(session, in, &Recorder::apply_impulse_at_point);
    case 45:
      return make<Body, Place, Rotation>(session, in, &Recorder::move_kinematic);
    case 46:
      return make<Body, Flag>(session, in, &Recorder::set_sensor);
    case 48:
      return make<Body, Fields<Filter>>(session, in, &Recorder::set_filter);
    case 50:
      return make<Body, Push>(session, in, &Recorder::set_inertia);
    default:
      return Status::bad_argument;
  }
}

Status call_world(Session& session, Taker& in, uint32_t call) {
  switch (call) {
    case 10:
      return make<Vector>(session, in, &Recorder::set_gravity);
    case 12:
      return make<Word>(session, in, &Recorder::bind_asset);
    case 40:
      return make<Fields<WorldDef>>(session, in, &Recorder::set_settings);
    case 44:
      return make<Fields<Explosion>>(session, in, &Recorder::explode);
    case 64:
      return create<JointDef, JointId>(session, in, &Recorder::create_joint);
    case 65:
      return make<Joint>(session, in, &Recorder::destroy_joint);
    case 66:
      return make<Joint, Fields<JointDef>>(session, in, &Recorder::set_joint);
    default:
      return call_body(session, in, call);
  }
}

}  // namespace

/// Makes the call with this number; its arguments are `count` doubles on the desk.
DETENT_WEB(world_call) uint32_t world_call(Session* session, uint32_t call, uint32_t count) {
  Taker in(count);
  return static_cast<uint32_t>(call_world(*session, in, call));
}

}  // namespace detent_web
