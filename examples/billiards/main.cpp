#include <detent/convert.h>
#include <detent/recording.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <string>

#include "examples/billiards/billiards.h"
#include "examples/recording_file.h"

using namespace detent;

namespace {

/// The paths of the balls, seen from above, in mm.
class Plot {
 public:
  void add(const World& world) {
    for (Track& track : tracks_) track.on_table = false;
    for (BodyId ball = billiards::next_ball(world, {}); ball.slot != 0; ball = billiards::next_ball(world, ball)) {
      Pose pose;
      if (get_pose(world, ball, pose) != Status::ok) continue;
      const long x = lround(coord_to_host(pose.position.x) * 1000);
      const long y = lround(coord_to_host(pose.position.z) * 1000);
      Track& track = tracks_[billiards::ball_number(world, ball)];
      if (track.path.empty() || x != track.x || y != track.y) {
        track.path += (track.was_on_table ? 'L' : 'M') + std::to_string(x) + ' ' + std::to_string(y);
      }
      track.x = x;
      track.y = y;
      track.on_table = true;
    }
    for (Track& track : tracks_) track.was_on_table = track.on_table;
  }

  bool write(const char* path) const {
    FILE* file = fopen(path, "w");
    if (file == nullptr) return false;
    fprintf(file,
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1350 -715 2700 1430' fill='none' stroke-width='5'>\n"
            "<rect x='-1350' y='-715' width='2700' height='1430' fill='#432'/>\n"
            "<rect x='-1270' y='-635' width='2540' height='1270' fill='#175'/>\n");
    static constexpr const char* k_colours[] = {"#fff", "#fc0", "#24f", "#e22", "#62a", "#f81", "#0b4", "#a22"};
    for (uint32_t number = 0; number < billiards::k_ball_count; ++number) {
      const Track& track = tracks_[number];
      const char* colour = number == 8 ? "#000" : k_colours[number < 8 ? number : number - 8];
      const char* dashes = number > 8 ? " stroke-dasharray='14 7'" : "";
      fprintf(file, "<path d='%s' stroke='%s'%s/>\n", track.path.c_str(), colour, dashes);
      if (track.on_table) {
        fprintf(file, "<circle cx='%ld' cy='%ld' r='28.6' fill='%s' stroke='#fff'%s/>\n", track.x, track.y, colour,
                dashes);
      }
    }
    fprintf(file, "</svg>\n");
    return fclose(file) == 0;
  }

 private:
  struct Track {
    std::string path;
    long x = 0, y = 0;
    bool on_table = false;
    bool was_on_table = false;
  };
  Track tracks_[billiards::k_ball_count];
};

/// Says what the last tick did: balls that left the table or came back, and the shot that began.
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
    const double speed = hypot(real_to_host(shot.velocity.x), real_to_host(shot.velocity.z));
    printf("%7.3f s  %s, %.1f m/s\n", time, shot.name, speed);
  }

 private:
  BodyId balls_[billiards::k_ball_count] = {};
  uint32_t shots_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const char* out = nullptr;
  const char* plot_path = nullptr;
  for (int i = 1; i < argc; i += 2) {
    const char** option = strcmp(argv[i], "--out") == 0 ? &out : strcmp(argv[i], "--plot") == 0 ? &plot_path : nullptr;
    if (option == nullptr || i + 1 == argc) {
      fprintf(stderr, "usage: %s [--out match.detent] [--plot paths.svg]\n", argv[0]);
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

  Plot plot;
  Commentary commentary;
  for (uint32_t tick = 0; tick < scene.ticks; ++tick) {
    scene.before_tick(recorder, tick);
    commentary.add(world, tick);
    const StepReport report = recorder.step();
    if (!report.complete()) fprintf(stderr, "tick %" PRIu32 ": something was lost\n", tick);
    if (plot_path != nullptr && tick % 10 == 0) plot.add(world);
  }

  const Status status = recorder.end();
  if (status != Status::ok || !file.close()) {
    fprintf(stderr, "recording failed: %s\n", status_text(status));
    return 1;
  }
  if (plot_path != nullptr && !plot.write(plot_path)) {
    fprintf(stderr, "cannot write %s\n", plot_path);
    return 1;
  }
  printf("%" PRIu32 " ticks, digest %016" PRIx64 "\n", scene.ticks, digest(world));
}
