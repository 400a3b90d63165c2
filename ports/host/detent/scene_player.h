#pragma once
#include "run.h"
#include "scene_names.h"
#include "scene_reader.h"

/// Executes a scene's definitions and actions through a recorder.
namespace detent {
inline namespace DETENT_NAMESPACE {

class ScenePlayer {
 public:
  ScenePlayer(SceneReading& reading, Recorder& recorder, const RunPrints& prints, const RunPrinter& print)
      : reading_(reading), recorder_(recorder), prints_(prints), print_(print) {}

  /// Binds the assets and creates the first bodies and joints. Stops at the first failure: returns false and adds a
  /// problem.
  bool build();
  /// Makes the calls before a tick. `tick`: number of completed ticks; the caller passes 0, 1, 2 and so on. Failures as
  /// in build().
  bool before_tick(uint32_t tick);
  /// Prints the events of the last step.
  void print_events(const World& world, const StepReport& report) const;
  void print_bodies(const World& world, uint64_t tick) const;
  uint64_t calls() const { return calls_; }
  /// The body's name, or its kind and slot: "body 7".
  std::string name_of(BodyId id) const { return bodies_.of(id); }

 private:
  bool fail(const SceneOrigin& origin, const std::string& text);
  bool make(const SceneBody& body);
  bool make(const SceneJoint& joint);
  bool play(const SceneAction& action, uint32_t tick);
  Status call(const SceneAction& action);
  Status call_of_body(const SceneAction& action, BodyId id);
  Status push(const SceneAction& action, BodyId id);
  Status ask(const SceneAction& action);

  SceneReading& reading_;
  Recorder& recorder_;
  const RunPrints& prints_;
  const RunPrinter& print_;
  SceneNames<BodyId> bodies_{"body"};
  SceneNames<JointId> joints_{"joint"};
  std::vector<uint32_t> order_;    ///< indices of the actions, by their first tick
  std::vector<uint32_t> running_;  ///< indices of the actions between their first and last tick
  size_t next_ = 0;                ///< index of the next action in order_
  uint64_t calls_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
