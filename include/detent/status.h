#pragma once
#include <detent/config.h>

/// @file
/// The status that a call returns.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The outcome of a call. If it is not ok, no output is written and no state is changed, unless the call says
/// otherwise.
enum class [[nodiscard]] Status : uint32_t{
    ok = 0,              ///< done
    bad_id,              ///< the id is null, was never returned, or its object has been destroyed
    bad_argument,        ///< an argument that the call does not accept, or a call in the wrong order
    out_of_range,        ///< NaN, infinity, or outside the range that the field states
    not_normalised,      ///< a quaternion or direction whose length is not 1 within 2^-10
    pool_full,           ///< the capacity for this kind of object is used up
    buffer_too_small,    ///< the caller's block or buffer holds fewer bytes than the call needs
    buffer_misaligned,   ///< the caller's block, buffer or asset is not aligned to 8 bytes
    asset_missing,       ///< an asset is not in the asset table, or is not bound
    asset_mismatch,      ///< the asset in the table differs from the asset that the state was simulated with
    not_detent,          ///< the bytes are not in a format of Detent
    format_unknown,      ///< the bytes have a format version that this build does not read
    simulation_differs,  ///< the bytes were written by another simulation version
    config_differs,      ///< the bytes were written by another math configuration
    capacity_differs,    ///< the bytes or the world have another capacity
    corrupt,             ///< a checksum, a range or the structure of the bytes is wrong
    truncated,           ///< the bytes end too early
    digest_differs,      ///< a state differs from the recorded or expected state
    sink_failed,         ///< the caller's sink or source reported failure
    feature_missing,     ///< the call needs a feature that this world's feature table lacks (features.h)
    rule_missing,        ///< a filter names a rule that WorldHooks::filter_rules does not have
    waiting,             ///< inputs of other players are missing: call again when they have arrived
};

/// A short English description of the status, for messages. Never null.
const char* status_text(Status status);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
