#include "examples/scenes/terrain.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace terrain_scene {

namespace {

constexpr Coord k_hills_x = 16.0;

void make_terrain(Recorder& recorder, uint32_t asset, const Position& position, BodyType type) {
  BodyDef def;
  def.type = type;
  def.shape = terrain(asset);
  def.position = position;
  if (type == BodyType::kinematic) def.angular_velocity = {Real(0.0), Real(0.75), Real(0.0)};
  make_body(recorder, def);
}

/// One of each shape, over a place.
void drop(Recorder& recorder, Coord x) {
  const Shape shapes[] = {sphere(0.375),
                          box({0.5, 0.25, 0.375}),
                          capsule(0.25, 0.375),
                          cylinder(0.375, 0.25),
                          cone(0.375, 0.5),
                          hull(k_asset_round),
                          rounded(box({0.25, 0.25, 0.25}), 0.125),
                          compound(k_asset_dumbbell)};
  Coord z = -2.625;
  for (const Shape& shape : shapes) {
    BodyDef def;
    def.shape = shape;
    def.position = {x, 3.0, z};
    def.rotation = {0.5, 0.1, 0.3, 0.8062257748298549};
    def.angular_velocity = {Real(1.5), Real(0.5), Real(-1.0)};
    make_body(recorder, def);
    z = z + Coord(0.75);
  }
}

void make_sensor(Recorder& recorder, Coord x, BodyType type) {
  BodyDef def;
  def.type = type;
  def.shape = box({2.0, 0.03125, 2.0});
  def.position = {x, 4.0, 0.0};
  def.sensor = true;
  if (type == BodyType::kinematic) def.angular_velocity = {Real(0.0), Real(0.0), Real(2.0)};
  make_body(recorder, def);
}

}  // namespace

WorldDef world() {
  WorldDef def = world_of(28, 128);
  def.capacity.assets = 4;
  def.capacity.sensed = 24;
  return def;
}

void build(Recorder& recorder) {
  for (uint32_t asset = 0; asset < 4; ++asset) must(recorder.bind_asset(asset));
  make_terrain(recorder, k_asset_valley, {0.0, 0.0, 0.0}, BodyType::fixed);
  make_terrain(recorder, k_asset_hills, {k_hills_x, 0.0, 0.0}, BodyType::fixed);
  make_terrain(recorder, k_asset_valley, {Coord(-16.0), 0.0, 0.0}, BodyType::kinematic);
  make_sensor(recorder, 0.0, BodyType::fixed);
  make_sensor(recorder, k_hills_x, BodyType::kinematic);
  drop(recorder, 0.25);
  drop(recorder, k_hills_x);
}

void before_tick(Recorder& recorder, uint32_t tick) {
  if (tick % 60 != 10) return;
  BodyDef shot;
  shot.shape = tick < 100 ? sphere(0.125) : box({0.125, 0.125, 0.125});
  shot.position = {tick % 120 < 60 ? Coord(0.0) : k_hills_x, 6.0, 0.5};
  shot.linear_velocity = {Real(20.0), Real(-300.0), Real(7.0)};
  make_body(recorder, shot);
  BodyDef rider;
  rider.shape = box({0.375, 0.125, 0.375});
  rider.position = {Coord(-16.0), 1.0, 0.25};
  if (tick < 70) make_body(recorder, rider);
}

}  // namespace terrain_scene
}  // namespace DETENT_NAMESPACE
}  // namespace detent
