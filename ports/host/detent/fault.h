#pragma once
#include <detent/recording.h>

#include <memory>
#include <string>

#include "shrink.h"

/// The faults that `detent shrink` looks for.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A call that a world refuses.
struct RefusedCall {
  size_t at = 0;      ///< ListedCall::at of the call, by which the call is identified
  uint64_t tick = 0;  ///< number of completed ticks
  const char* name = "";
  Status status = Status::ok;
};

/// Looks for one kind of fault, tick by tick.
class Fault {
 public:
  virtual ~Fault() = default;

  /// Looks at the world before a step, when the calls of that tick are done.
  virtual void before_step(const World&) {}
  /// Looks at the world after a step. Returns what is wrong; empty if nothing is. Sets `clean` to false if no recording
  /// should start from this state, because the fault has begun.
  virtual std::string after_step(const World& world, const StepReport& report, bool& clean) = 0;
  /// Looks at a call that was refused. Returns what is wrong; empty: nothing.
  virtual std::string refused(const RefusedCall&) { return {}; }
  /// The words for the fault in the message "shows no ...".
  virtual std::string name() const = 0;
  /// Called when the fault was found in the given recording: from now on only the same fault counts.
  virtual void settle() {}

  uint64_t from = 0;       ///< only faults in later ticks count
  uint32_t body_slot = 0;  ///< slot, in the recording, of the body that the fault must concern; 0: any body
  BodyId body = {};        ///< id of that body; null: the body does not exist at present

 protected:
  bool concerns(BodyId id) const { return body_slot == 0 || id == body; }
};

/// Makes the Fault for the request's kind. Range: any kind except `differs`, which is not a fault of a state.
std::unique_ptr<Fault> make_fault(const detent_tool::ShrinkRequest& request);
std::unique_ptr<Fault> make_tunnels_fault();
std::unique_ptr<Fault> make_depth_fault(double bound);
std::unique_ptr<Fault> make_gap_fault(double bound);

/// The size and the thickness of a dynamic body, m, computed from its mass and inertia as in the zoo (docs/zoo.md). The
/// size of a rod is its length; the thickness of a box is its least side. Both are 0 if the body is not dynamic. The
/// thickness is also 0 if the rotation of the body is locked.
double fault_body_size(const World& world, BodyId id);
double fault_body_thickness(const World& world, BodyId id);
/// The greatest depth of the contact's points, m; negative if all points have gaps.
double fault_depth_of(const Contact& contact);

/// "body 7", by its slot.
inline std::string fault_body_text(BodyId id) { return "body " + std::to_string(id.slot); }
/// The value as text, with three significant digits.
std::string fault_figure(double value);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
