#pragma once
#include <detent/config.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The indices after and before `i` in the cycle 0, 1, 2, 0, computed without a division.
template <class Index>
constexpr Index next_of_three(Index i) {
  return i == 2 ? Index{0} : static_cast<Index>(i + 1);
}
template <class Index>
constexpr Index previous_of_three(Index i) {
  return i == 0 ? Index{2} : static_cast<Index>(i - 1);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
