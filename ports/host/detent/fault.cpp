#include "fault.h"

#include <stdio.h>

#include "lost.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

/// The fault that a counter of the report is not 0. When settled, only the same counter counts.
class LostFault : public Fault {
 public:
  std::string after_step(const World&, const StepReport& report, bool&) override {
    if (report.tick <= from) return {};
    for (const LostCounter& counter : k_lost_counters) {
      const uint32_t count = counter.count(report);
      if (count == 0 || (settled_ && &counter != found_)) continue;
      found_ = &counter;
      return std::string(counter.name) + " is " + std::to_string(count);
    }
    return {};
  }
  std::string name() const override { return "step that loses anything"; }
  void settle() override { settled_ = true; }

 private:
  const LostCounter* found_ = nullptr;
  bool settled_ = false;
};

/// The fault that a call is refused. When settled, only the same call with the same status counts.
class StatusFault : public Fault {
 public:
  std::string after_step(const World&, const StepReport&, bool&) override { return {}; }
  std::string refused(const RefusedCall& call) override {
    if (settled_ ? call.at != call_.at || call.status != call_.status : call.tick < from) return {};
    call_ = call;
    return "the call " + std::string(call.name) + " is refused: " + status_text(call.status);
  }
  std::string name() const override { return "call that is refused"; }
  void settle() override { settled_ = true; }

 private:
  RefusedCall call_;
  bool settled_ = false;
};

}  // namespace

std::string fault_figure(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::unique_ptr<Fault> make_fault(const ShrinkRequest& request) {
  std::unique_ptr<Fault> fault;
  switch (request.kind) {
    case FaultKind::tunnels:
      fault = make_tunnels_fault();
      break;
    case FaultKind::opens:
      fault = make_gap_fault(request.bound == 0 ? k_gap_bound : request.bound);
      break;
    case FaultKind::penetrates:
      fault = make_depth_fault(request.bound == 0 ? k_depth_bound : request.bound);
      break;
    case FaultKind::lost:
      fault = std::make_unique<LostFault>();
      break;
    case FaultKind::status:
      fault = std::make_unique<StatusFault>();
      break;
    case FaultKind::differs:
      return nullptr;
  }
  fault->from = request.reading.from;
  fault->body_slot = request.body;
  return fault;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
