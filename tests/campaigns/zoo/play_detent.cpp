#include <detent/world.h>

#include "lost.h"
#include "tests/campaigns/zoo/opened_scene.h"
#include "tests/common/support/stage_profile.h"

#define DETENT_ZOO_TEXT_OF(name) #name
#define DETENT_ZOO_TEXT(name) DETENT_ZOO_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using detent_zoo::Frame;
using detent_zoo::StepFigures;

/// A scene that the caller steps.
class DetentPlay : public detent_zoo::Play {
 public:
  explicit DetentPlay(std::unique_ptr<OpenedScene> scene) : scene_(std::move(scene)) {}

  bool call(std::string& problem) override {
    bool any = false;
    for (; problem.empty() && next_call_ <= tick_ * tick_factor_; ++next_call_)
      any = scene_->call(next_call_, problem) || any;
    return any;
  }

  StepFigures step() override {
    const Stopwatch stopwatch;
    const StepReport report = scene_->recorder().step();
    StepFigures figures;
    figures.seconds = stopwatch.seconds();
    ++tick_;
    figures.lost = count_lost(report);
    figures.lost_most = greatest_loss(report);
    figures.substeps = report.substeps_max;
    figures.awake = report.awake;
    figures.islands = report.islands;
    figures.impacts = report.ccd.impacts;
    figures.tests = report.ccd.tests;
    return figures;
  }

  bool vary(const detent_zoo::Variation& variation) override {
    WorldDef def = get_settings(scene_->world());
    const auto scale = [](Real& value, double factor) {
      return real_from_host(real_to_host(value) * factor, value) == Status::ok;
    };
    tick_factor_ = variation.tick;
    return scale(def.gravity.x, variation.gravity) && scale(def.gravity.y, variation.gravity) &&
           scale(def.gravity.z, variation.gravity) && scale(def.tick, variation.tick) &&
           set_settings(scene_->world(), def) == Status::ok;
  }

  void start_profile() override { profile_.attach(scene_->world()); }
  detent_test::StageTimes stages() const override { return profile_.times(); }

  Frame frame() const override { return scene_->frame(); }
  uint32_t ticks() const override { return static_cast<uint32_t>(scene_->text().ticks / tick_factor_); }

  std::string body_name(uint32_t index) const override {
    const std::vector<BodyId> bodies = scene_->bodies();
    return scene_->name_of(index < bodies.size() ? bodies[index] : BodyId{});
  }

  std::string joint_name(uint32_t index) const override {
    const std::vector<JointId> joints = scene_->joints();
    JointDef def;
    if (index >= joints.size() || get_joint(scene_->world(), joints[index], def) != Status::ok) {
      return "joint " + std::to_string(index);
    }
    return scene_->name_of(def.a) + " - " + scene_->name_of(def.b);
  }

 private:
  StageProfile profile_;
  std::unique_ptr<OpenedScene> scene_;
  double tick_factor_ = 1;
  uint32_t tick_ = 0, next_call_ = 0;
};

std::unique_ptr<detent_zoo::Play> open_play(const std::string& path, detent_test::Ground ground, std::string& problem) {
  std::unique_ptr<OpenedScene> scene = OpenedScene::open(path, ground, problem);
  if (scene == nullptr) return nullptr;
  return std::make_unique<DetentPlay>(std::move(scene));
}

}  // namespace

detent_zoo::Engine zoo_engine() { return {DETENT_ZOO_TEXT(DETENT_NAMESPACE), open_play}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
