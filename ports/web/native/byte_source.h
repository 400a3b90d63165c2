#pragma once
#include <detent/recording.h>
#include <string.h>

namespace detent_web {

using namespace detent;

/// A recording in memory, as a source of a player. The bytes and this object must not move while the player reads.
struct ByteSource {
  const uint8_t* bytes = nullptr;
  uint32_t count = 0;
  uint64_t at = 0;

  Source source() {
    return {[](void* context, uint8_t* to, uint32_t wanted, uint32_t& got) {
              ByteSource& from = *static_cast<ByteSource*>(context);
              const uint64_t left = from.at < from.count ? from.count - from.at : 0;
              got = wanted < left ? wanted : static_cast<uint32_t>(left);
              if (got != 0) memcpy(to, from.bytes + from.at, got);
              from.at += got;
              return Status::ok;
            },
            this,
            [](void* context, uint64_t offset) {
              static_cast<ByteSource*>(context)->at = offset;
              return Status::ok;
            }};
  }
};

}  // namespace detent_web
