#pragma once
#include "scene_text.h"
#include "tests/common/support/ground.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The body that is the scene's ground: fixed, level, a half-space or a wide box, and the only one of these. Null if
/// there is none.
SceneBody* ground_of(SceneText& scene);
/// Gives the ground that shape, with its top where it was.
void replace_ground(SceneBody& ground, detent_test::Ground shape);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
