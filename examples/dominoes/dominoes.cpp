#include "examples/dominoes/dominoes.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace dominoes {
namespace {

constexpr Vec3<Real> k_half_extents = {Real(0.05), Real(0.5), Real(0.25)};  // m
constexpr Coord k_spacing = static_cast<Coord>(0.4);                        // m

/// The first domino leans on its front edge by 0.2 rad, beyond the 0.0997 where it would fall back. The edge stays at
/// x = 0.05, y = 0, so the centre lies at (0.05 - 0.05 cos 0.2 + 0.5 sin 0.2, 0.05 sin 0.2 + 0.5 cos 0.2).
constexpr Position k_first_position = {static_cast<Coord>(0.1003313363), static_cast<Coord>(0.4999667554),
                                       static_cast<Coord>(0.0)};
constexpr Quat k_first_rotation = {Unit(0.0), Unit(0.0), Unit(-0.0998334166), Unit(0.9950041653)};

/// sin(pi / 8): z of a rotation by 45 degrees about z.
constexpr Unit k_fallen = Unit(0.3826834324);

WorldDef world_for(uint32_t count) {
  const Capacity capacity = capacity_of(count);
  return world_of(capacity.bodies, capacity.contacts);
}

void build_row(Recorder& recorder, uint32_t count) {
  make_ground(recorder);
  BodyDef domino;
  domino.shape = box(k_half_extents);
  domino.position = k_first_position;
  domino.rotation = k_first_rotation;
  make_body(recorder, domino);
  domino.position = {static_cast<Coord>(0.0), static_cast<Coord>(0.5), static_cast<Coord>(0.0)};
  domino.rotation = BodyDef().rotation;
  for (uint32_t i = 1; i < count; ++i) {
    domino.position.x += k_spacing;
    make_body(recorder, domino);
  }
}

}  // namespace

WorldDef world() { return world_for(k_count); }
WorldDef world_short() { return world_for(k_count_short); }
void build(Recorder& recorder) { build_row(recorder, k_count); }
void build_short(Recorder& recorder) { build_row(recorder, k_count_short); }

uint32_t fallen(const World& world) {
  uint32_t count = 0;
  for (BodyId body = next_body(world, {}); !is_null(body); body = next_body(world, body)) {
    Pose pose;
    if (get_pose(world, body, pose) == Status::ok && (pose.rotation.z > k_fallen || -pose.rotation.z > k_fallen)) {
      ++count;
    }
  }
  return count;
}

}  // namespace dominoes
}  // namespace DETENT_NAMESPACE
}  // namespace detent
