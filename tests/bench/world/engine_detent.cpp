#include <detent/world.h>
#include <stdio.h>

#include "tests/bench/world/engine.h"
#include "tests/campaigns/stress/run_detent.h"
#include "tests/common/support/stage_profile.h"

/// This library, compiled once per configuration, with the settings that a world has by default: the stress tests' own
/// worlds.
namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;

detent_stress::Settings settings_of(const Effort& effort) {
  detent_stress::Settings settings;
  if (effort.substeps != 0) settings.substeps = effort.substeps;
  if (effort.iterations != 0) settings.iterations = effort.iterations;
  if (effort.penetration != 0) settings.resting_penetration = 1.0 / effort.penetration;
  return settings;
}

class DetentRun : public WorldRun {
 public:
  DetentRun(std::unique_ptr<detent_stress::Run> run, uint64_t settings_digest) : run_(std::move(run)) {
    snprintf(settings_, sizeof settings_, "%016llx", static_cast<unsigned long long>(settings_digest));
  }
  void step() override {
    counts_ = run_->step();
    losses_ += counts_.lost + counts_.saturations;
  }
  uint32_t contact_points() const override { return counts_.contact_points; }
  uint64_t losses() const override { return losses_; }
  void read(BodyState* states) const override {
    for (const BodyState& state : run_->states()) *states++ = state;
  }
  uint64_t bytes() const override { return run_->bytes(); }
  const char* settings() const override { return settings_; }
  void start_profile() override { profile_.attach(world_of(*run_)); }
  detent_test::StageTimes stages() const override { return profile_.times(); }

 private:
  StageProfile profile_;
  std::unique_ptr<detent_stress::Run> run_;
  detent_stress::Counts counts_;
  uint64_t losses_ = 0;
  char settings_[17] = {};
};

WorldRun* make(const Stage& stage, const Effort& effort, const char*& problem) {
  const detent_stress::Engine engine = stress_engine();
  static std::string reason;
  auto run = engine.make(stage, settings_of(effort), reason);
  // The digest of the settings is that of a new world with them and with one body, always the same.
  Stage alone = stage;
  alone.bodies.assign(1, {});
  alone.joints.clear();
  alone.collisions = true;
  const auto with_settings = engine.make(alone, settings_of(effort), reason);
  if (run == nullptr || with_settings == nullptr) {
    problem = reason.c_str();
    return nullptr;
  }
  return new DetentRun(std::move(run), with_settings->digest());
}

}  // namespace

/// Adds this configuration to the engines of the whole step.
void add_world_engine(WorldEngineList& engines) {
  static const std::string config = stress_engine().config;
  engines.push_back({"detent", config.c_str(), make, heap_use});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
