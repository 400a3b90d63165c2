#pragma once
#include "state/view.h"

/// A state as the ring of the last ticks keeps it: what is in use, without what is mostly zero of it - forces to come,
/// the second to fourth points of contacts, manifolds that are found anew. For this program alone.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Writes it, behind its header; how many bytes. There is room for packed_bytes_max().
uint32_t pack_state(const StateView<const uint8_t>& state, uint8_t* bytes);

/// Makes it the state of `to`, which holds one: all but the header.
void unpack_state(const uint8_t* bytes, const StateView<uint8_t>& to);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
