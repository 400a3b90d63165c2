#include <string.h>

#include "stream.h"

namespace detent_tool {

namespace {

struct ByteInput final : Input {
  explicit ByteInput(std::shared_ptr<const std::vector<uint8_t>> given) : bytes(std::move(given)) {}
  bool read(uint8_t* to, uint32_t count, uint32_t& got) override {
    const uint64_t left = bytes->size() - at;
    got = left < count ? static_cast<uint32_t>(left) : count;
    if (got != 0) memcpy(to, bytes->data() + at, got);
    at += got;
    return true;
  }
  bool seek(uint64_t offset) override {
    at = offset < bytes->size() ? offset : bytes->size();
    return true;
  }

  std::shared_ptr<const std::vector<uint8_t>> bytes;
  uint64_t at = 0;
};

}  // namespace

std::unique_ptr<Input> open_bytes(std::shared_ptr<const std::vector<uint8_t>> bytes) {
  auto input = std::make_unique<ByteInput>(std::move(bytes));
  input->file_bytes = input->bytes_max = input->snapshot_bytes_max = input->bytes->size();
  return input;
}

}  // namespace detent_tool
