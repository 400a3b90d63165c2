#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The entry point of the code that traces, for a recorder. The code is linked only if a program uses this entry point.
struct Tracer {
  /// Steps the recorder's world, and writes the trace of the tick before the tick's record.
  StepReport (*step)(Recorder& recorder);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
