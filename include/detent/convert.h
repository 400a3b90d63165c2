#pragma once
#include <detent/math.h>
#include <detent/scaled.h>
#include <detent/status.h>

/// @file
/// The only conversions between the host's doubles and the library's numbers. They read and write the bits of the
/// double, so the caller's rounding mode, flush-to-zero and -ffast-math have no effect.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// `result` = value, rounded to nearest (ties away from zero; f32: to even). -0 and numbers too small for the format
/// become +0. Range: |value| < 2^17 for Real, < 2 for Unit, < 2^31 (fx32: 2^15) for Coord. For Scaled: 0, or 2^-100 <
/// |value| < 2^100. Errors: out_of_range, also for NaN and infinity; `result` is then unchanged.
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
