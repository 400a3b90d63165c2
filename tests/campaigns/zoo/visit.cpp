#include "tests/campaigns/zoo/visit.h"

#include <algorithm>
#include <limits>

namespace detent_zoo {

namespace {

constexpr double k_hopeless = 10;      // times the bound of the speed: a longer run gives no more information
constexpr double k_rest_speed = 1e-3;  // m/s, mean over the bodies
constexpr double k_rest_angular_velocity = 1e-2;  // rad/s

std::string number(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

double measured(const Figures& figures, const std::string& check) {
  if (check == "gain") return figures.gain.value;
  if (check == "loss") return figures.loss.value;
  if (check == "gap") return figures.gap.value;
  if (check == "angle") return figures.angle.value;
  if (check == "limit") return figures.limit.value;
  if (check == "lost") return figures.lost.value;
  if (check == "speed") return figures.speed.value;
  if (check == "momentum") return figures.momentum.value;
  if (check == "angular_momentum") return figures.angular_momentum.value;
  if (check == "sunk") return figures.sunk.value;
  if (check == "pierced") return figures.pierced.value;
  if (check == "moved") return figures.moved.value;
  if (check == "fallen") return figures.fallen.value;
  if (check == "risen") return figures.risen.value;
  if (check == "asleep")
    return figures.asleep_from != 0 ? figures.asleep_from : std::numeric_limits<double>::infinity();
  return std::max(figures.rest_speed / k_rest_speed, figures.rest_angular_velocity / k_rest_angular_velocity);
}

Verdict visit(const Entry& entry, const Engine& engine, const std::string& folder, detent_test::Ground ground,
              const Variation& variation) {
  Verdict verdict;
  const std::unique_ptr<Play> play = engine.open(folder + "/" + entry.scene + ".json", ground, verdict.problem);
  if (play == nullptr) return verdict;
  if ((variation.gravity != 1 || variation.tick != 1) && !play->vary(variation)) {
    verdict.problem = "its gravity or tick would be out of range";
    return verdict;
  }
  play->start_profile();
  Watch watch(play->frame());
  for (uint32_t tick = 0; tick < play->ticks(); ++tick) {
    if (play->call(verdict.problem)) watch.calls(play->frame());
    if (!verdict.problem.empty()) return verdict;
    const StepFigures step = play->step();
    watch.tick(play->frame(), step);
    if (entry.ends_asleep && step.awake == 0) break;
    if (!(watch.figures().speed.value <= k_hopeless * entry.bounds.at("speed"))) break;
  }
  verdict.figures = watch.finish();
  verdict.stages = play->stages();
  verdict.gap_joint = play->joint_name(verdict.figures.gap.index);
  verdict.sunk_body = play->body_name(verdict.figures.sunk.index);
  verdict.moved_body = play->body_name(verdict.figures.moved.index);
  for (const auto& [check, bound] : entry.bounds) {
    if (!(measured(verdict.figures, check) <= bound)) verdict.failed.insert(check);
  }
  return verdict;
}

std::string surprises(const Entry& entry, const char* config, const Verdict& verdict) {
  if (!verdict.problem.empty()) return verdict.problem + "\n";
  const auto found = entry.gaps.find(config);
  const std::set<std::string> known = found == entry.gaps.end() ? std::set<std::string>() : found->second;
  std::string text;
  for (const auto& [check, bound] : entry.bounds) {
    const bool fails = verdict.failed.count(check) != 0;
    if (fails == (known.count(check) != 0)) continue;
    text += check + ": " + number(measured(verdict.figures, check)) + (fails ? " is more than " : " is within ") +
            number(bound) + (fails ? "" : ", which the list has as a gap") + "\n";
  }
  return text;
}

}  // namespace detent_zoo
