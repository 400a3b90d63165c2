#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The data of the bodies of a step that the solver uses.
struct SolverBodies {
  Span<const BodyProperties> properties;
  Span<BodyMotion> motions;
  Span<BodyWork> work;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
