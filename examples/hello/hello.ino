// A ball falls onto the ground; its height is printed to the serial monitor. Detent needs C++20. Most cores need this
// line in platform.local.txt:
// compiler.cpp.extra_flags=-std=gnu++20 -ffp-contract=off -fno-strict-overflow -fno-lra-remat
#include <detent.h>
using namespace detent;

WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
World world;
BodyId ball;

void setup() {
  Serial.begin(115200);
  BodyId ground;
  if (storage.create({}, world) != Status::ok ||
      create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground) != Status::ok ||
      create_body(world, {.position = {0.0, 5.0, 0.0}, .shape = sphere(0.5)}, ball) != Status::ok) {
    Serial.println("the world could not be made");
  }
}

void loop() {
  step(world);
  Pose pose;
  if (get_pose(world, ball, pose) == Status::ok) Serial.println(coord_to_host(pose.position.y));
  delay(16);
}
