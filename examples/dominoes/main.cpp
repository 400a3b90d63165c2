#include <detent/recording.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "examples/dominoes/dominoes.h"
#include "examples/recording_file.h"

using namespace detent;

int main(int argc, char** argv) {
  const char* out = argc == 3 && strcmp(argv[1], "--out") == 0 ? argv[2] : nullptr;
  if (argc > 1 && out == nullptr) {
    fprintf(stderr, "usage: %s [--out dominoes.detent]\n", argv[0]);
    return 2;
  }

  const Scene& scene = dominoes::k_scene;
  static WorldStorage<dominoes::capacity_of(dominoes::k_count)> storage;
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

  for (uint32_t tick = 0; tick < scene.ticks; ++tick) {
    const StepReport report = recorder.step();
    if (!report.complete()) fprintf(stderr, "tick %" PRIu32 ": something was lost\n", tick);
    if ((tick + 1) % 120 == 0)
      printf("%2" PRIu32 " s: %3" PRIu32 " fallen\n", (tick + 1) / 60, dominoes::fallen(world));
  }

  const Status status = recorder.end();
  if (status != Status::ok || !file.close()) {
    fprintf(stderr, "recording failed: %s\n", status_text(status));
    return 1;
  }
  printf("%" PRIu32 " ticks, digest %016" PRIx64 "\n", scene.ticks, digest(world));
}
