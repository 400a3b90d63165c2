#pragma once
#include <stdint.h>

/// Integers as bytes, lowest byte first, the same on every machine.
namespace detent_rollback {

class Writer {
 public:
  explicit Writer(uint8_t* bytes) : bytes_(bytes) {}
  void put(uint64_t value, uint32_t bytes) {
    for (uint32_t i = 0; i < bytes; ++i) bytes_[count_++] = static_cast<uint8_t>(value >> (8 * i));
  }
  void put_u8(uint32_t value) { put(value, 1); }
  void put_u32(uint32_t value) { put(value, 4); }
  void put_u64(uint64_t value) { put(value, 8); }
  uint32_t count() const { return count_; }

 private:
  uint8_t* bytes_;
  uint32_t count_ = 0;
};

/// Reads the bytes in order. A read past the end returns 0, and `is_at_end` is then false for good.
class Reader {
 public:
  Reader(const uint8_t* bytes, uint32_t count) : bytes_(bytes), left_(count) {}
  uint64_t take(uint32_t bytes) {
    if (left_ < bytes) {
      short_ = true;
      return 0;
    }
    uint64_t value = 0;
    for (uint32_t i = 0; i < bytes; ++i) value |= uint64_t{bytes_[i]} << (8 * i);
    bytes_ += bytes;
    left_ -= bytes;
    return value;
  }
  uint8_t take_u8() { return static_cast<uint8_t>(take(1)); }
  uint32_t take_u32() { return static_cast<uint32_t>(take(4)); }
  uint64_t take_u64() { return take(8); }
  /// Whether all bytes were read, and no read went past the end.
  bool is_at_end() const { return !short_ && left_ == 0; }

 private:
  const uint8_t* bytes_;
  uint32_t left_;
  bool short_ = false;
};

}  // namespace detent_rollback
