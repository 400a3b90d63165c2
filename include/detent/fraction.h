#pragma once
#include <detent/scalar.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A part of a step, in [0, 1], in steps of 2^-62.
using Fraction = Fixed<int64_t, 62>;
/// Rounded down.
Real real_from_fraction(Fraction fraction);
double fraction_to_host(Fraction fraction);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
