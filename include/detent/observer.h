#pragma once
#include <detent/profile.h>

/// @file
/// A callback at the end of each stage of a step.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct World;

/// A callback at the end of each stage of each step that is not idle. Set WorldHooks::observer to use it; it does not
/// change the state. For tools that find the stage in which two machines begin to differ.
struct StepObserver {
  /// `contacts`: number of contacts that the step has found so far, in its work space. It must not change the world.
  /// The state is incomplete within the step: of world.h it may only call `digest`, `save` and the getters.
  void (*stage_ended)(void* context, const World& world, StepStage stage, uint32_t contacts) = nullptr;
  void* context = nullptr;  ///< passed to `stage_ended`
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
