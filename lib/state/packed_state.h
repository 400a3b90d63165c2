#pragma once
#include "state/view.h"

/// The packed format of a state, which SnapshotRing uses. It holds only the elements in use, and omits some parts of an
/// element if they are zero: pending forces, the second to fourth points of contacts, manifolds that are not recycled.
/// Only this program can read the format.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Writes the packed state, which begins with the block header, and returns its size in bytes. `bytes` has room for
/// packed_bytes_max().
uint32_t pack_state(const StateView<const uint8_t>& state, uint8_t* bytes);

/// Replaces the state of `to` by the packed state. `to` must hold a valid state. The header does not change.
void unpack_state(const uint8_t* bytes, const StateView<uint8_t>& to);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
