#pragma once
#include <memory>

#include "scene_player.h"
#include "scene_world.h"
#include "tests/campaigns/zoo/frame.h"

/// A scene file as `detent run` plays it, in one configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

class OpenedScene {
 public:
  /// On that ground if it has one. Null, with the problem, if it cannot be opened.
  static std::unique_ptr<OpenedScene> open(const std::string& path, detent_test::Ground ground, std::string& problem);

  /// Makes the calls before that tick. Returns whether there were any; on failure sets `problem`.
  bool call(uint32_t tick, std::string& problem);
  detent_zoo::Frame frame() const;
  /// The ids of the frame's bodies and joints, in its order.
  std::vector<BodyId> bodies() const;
  std::vector<JointId> joints() const;

  bool has_ground() const { return has_ground_; }
  const World& world() const { return owned_.world; }
  World& world() { return owned_.world; }
  Recorder& recorder() { return *recorder_; }
  const SceneText& text() const { return reading_.scene; }
  std::string name_of(BodyId id) const { return player_->name_of(id); }

 private:
  OpenedScene() = default;
  bool read(const std::string& path, detent_test::Ground ground, std::string& problem);
  detent_zoo::BodyFrame body_of(BodyId id) const;
  bool take_problem(std::string& problem) const;

  std::string path_;
  bool has_ground_ = false;
  Node root_;
  SceneReading reading_;
  SceneAssets assets_;
  OwnedWorld owned_;
  RunPrints prints_;
  RunPrinter print_ = [](const RunLine&) {};
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<ScenePlayer> player_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
