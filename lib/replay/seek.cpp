#include <detent/recording.h>

#include "replay/format.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Moves the source to `place`, so that the next chunk is read from there.
Status Player::seek(const Place& place) {
  if (source_.seek(source_.context, place.offset) != Status::ok) return fail(Status::sink_failed, place.offset, "seek");
  offset_ = place.offset;
  tick_ = place.tick;
  sequence_ = place.sequence;
  payload_at_ = payload_count_ = 0;
  return Status::ok;
}

/// Searches for the last keyframe at or before `tick`, from `place` on. If there is one, sets `place` to it and `found`
/// to true. If the search reaches the chunk that ends the recording, sets `beyond` to whether the recording ends before
/// `tick`; otherwise leaves `beyond` as it is. The search reads only the headers of chunks; the player tests the
/// checksum of a chunk when it reads the chunk later. The search ends at a header that cannot be valid, or at the end
/// of the bytes. A keyframe counts only if a chunk of another type follows it, which shows that the keyframe is
/// complete.
Status Player::find_keyframe(Place& place, uint64_t tick, bool& found, bool& beyond) {
  Place at = place, candidate = {};
  bool within = false;
  for (;;) {
    // The header is not read into `buffer_`, because `buffer_` may hold a chunk in use.
    uint8_t bytes[k_chunk_header_bytes];
    uint32_t got = 0;
    if (source_.seek(source_.context, at.offset) != Status::ok ||
        source_.read(source_.context, bytes, k_chunk_header_bytes, got) != Status::ok || got > k_chunk_header_bytes) {
      return fail(Status::sink_failed, at.offset, "seek");
    }
    if (got < k_chunk_header_bytes) return Status::ok;
    ChunkHeader header;
    Reader reader{bytes, k_chunk_header_bytes};
    visit(reader, header);
    if (header.payload_count > k_chunk_payload_bytes_max || header.sequence != at.sequence) return Status::ok;
    const ChunkType type = static_cast<ChunkType>(header.type);
    if (within && type != ChunkType::keyframe) {
      place = candidate;
      found = true;
      within = false;
    }
    if (type == ChunkType::end) beyond = header.tick < tick;
    if (type == ChunkType::end || header.tick > tick) return Status::ok;
    if (type == ChunkType::keyframe && !within) {
      candidate = {at.offset, header.tick, at.sequence};
      within = true;
    }
    at.offset += k_chunk_header_bytes + header.payload_count + k_checksum_bytes;
    ++at.sequence;
  }
}

Status Player::load_keyframe(World& world, const Place& place) {
  if (seek(place) != Status::ok || read_chunk() != Status::ok) return error_.status;
  if (static_cast<ChunkType>(chunk_type_) != ChunkType::keyframe) {
    return fail(Status::corrupt, chunk_offset_, "chunk order");
  }
  const uint64_t offset = chunk_offset_;
  uint64_t recorded = 0;
  if (begin_keyframe(recorded) != Status::ok || load_state(world) != Status::ok) return error_.status;
  return compare(world, recorded, offset, "keyframe digest");
}

/// Sets the world to the latest state at or before `tick` that can be reached without playing a tick: a keyframe, the
/// seed (the first state of the recording) or the current state.
Status Player::approach(World& world, uint64_t tick) {
  const bool here = state_ == State::playing && tick >= tick_ && get_info(world).tick == tick_;
  if (source_.seek == nullptr) {
    if (state_ == State::opened) return start(world);
    return here ? Status::ok : Status::out_of_range;
  }
  const Place seed = {k_header_bytes, info_.tick, 0};
  Place place = here ? Place{offset_, tick_, sequence_} : seed;
  bool found = false, beyond = false;
  if (find_keyframe(place, tick, found, beyond) != Status::ok) return error_.status;
  if (found && !beyond) return load_keyframe(world, place);
  if (here || beyond) {
    if (source_.seek(source_.context, offset_) != Status::ok) return fail(Status::sink_failed, offset_, "seek");
    return beyond ? Status::out_of_range : Status::ok;
  }
  if (seek(seed) != Status::ok) return error_.status;
  state_ = State::opened;
  return start(world);
}

Status Player::go_to(World& world, uint64_t tick) {
  if (error_.status != Status::ok) return error_.status;
  if (state_ == State::closed) return Status::bad_argument;
  if (!(get_info(world).capacity == info_.capacity)) return fail(Status::capacity_differs, k_capacity_at, "capacity");
  if (tick < info_.tick) return Status::out_of_range;
  const Status status = approach(world, tick);
  if (status != Status::ok) return status;
  TickResult result;
  while (tick_ < tick) {
    if (next_tick(world, result) != Status::ok) return error_.status;
    if (result.finished) return Status::out_of_range;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
