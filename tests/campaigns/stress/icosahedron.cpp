#include "tests/campaigns/stress/icosahedron.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ports/host/cook/cook.h"
#include "tests/campaigns/stress/stage.h"

namespace detent_stress {

CookedIcosahedron cook_icosahedron(double radius) {
  const detent_cook::CookResult result = detent_cook::cook_hull(icosahedron_points(radius));
  if (result.bytes.empty()) {
    fprintf(stderr, "an icosahedron of %g m cannot be cooked: %s\n", radius, result.reason.c_str());
    abort();
  }
  CookedIcosahedron cooked;
  cooked.byte_count = static_cast<uint32_t>(result.bytes.size());
  cooked.words.resize((result.bytes.size() + 7) / 8);
  memcpy(cooked.words.data(), result.bytes.data(), result.bytes.size());
  cooked.rotation = result.rotation;
  return cooked;
}

}  // namespace detent_stress
