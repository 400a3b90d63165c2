#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The bodies of a step, as the solver uses them.
struct SolverBodies {
  Span<const BodyProperties> properties;
  Span<BodyMotion> motions;
  Span<BodyWork> work;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
