#include "tests/campaigns/fuzz/targets.h"
#include "tests/campaigns/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

bool take(const Bytes& bytes) {
  Game(Draw(bytes.data(), bytes.size())).play();
  return true;
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  detent_queries::Random random(1);
  for (uint32_t count = 500; count <= 4000; count += 500) {
    Bytes tape(count);
    for (uint8_t& byte : tape) byte = static_cast<uint8_t>(random.below(256));
    made.push_back(tape);
  }
  return made;
}

}  // namespace

const detent_fuzz::Target k_calls_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
