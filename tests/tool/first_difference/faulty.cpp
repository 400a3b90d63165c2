#include "faulty.h"

#include <detent/recording.h>
#include <stdio.h>
#include <string.h>

#include <memory>

#include "base/bytes.h"
#include "examples/scenes/scene.h"
#include "state/step_scratch.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Status write_file(void* file, const uint8_t* bytes, uint32_t count) {
  return fwrite(bytes, 1, count, static_cast<FILE*>(file)) == count ? Status::ok : Status::sink_failed;
}

class Machine {
 public:
  Machine(const FaultyRun& run, const Scene& scene) : run_(run), scene_(scene) {}

  bool play(FILE* file) {
    WorldDef def = scene_.world();
    if (is("setting")) def.iterations += 1;
    const uint32_t bytes = world_bytes(def.capacity);
    const std::unique_ptr<uint64_t[]> block(new uint64_t[(bytes + 7) / 8]);
    if (create_world(reinterpret_cast<uint8_t*>(block.get()), bytes, def, {.assets = scene_assets()}, world_) !=
        Status::ok)
      return false;
    const StepObserver observer = {stage_ended, this};
    world_.hooks.observer = &observer;
    uint8_t buffer[k_recording_buffer_bytes];
    Recorder recorder(world_, {write_file, file}, buffer, sizeof buffer);
    scene_.build(recorder);
    if (run_.trace != 0) take(recorder.trace({static_cast<TraceLevel>(run_.trace), 1, run_.ticks}));
    if (run_.tick == 0) create_two(recorder);
    if (recorder.begin({run_.digests, run_.keyframes}) != Status::ok) return false;
    for (uint32_t tick = 1; tick <= run_.ticks; ++tick) {
      before(recorder, tick);
      recorder.step();
    }
    return recorder.end() == Status::ok && good_;
  }

 private:
  void take(Status status) { good_ = good_ && status == Status::ok; }
  bool is(const char* fault) const { return strcmp(run_.fault, fault) == 0; }

  void script(Recorder& recorder, uint32_t tick) {
    if (scene_.before_tick != nullptr) scene_.before_tick(recorder, tick - 1);
  }

  void before(Recorder& recorder, uint32_t tick) {
    const bool now = tick == run_.tick;
    if (is("late") && now) return;
    if (is("late") && tick == run_.tick + 1) script(recorder, run_.tick);
    script(recorder, tick);
    if (!now) return;
    create_two(recorder);
    if (is("changed-setting")) {
      WorldDef def = scene_.world();
      def.gravity.y = -9.5;
      take(recorder.set_settings(def));
    }
    if (is("flip")) flip(view_of(world_).motions[run_.body - 1].linear_velocity.y);
  }

  /// "created": a ball and a box; "created-in-other-order".
  void create_two(Recorder& recorder) {
    if (!is("created") && !is("created-in-other-order")) return;
    BodyDef ball, crate;
    ball.position = {3.0, 4.0, 0.0};
    crate.position = {5.0, 4.0, 0.0};
    crate.shape = box({0.5, 0.5, 0.5});
    BodyId id;
    take(recorder.create_body(is("created") ? ball : crate, id));
    take(recorder.create_body(is("created") ? crate : ball, id));
  }

  template <class T>
  void flip(T& value) const {
    uint8_t bytes[sizeof(T)];
    memcpy(bytes, &value, sizeof bytes);
    const uint32_t byte = run_.bit / 8;
    bytes[k_big_endian ? sizeof bytes - 1 - byte : byte] ^= static_cast<uint8_t>(1u << run_.bit % 8);
    memcpy(&value, bytes, sizeof bytes);
  }

  static void stage_ended(void* context, const World& world, StepStage stage, uint32_t contacts) {
    Machine& machine = *static_cast<Machine*>(context);
    const StateView<uint8_t> state = view_of(machine.world_);
    if (state.world.tick + 1 != machine.run_.tick) return;
    const Scratch scratch = scratch_of(world.block, state.layout, capacity_of(state.header));
    if (machine.is("contact") && stage == StepStage::collide_pairs && contacts != 0)
      machine.flip(scratch.contacts[0].normal.y);
    if (machine.is("solve") && stage == StepStage::solve_islands)
      machine.flip(state.motions[machine.run_.body - 1].linear_velocity.y);
    if (machine.is("sweep") && stage == StepStage::advance)
      machine.flip(scratch.sweeps[machine.run_.body - 1].displacement.y);
  }

  const FaultyRun& run_;
  const Scene& scene_;
  World world_;
  bool good_ = true;
};

}  // namespace

bool play_faulty(const FaultyRun& run) {
  const Scene* const scene = find_scene(run.scene);
  FILE* const file = scene == nullptr ? nullptr : fopen(run.path, "wb");
  if (file == nullptr) return false;
  const bool played = Machine(run, *scene).play(file);
  return fclose(file) == 0 && played;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
