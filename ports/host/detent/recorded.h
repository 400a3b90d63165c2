#pragma once
#include <vector>

#include "stream.h"

namespace detent_tool {

/// A recording that can be read repeatedly: a file, or bytes.
struct Recorded {
  std::string name;  ///< for messages
  std::string path;
  std::shared_ptr<std::vector<uint8_t>> bytes;  ///< instead of the file
  bool window = false;                          ///< the recording is a part: some ticks of a longer one

  std::unique_ptr<Input> open(std::string& problem) const {
    return bytes == nullptr ? Input::open(path, problem) : open_bytes(bytes);
  }
};

}  // namespace detent_tool
