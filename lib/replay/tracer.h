#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The table through which a recorder traces. The code for this is linked only if a program uses the table (k_tracer).
struct Tracer {
  /// Steps the recorder's world, and writes the trace of the tick before the tick's record.
  StepReport (*step)(Recorder& recorder);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
