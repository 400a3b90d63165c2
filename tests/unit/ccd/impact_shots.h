#pragma once
#include <math.h>

#include "state/view.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/world/lab.h"
#include "world/step_probe.h"

/// Shots at thin bodies, and checks in doubles of the sweeps that the impact stage has committed.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The pose of a body on a segment.
struct SegmentPose {
  Vector position;
  Quaternion rotation;
};

/// The segments of one tick.
struct Trace {
  std::vector<SweepSegment> segments = std::vector<SweepSegment>(4096);
  StepProbe probe;

  StepReport step(World& world) {
    probe.segments = {segments.data(), static_cast<uint32_t>(segments.size())};
    probe.segment_count = 0;
    const StepReport report = step_probed(world, probe);
    EXPECT_LE(probe.segment_count, segments.size());
    return report;
  }
  /// Times at which a body's motion changes, in order, with both ends of the tick.
  std::vector<double> changes() const {
    std::vector<double> times = {0, 1};
    for (uint32_t i = 0; i < probe.segment_count; ++i) times.push_back(time_of(segments[i].from));
    for (size_t i = 1; i < times.size(); ++i) {
      for (size_t j = i; j > 0 && times[j] < times[j - 1]; --j) std::swap(times[j], times[j - 1]);
    }
    return times;
  }
  static double time_of(Fraction fraction) { return ldexp(static_cast<double>(fraction.raw), -Fraction::k_frac); }
  /// The pose of a body at a time; `still` if the body has no segment. At a time at which the motion changes: the pose
  /// before the change.
  SegmentPose at(uint32_t body, double time, const SegmentPose& still) const {
    const SweepSegment* now = nullptr;
    for (uint32_t i = 0; i < probe.segment_count; ++i) {
      const SweepSegment& segment = segments[i];
      if (segment.body == body && (now == nullptr || time_of(segment.from) < time)) now = &segment;
    }
    if (now == nullptr) return still;
    const double from = time_of(now->from), part = from < 1 ? (time - from) / (1 - from) : 0;
    return {difference(now->start.position, Position{}) + host(now->displacement) * part,
            detent_oracle::rotation_by(host(now->rotation_vector) * part) * host(now->start.rotation)};
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
