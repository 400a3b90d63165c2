#include "examples/scenes/traffic.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace traffic {

namespace {

constexpr uint32_t k_mover = 1;  ///< the body indices, in slot order
constexpr uint32_t k_first_box = 2;
constexpr uint32_t k_boxes = 5;
constexpr uint32_t k_guest = k_first_box + k_boxes;  ///< comes and goes: each time with a new generation

void invite_guest(Recorder& recorder, uint32_t tick) {
  BodyDef guest;
  guest.position = {0.5, 3.0, 0.125};
  guest.linear_velocity = {Real(0.0), Real(-2.0), Real(0.0)};
  guest.angular_velocity = {Real(0.0), Real(1.0), Real(3.0)};
  guest.mass = Scaled(48.0);
  guest.gravity_scale = Real(1.5);
  guest.shape = tick % 80 == 0 ? sphere(Real(0.375)) : capsule(Real(0.25), Real(0.25));
  make_body(recorder, guest);
}

}  // namespace

WorldDef world() { return world_of(10, 40); }

void build(Recorder& recorder) {
  make_ground(recorder);
  BodyDef mover;
  mover.type = BodyType::kinematic;
  mover.shape = box({0.25, 0.5, 1.0});
  mover.position = {-3.0, 0.5, 0.0};
  mover.linear_velocity = {Real(1.0), Real(0.0), Real(0.0)};
  make_body(recorder, mover);
  BodyDef crate;
  crate.shape = box({0.25, 0.375, 0.25});
  crate.position = {-1.5, 0.4375, 0.0};
  crate.linear_damping = Real(0.125);
  crate.angular_damping = Real(0.25);
  for (uint32_t i = 0; i < k_boxes; ++i) {
    crate.user_data = i;
    make_body(recorder, crate);
    crate.position.x += Coord(0.75);
  }
}

void before_tick(Recorder& recorder, uint32_t tick) {
  const World& state = recorder.world();
  const BodyId mover = nth_body(state, k_mover);
  const BodyId box = nth_body(state, k_first_box + tick / 8 % k_boxes);
  // The mover sweeps to and fro, and turns half way.
  if (tick % 120 == 60) must(recorder.set_velocity(mover, {-1.0, 0.0, 0.0}, {0.0, 0.25, 0.0}));
  if (tick % 120 == 0) must(recorder.set_velocity(mover, {1.0, 0.0, 0.0}, {0.0, -0.25, 0.0}));
  if (tick == 200) must(recorder.set_pose(mover, {3.0, 0.5, 0.0}, {Unit(0.0), Unit(0.6), Unit(0.0), Unit(0.8)}));

  if (tick % 40 == 0) {
    if (tick != 0) must(recorder.destroy_body(nth_body(state, k_guest)));
    invite_guest(recorder, tick);
  }
  switch (tick % 8) {
    case 0:
      must(recorder.apply_impulse(box, {Scaled(0.0), Scaled(256.0), Scaled(0.0)}));
      break;
    case 1:
      must(recorder.apply_force(box, {Scaled(512.0), Scaled(0.0), Scaled(-512.0)}));
      break;
    case 2:
      must(recorder.apply_torque(box, {Scaled(0.0), Scaled(64.0), Scaled(0.0)}));
      break;
    case 3:
      must(recorder.apply_impulse_at(box, {Scaled(16.0), Scaled(0.0), Scaled(8.0)}, {0.0, 0.25, 0.0}));
      break;
    case 4:
      must(recorder.apply_angular_impulse(box, {Scaled(1.0), Scaled(-2.0), Scaled(0.5)}));
      break;
    case 5:
      must(recorder.set_user_data(box, tick));
      break;
    case 6:
      must(recorder.sleep_body(box));
      break;
    default:
      must(recorder.wake_body(box));
      break;
  }
  if (tick == 150) must(recorder.set_gravity({0.0, -4.0, 0.5}));
  if (tick == 250) must(recorder.set_gravity({0.0, -9.75, 0.0}));
}

}  // namespace traffic
}  // namespace DETENT_NAMESPACE
}  // namespace detent
