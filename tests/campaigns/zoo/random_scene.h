#pragma once
#include <stdint.h>

#include <string>

namespace detent_zoo {

/// Bodies of random shape that fall on fixed ground of random kind.
struct RandomScene {
  std::string ground;   ///< its kind
  uint32_t bodies = 0;  ///< dynamic ones
  std::string text;     ///< of a scene file (docs/scene.md)
};

/// The scene with this seed, the same on every machine. Half of the scenes have one body, the others two to six smaller
/// ones, one above the other. No two bodies overlap at the start, and no body can fall past the floor. Box, plate, rod,
/// capsule, cylinder and cone are up to 2 m long (with other bodies 1 m), hulls and compounds are those of the zoo.
/// `assets`: the path from the scene's folder to that of the cooked files; empty, or with a slash at its end.
RandomScene random_scene(uint64_t seed, const std::string& assets = "");

}  // namespace detent_zoo
