#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The way into the code that traces, for a recorder.
struct Tracer {
  /// Steps the recorder's world, and writes the trace of the tick in front of its record.
  StepReport (*step)(Recorder& recorder);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
