#pragma once
#include <detent/config.h>

/// @file
/// What a call returns.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The outcome of a call. On anything but ok no output is written and no state is changed.
enum class [[nodiscard]] Status : uint32_t{
    ok = 0,              ///< done
    bad_id,              ///< null, never given out, or its slot has been destroyed or reused
    bad_argument,        ///< an enumeration or flag outside its list
    out_of_range,        ///< NaN, infinity, or outside the range that the field states
    not_normalised,      ///< a quaternion or direction whose length is not 1 within 2^-10
    pool_full,           ///< the capacity of this kind is used up
    buffer_too_small,    ///< the caller's block or buffer holds fewer bytes than the call needs
    buffer_misaligned,   ///< the caller's block is not aligned to 8 bytes
    asset_missing,       ///< the state names an asset that the table does not hold
    asset_mismatch,      ///< the table's asset has another content than the one the state was made with
    not_detent,          ///< these bytes are no snapshot or recording
    format_unknown,      ///< a format version that this build does not read
    simulation_differs,  ///< made by another simulation version
    config_differs,      ///< made by another math configuration
    capacity_differs,    ///< made for another capacity
    corrupt,             ///< checksum, range or structure wrong
    truncated,           ///< the bytes end too early
    digest_differs,      ///< replayed to another state than the recorded one
    sink_failed,         ///< the caller's sink or source reported failure
    feature_missing,     ///< needs what this world's feature table leaves out (features.h)
    rule_missing,        ///< names a filter rule that World::filter_rules does not hold
    waiting,             ///< inputs of other players are missing: call again when they have come
};

/// A few words in English that name the status, for messages. Never null.
const char* status_text(Status status);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
