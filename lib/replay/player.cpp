#include <detent/detail/shared.h>
#include <detent/recording.h>
#include <string.h>

#include "base/bytes.h"
#include "base/crc.h"
#include "replay/command.h"
#include "replay/format.h"
#include "replay/query_command.h"
#include "replay/replay_watch.h"
#include "state/snapshot.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Player::Player(Source source, uint8_t* buffer, uint32_t buffer_bytes)
    : source_(source), buffer_(buffer), buffer_bytes_(buffer_bytes) {}

DETENT_SHARED Status Player::fail(Status status, uint64_t offset, const char* field) {
  if (error_.status != Status::ok) return error_.status;
  error_.status = status;
  error_.tick = tick_;
  error_.offset = offset;
  error_.field = field;
  return status;
}

Status Player::read(uint8_t* bytes, uint32_t count, const char* field) {
  uint32_t got = 0;
  const Status status = source_.read(source_.context, bytes, count, got);
  if (status != Status::ok || got > count) return fail(Status::sink_failed, offset_, field);
  offset_ += got;
  return got == count ? Status::ok : fail(Status::truncated, offset_, field);
}

Status Player::open() {
  if (error_.status != Status::ok) return error_.status;
  if (state_ != State::closed) return Status::bad_argument;
  if (source_.read == nullptr) return fail(Status::bad_argument, 0, "source");
  if (buffer_ == nullptr || buffer_bytes_ < k_recording_buffer_bytes)
    return fail(Status::buffer_too_small, 0, "buffer");

  // The length of the header depends on the version, so the version is checked before the checksum.
  constexpr uint32_t k_start_bytes = k_magic_bytes + k_version_bytes;
  if (read(buffer_, k_magic_bytes, "magic") != Status::ok) return error_.status;
  if (!have_same_bytes(buffer_, k_recording_magic, k_magic_bytes)) return fail(Status::not_detent, 0, "magic");
  if (read(buffer_ + k_magic_bytes, k_version_bytes, "format version") != Status::ok) return error_.status;
  Reader version_reader{buffer_ + k_magic_bytes, k_version_bytes};
  visit_word(version_reader, "format version", info_.format_version);
  if (info_.format_version != k_recording_format_version) {
    return fail(Status::format_unknown, k_magic_bytes, "format version");
  }
  if (read(buffer_ + k_start_bytes, k_header_bytes - k_start_bytes, "header") != Status::ok) return error_.status;
  const uint32_t count = k_magic_bytes + k_info_bytes;
  if (read_checksum(buffer_ + count) != crc32(buffer_, count)) return fail(Status::corrupt, 0, "header checksum");

  Reader reader{buffer_ + k_magic_bytes, k_info_bytes};
  visit(reader, info_);
  if (reader.failed != nullptr) return fail(Status::corrupt, k_magic_bytes + reader.failed_at, reader.failed);
  tick_ = info_.tick;
  if (info_.simulation_version != k_simulation_version) {
    return fail(Status::simulation_differs, k_simulation_at, "simulation version");
  }
  if (info_.config != k_config) return fail(Status::config_differs, k_config_at, "configuration");
  if (info_.snapshot_bytes == 0 || info_.snapshot_bytes != snapshot_bytes(info_.capacity)) {
    return fail(Status::corrupt, k_snapshot_bytes_at, "snapshot bytes");
  }
  state_ = State::opened;
  return Status::ok;
}

