#pragma once
#include "state/view.h"

/// The format of a state in the ring of the last ticks. It holds the elements in use and leaves out parts that are
/// mostly zero: pending forces, the second to fourth points of contacts, manifolds that are not recycled. The format is
/// only valid within this program.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Writes the packed state, which begins with the block header, and returns its size in bytes. `bytes` has room for
/// packed_bytes_max().
uint32_t pack_state(const StateView<const uint8_t>& state, uint8_t* bytes);

/// Replaces the state of `to`, which must hold a valid state, by the packed one. Leaves the header as it is.
void unpack_state(const uint8_t* bytes, const StateView<uint8_t>& to);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
