#include <detent/numbers.h>
#include <detent/recording.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "examples/billiards/picture.h"
#include "examples/recording_file.h"

using namespace detent;

namespace {

/// Prints the events of the last tick: balls that left the table or came back, and the shot that began.
class Commentary {
 public:
  void add(const World& world, uint32_t tick) {
    const double time = tick * 0.001;
    BodyId balls[billiards::k_ball_count];
    for (BodyId ball = billiards::next_ball(world, {}); ball.slot != 0; ball = billiards::next_ball(world, ball)) {
      balls[billiards::ball_number(world, ball)] = ball;
    }
    for (uint32_t number = 0; number < billiards::k_ball_count; ++number) {
      if (balls[number] == balls_[number]) continue;
      if (balls_[number].slot != 0) printf("%7.3f s    ball %" PRIu32 " pocketed\n", time, number);
      if (balls[number].slot != 0 && tick != 0) printf("%7.3f s    ball %" PRIu32 " put back\n", time, number);
      balls_[number] = balls[number];
    }
    if (billiards::shots_played(world) == shots_) return;
    const billiards::Shot& shot = billiards::k_shots[shots_++];
    const double speed = hypot(real_to_host(shot.linear_velocity.x), real_to_host(shot.linear_velocity.z));
    printf("%7.3f s  %s, %.1f m/s\n", time, shot.name, speed);
  }

 private:
  BodyId balls_[billiards::k_ball_count] = {};
  uint32_t shots_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const char* out = nullptr;
  const char* picture_path = nullptr;
  for (int i = 1; i < argc; i += 2) {
    const char** option = strcmp(argv[i], "--out") == 0    ? &out
                          : strcmp(argv[i], "--plot") == 0 ? &picture_path
                                                           : nullptr;
    if (option == nullptr || i + 1 == argc) {
      fprintf(stderr, "usage: %s [--out match.detent] [--plot match.svg]\n", argv[0]);
      return 2;
    }
    *option = argv[i + 1];
  }

  const Scene& scene = billiards::k_scene;
  static WorldStorage<billiards::k_capacity> storage;
  World world;
  if (storage.create(scene.world(), world) != Status::ok) return 1;

  RecordingFile file(out);
  if (out != nullptr && !file.is_open()) {
    fprintf(stderr, "cannot write %s\n", out);
    return 1;
  }
  Recorder recorder(world, file.sink(), file.buffer(), k_recording_buffer_bytes);
  scene.build(recorder);
  if (recorder.begin() != Status::ok) return 1;

  billiards::Picture picture;
  Commentary commentary;
  for (uint32_t tick = 0; tick < scene.ticks; ++tick) {
    scene.before_tick(recorder, tick);
    commentary.add(world, tick);
    if (picture_path != nullptr) picture.add(world, static_cast<int>(tick));
    const StepReport report = recorder.step();
    if (!report.complete()) fprintf(stderr, "tick %" PRIu32 ": something was lost\n", tick);
  }

  if (picture_path != nullptr) picture.add(world, static_cast<int>(scene.ticks));

  const Status status = recorder.end();
  if (status != Status::ok || !file.close()) {
    fprintf(stderr, "recording failed: %s\n", status_text(status));
    return 1;
  }
  if (picture_path != nullptr && !picture.write(picture_path, digest(world))) {
    fprintf(stderr, "cannot write %s\n", picture_path);
    return 1;
  }
  printf("%" PRIu32 " ticks, digest %016" PRIx64 "\n", scene.ticks, digest(world));
}