Status Player::read_chunk() {
  for (;;) {
    const uint64_t start = offset_;
    if (read(buffer_, k_chunk_header_bytes, "chunk header") != Status::ok) return error_.status;
    ChunkHeader header;
    Reader reader{buffer_, k_chunk_header_bytes};
    visit(reader, header);
    if (header.payload_count > k_chunk_payload_bytes_max) return fail(Status::corrupt, start, "chunk length");
    payload_count_ = static_cast<uint32_t>(header.payload_count);
    payload_at_ = 0;
    const uint32_t count = k_chunk_header_bytes + payload_count_;
    if (read(buffer_ + k_chunk_header_bytes, payload_count_ + k_checksum_bytes, "chunk") != Status::ok) {
      return error_.status;
    }
    if (read_checksum(buffer_ + count) != crc32(buffer_, count)) return fail(Status::corrupt, start, "chunk checksum");
    if (header.sequence != sequence_) return fail(Status::corrupt, start, "chunk sequence");
    if (header.tick != tick_) return fail(Status::corrupt, start, "chunk tick");
    ++sequence_;
    chunk_type_ = static_cast<uint32_t>(header.type);
    chunk_offset_ = start;
    const ChunkType type = static_cast<ChunkType>(chunk_type_);
    if (type == ChunkType::seed || type == ChunkType::calls || type == ChunkType::end || type == ChunkType::keyframe) {
      return Status::ok;
    }
    if (watch_ != nullptr && (type == ChunkType::stages || type == ChunkType::state)) {
      watch_->traced(watch_->context, type, buffer_ + k_chunk_header_bytes, payload_count_);
    }
    if ((chunk_type_ & k_chunk_optional) == 0) return fail(Status::format_unknown, start, "chunk type");
  }
}

Status Player::read_state(uint32_t offset, uint8_t* bytes, uint32_t count) {
  if (offset != state_at_ || count > info_.snapshot_bytes - state_at_) {
    return fail(Status::corrupt, offset_, "state length");
  }
  while (count != 0) {
    if (payload_at_ == payload_count_) {
      if (read_chunk() != Status::ok) return error_.status;
      if (chunk_type_ != state_type_) return fail(Status::corrupt, chunk_offset_, "chunk order");
      continue;
    }
    const uint32_t left = payload_count_ - payload_at_;
    const uint32_t piece = left < count ? left : count;
    if (bytes != nullptr) {
      memcpy(bytes, buffer_ + k_chunk_header_bytes + payload_at_, piece);
      bytes += piece;
    }
    payload_at_ += piece;
    state_at_ += piece;
    count -= piece;
  }
  return Status::ok;
}

Status Player::read_state_from(void* player, uint32_t offset, uint8_t* bytes, uint32_t count) {
  return static_cast<Player*>(player)->read_state(offset, bytes, count);
}

Status Player::load_state(World& world) {
  const Status loaded = load_from(world, read_state_from, this);
  const bool seed = state_type_ == static_cast<uint32_t>(ChunkType::seed);
  if (loaded != Status::ok) return fail(loaded, chunk_offset_, seed ? "seed" : "keyframe");
  const bool right = get_info(world).tick == tick_;
  const Status ended = right ? end_state() : fail(Status::corrupt, chunk_offset_, "state tick");
  if (ended == Status::ok) return ended;
  const Status emptied = empty_world(world, info_.capacity);
  return emptied == Status::ok ? ended : emptied;
}

Status Player::pass_state() {
  if (read_state(0, nullptr, info_.snapshot_bytes) != Status::ok) return error_.status;
  return end_state();
}

Status Player::end_state() {
  if (state_at_ != info_.snapshot_bytes || payload_at_ != payload_count_) {
    return fail(Status::corrupt, chunk_offset_, "state length");
  }
  state_ = State::playing;
  return Status::ok;
}

void Player::begin_state(uint32_t type) {
  state_type_ = type;
  state_at_ = 0;
}

Status Player::begin_keyframe(uint64_t& digest) {
  if (!is_due(info_.keyframe_interval, tick_)) return fail(Status::corrupt, chunk_offset_, "keyframe tick");
  Reader reader{buffer_ + k_chunk_header_bytes, payload_count_};
  reader.bits("keyframe digest", digest, k_keyframe_digest_bytes);
  if (reader.failed != nullptr) return fail(Status::corrupt, chunk_offset_, "state length");
  payload_at_ = reader.at;
  begin_state(static_cast<uint32_t>(ChunkType::keyframe));
  return Status::ok;
}

/// Skips a keyframe. If `world` is not null, compares the keyframe's digest with that of the world. Does not check that
/// the keyframe's snapshot has this digest; go_to() checks this when it loads a keyframe.
Status Player::pass_keyframe(const World* world) {
  uint64_t recorded = 0;
  if (begin_keyframe(recorded) != Status::ok) return error_.status;
  const uint64_t offset = chunk_offset_;
  if (pass_state() != Status::ok) return error_.status;
  return world == nullptr ? Status::ok : compare(*world, recorded, offset, "keyframe digest");
}

