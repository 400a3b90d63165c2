#include "examples/scenes/piles.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace piles {

namespace {

/// `count` boxes of half extents 1/4 m, one above the other with gaps of 1/64 m, each shifted by 1/32 m against the
/// last.
void make_tower(Recorder& recorder, uint32_t count) {
  BodyDef def;
  def.shape = box({0.25, 0.25, 0.25});
  def.position = {0.0, 0.265625, 0.0};
  for (uint32_t i = 0; i < count; ++i) {
    make_body(recorder, def);
    def.position.y += Coord(0.515625);
    if (i % 2 == 0)
      def.position.x += Coord(0.03125);
    else
      def.position.x -= Coord(0.03125);
  }
}

}  // namespace

WorldDef tiny_world() {
  WorldDef def = world_of(5, 4);
  def.continuous = false;  // its queries need 6 KB of stack
  return def;
}
void build_tiny(Recorder& recorder) {
  make_ground(recorder);
  make_tower(recorder, 4);
}

WorldDef stack_world() { return world_of(8, 24); }
void build_stack(Recorder& recorder) {
  make_ground(recorder);
  make_tower(recorder, 5);
}

WorldDef capsules_world() { return world_of(16, 64); }
void build_capsules(Recorder& recorder) {
  make_ground(recorder);
  BodyDef def;
  def.shape = capsule(Real(0.1875), Real(0.5));
  def.material.rolling_resistance = Real(0.015625);
  def.position = {0.0, 0.5, 0.0};
  for (uint32_t i = 0; i < 10; ++i) {
    // Lying along x and along z in turn; a quarter turn is (3, 4) / 5 and its like nearly, so no end is quite level.
    if (i % 2 == 0)
      def.rotation = {Unit(0.0), Unit(0.0), Unit(0.6), Unit(0.8)};
    else
      def.rotation = {Unit(0.8), Unit(0.0), Unit(0.0), Unit(0.6)};
    make_body(recorder, def);
    def.position.y += Coord(0.75);
    def.position.x += Coord(0.0625);
    def.position.z -= Coord(0.03125);
  }
}

WorldDef balls_world() { return world_of(24, 96); }
void build_balls(Recorder& recorder) {
  make_ground(recorder);
  BodyDef slope;
  slope.type = BodyType::fixed;
  slope.shape = box({2.0, 0.25, 3.0});
  slope.rotation = {Unit(0.0), Unit(0.0), Unit(0.28), Unit(0.96)};  // 32.5 degrees about z
  slope.position = {4.0, 0.75, 0.0};
  for (uint32_t i = 0; i < 3; ++i) {
    make_body(recorder, slope);
    slope.position.x += Coord(3.0);
    slope.position.y += Coord(1.875);
  }
  const Real radii[4] = {Real(0.25), Real(0.375), Real(0.1875), Real(0.5)};
  const Real speeds[3] = {Real(6.0), Real(8.5), Real(4.25)};
  BodyDef ball;
  ball.material.friction = Real(0.375);
  ball.material.restitution = Real(0.5);
  ball.position.x = Coord(-3.0);
  for (uint32_t row = 0; row < 5; ++row) {
    ball.position.y = Coord(1.0);
    ball.position.y += row % 2 == 0 ? Coord(0.0) : Coord(0.75);
    ball.position.z = row % 2 == 0 ? Coord(-1.875) : Coord(-1.625);  // else the rows would never meet
    for (uint32_t column = 0; column < 4; ++column) {
      ball.shape = sphere(radii[(row + column) % 4]);
      ball.linear_velocity = {speeds[(2 * row + column) % 3], Real(1.5), Real(0.0)};
      make_body(recorder, ball);
      ball.position.z += Coord(1.25);
    }
    ball.position.x -= Coord(1.25);
  }
}

}  // namespace piles
}  // namespace DETENT_NAMESPACE
}  // namespace detent
