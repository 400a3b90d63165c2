#pragma once
#include <detent/math.h>
#include <detent/scaled.h>
#include <detent/status.h>

/// @file
/// The one way between the host's doubles and the library's numbers: by bits alone, so that neither the rounding mode,
/// flush-to-zero nor -ffast-math of the caller can matter.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// `result` = value, rounded to nearest (ties away from zero; f32: to even). -0 and numbers too small for the format
/// become +0. Range: |value| < 2^17 for Real, < 2 for Unit, < 2^31 (fx32: 2^15) for Coord; 0 or 2^-100 < |value| <
/// 2^100 for Scaled. Errors: out_of_range, also for NaN and infinity; `result` is then untouched.
/// @{
Status real_from_host(double value, Real& result);
Status unit_from_host(double value, Unit& result);
Status coord_from_host(double value, Coord& result);
Status scaled_from_host(double value, Scaled& result);
/// @}

/// The nearest double, ties to even.
/// @{
double real_to_host(Real value);
double unit_to_host(Unit value);
double coord_to_host(Coord value);
double scaled_to_host(Scaled value);
/// @}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