Status Player::prepare(const World& world) {
  if (error_.status != Status::ok) return error_.status;
  if (state_ != State::opened) return Status::bad_argument;
  if (!(get_info(world).capacity == info_.capacity)) return fail(Status::capacity_differs, k_capacity_at, "capacity");
  return Status::ok;
}

Status Player::pass_seed() {
  begin_state(static_cast<uint32_t>(ChunkType::seed));
  return pass_state();
}

Status Player::start(World& world) {
  const Status prepared = prepare(world);
  if (prepared != Status::ok) return prepared;
  begin_state(static_cast<uint32_t>(ChunkType::seed));
  return load_state(world);
}

Status Player::start_at(World& world) {
  const Status prepared = prepare(world);
  if (prepared != Status::ok) return prepared;
  if (pass_seed() != Status::ok) return error_.status;
  const uint64_t target = get_info(world).tick;
  if (target < tick_) return fail(Status::out_of_range, offset_, "tick of the saved state");
  TickResult result;
  while (tick_ < target) {
    const uint64_t at = offset_;
    if (skip_tick(result) != Status::ok) return error_.status;
    if (result.finished) return fail(Status::out_of_range, at, "tick of the saved state");
  }
  if (result.compared) return compare(world, result.digest, chunk_offset_, "digest of the saved state");
  return Status::ok;
}

Status Player::compare(const World& world, uint64_t recorded, uint64_t offset, const char* field) {
  const uint64_t replayed = digest(world);
  if (replayed == recorded) return Status::ok;
  error_.digest_recorded = recorded;
  error_.digest_replayed = replayed;
  return fail(Status::digest_differs, offset, field);
}

Status Player::query(const World* world, Reader& reader, uint64_t offset) {
  uint64_t length = 0;
  reader.bits("query length", length, 2);
  reader.require("query length", length <= reader.count - reader.at, Status::corrupt);
  if (reader.failed != nullptr) return Status::ok;
  Reader question{reader.bytes, reader.at + static_cast<uint32_t>(length), reader.at};
  reader.at = question.count;
  if (repeater_ == nullptr || world == nullptr) return Status::ok;
  uint64_t recorded = 0, replayed = 0;
  const Status status = repeater_->repeat(*world, question, recorded, replayed);
  question.require("query length", question.at == question.count, Status::corrupt);
  if (question.failed != nullptr) {
    reader.failed = question.failed;
    reader.failed_at = question.failed_at;
    return Status::ok;
  }
  if (status == Status::feature_missing) return fail(status, offset, "query");
  if (status != Status::ok) return fail(Status::digest_differs, offset, "query refused");
  if (recorded == replayed) return Status::ok;
  error_.digest_recorded = recorded;
  error_.digest_replayed = replayed;
  return fail(Status::digest_differs, offset, "query answer");
}

Status Player::call(World* world, uint32_t tag, Reader& reader, uint64_t offset) {
  if (static_cast<RecordTag>(tag) == RecordTag::query) return query(world, reader, offset);
  const CommandCode* const code = find_command(static_cast<RecordTag>(tag));
  if (code == nullptr) return fail(Status::corrupt, offset, "record tag");
  alignas(8) uint8_t command[k_command_bytes_max] = {};
  code->visit(reader, command);
  if (reader.failed != nullptr || world == nullptr) return Status::ok;
  BodyId recorded, given;  // the command's first bytes: the id of a body or joint, or a value that no call changes
  memcpy(&recorded, command, sizeof recorded);
  const Status status = code->apply(*world, command);
  memcpy(&given, command, sizeof given);
  if (status == Status::feature_missing || status == Status::rule_missing) return fail(status, offset, "call");
  if (status != Status::ok) return fail(Status::digest_differs, offset, "call refused");
  if (!(given == recorded)) return fail(Status::digest_differs, offset, "body id given");
  return Status::ok;
}

