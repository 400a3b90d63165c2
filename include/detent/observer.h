#pragma once
#include <detent/profile.h>

/// @file
/// Who looks on while a world steps.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct World;

/// Is told of the end of each stage of each step that is not idle. Set World::observer; without it nothing is called,
/// and in either case the state is the same. For tools that look for the stage in which two machines part.
struct StepObserver {
  /// `contacts`: that the step has found so far, in its work space. Must not change the world. The state is that within
  /// the step: no call of world.h may be made on it but `digest`, `save` and the getters.
  void (*stage_ended)(void* context, const World& world, StepStage stage, uint32_t contacts) = nullptr;
  void* context = nullptr;  ///< handed to `stage_ended`
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
