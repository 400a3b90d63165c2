#pragma once
#include <detent/scalar.h>

/// @file
/// Fractions of a step.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A fraction of a step, in [0, 1], with a resolution of 2^-62.
using Fraction = Fixed<int64_t, 62>;
/// The fraction as a Real. Rounding: down.
Real real_from_fraction(Fraction fraction);
/// The nearest double, ties to even.
double fraction_to_host(Fraction fraction);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