/// If the error is `truncated` or `corrupt`, marks the recording as cut off. Its intact part then ends before the chunk
/// that is damaged or incomplete. Returns the error.
Status Player::cut() {
  if (error_.status == Status::truncated || error_.status == Status::corrupt) state_ = State::cut;
  return error_.status;
}

Status Player::write_end(const World& world, Sink sink) {
  if (state_ != State::cut || sink.write == nullptr || get_info(world).tick != tick_) return Status::bad_argument;
  const Ending ending{tick_ - info_.tick, digest(world)};
  const uint32_t count = make_end(buffer_, ending, whole_sequence_, tick_);
  return sink.write(sink.context, buffer_, count) == Status::ok ? Status::ok : Status::sink_failed;
}

Status Player::advance(World* world, TickResult& result) {
  if (error_.status != Status::ok) return error_.status;
  if (state_ == State::opened && world == nullptr && pass_seed() != Status::ok) return error_.status;
  if (state_ != State::playing) return Status::bad_argument;
  TickResult made;
  for (;; ++made.calls) {
    while (payload_at_ == payload_count_) {
      whole_bytes_ = offset_;
      whole_sequence_ = sequence_;
      if (read_chunk() != Status::ok) return cut();
      const ChunkType type = static_cast<ChunkType>(chunk_type_);
      if (type == ChunkType::end) {
        if (finish(world, made) != Status::ok) return error_.status;
        result = made;
        return Status::ok;
      }
      if (type == ChunkType::keyframe) {
        if (pass_keyframe(world) != Status::ok) return cut();
        continue;
      }
      if (type != ChunkType::calls) return fail(Status::corrupt, chunk_offset_, "chunk order");
    }
    const uint64_t offset = chunk_offset_ + k_chunk_header_bytes + payload_at_;
    Reader reader{buffer_ + k_chunk_header_bytes, payload_count_, payload_at_};
    uint64_t tag = 0;
    reader.bits("record tag", tag, 1);
    const bool digested = tag == static_cast<uint64_t>(RecordTag::tick_digested);
    const bool tick = digested || tag == static_cast<uint64_t>(RecordTag::tick);
    Status status = Status::ok;
    if (!tick)
      status = call(world, static_cast<uint32_t>(tag), reader, offset);
    else if (digested)
      reader.bits("digest", made.digest, 8);
    if (reader.failed != nullptr) {
      return fail(Status::corrupt, chunk_offset_ + k_chunk_header_bytes + reader.failed_at, reader.failed);
    }
    if (status != Status::ok) return status;
    if (watch_ != nullptr && !tick) {
      watch_->called(watch_->context, reader.bytes + payload_at_, reader.at - payload_at_);
    }
    payload_at_ = reader.at;
    if (!tick) continue;

    if (digested != is_due(info_.digest_interval, tick_ + 1)) return fail(Status::corrupt, offset, "digest interval");
    if (world != nullptr) made.report = step(*world);
    made.tick = ++tick_;
    made.compared = digested;
    if (digested && world != nullptr && compare(*world, made.digest, offset, "digest") != Status::ok) {
      return error_.status;
    }
    result = made;
    return Status::ok;
  }
}

Status Player::finish(const World* world, TickResult& made) {
  Ending ending;
  Reader reader{buffer_ + k_chunk_header_bytes, payload_count_};
  visit(reader, ending);
  if (reader.failed != nullptr || reader.at != payload_count_) {
    return fail(Status::corrupt, chunk_offset_, "end length");
  }
  if (ending.ticks != tick_ - info_.tick) return fail(Status::corrupt, chunk_offset_, "tick count");
  const uint64_t end = offset_;
  uint8_t extra = 0;
  uint32_t got = 0;
  if (source_.read(source_.context, &extra, 1, got) != Status::ok) return fail(Status::sink_failed, end, "end");
  if (got != 0) return fail(Status::corrupt, end, "bytes after the end");
  if (world != nullptr && compare(*world, ending.digest, chunk_offset_, "final digest") != Status::ok) {
    return error_.status;
  }
  state_ = State::finished;
  made.finished = true;
  made.compared = true;
  made.tick = tick_;
  made.digest = ending.digest;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
