#pragma once
#include <stdint.h>

#include <memory>
#include <string>
#include <vector>

/// Recordings as streams of bytes, from and to files that may be compressed.
namespace detent_tool {

/// What a compressed file may unpack to, bytes: a small file must not keep a machine busy for days.
inline constexpr uint64_t k_unpacked_bytes_max = uint64_t{1} << 30;
/// And the snapshot in it: its world takes a few times as much memory.
inline constexpr uint64_t k_unpacked_snapshot_bytes_max = uint64_t{1} << 28;

/// A recording to read. Whether it is compressed is seen by its first bytes, not by its name.
class Input {
 public:
  /// Null, and why not.
  static std::unique_ptr<Input> open(const std::string& path, std::string& problem);
  virtual ~Input() = default;
  /// `got` is less than `count` only at the end. False: it cannot be read, and `problem` says why.
  virtual bool read(uint8_t* bytes, uint32_t count, uint32_t& got) = 0;
  virtual bool seek(uint64_t offset) = 0;

  uint64_t file_bytes = 0;          ///< on the disk
  uint64_t bytes_max = 0;           ///< no more than these can be read
  uint64_t snapshot_bytes_max = 0;  ///< no larger one can be in it
  std::string problem;
};

/// Bytes as an input.
std::unique_ptr<Input> open_bytes(std::shared_ptr<const std::vector<uint8_t>> bytes);

/// A recording to write. What a failed or abandoned one has written stays.
class Output {
 public:
  /// Null, and why not.
  static std::unique_ptr<Output> open(const std::string& path, bool compressed, std::string& problem);
  virtual ~Output() = default;
  virtual bool write(const uint8_t* bytes, uint32_t count) = 0;
  /// Whether all of it has reached the file.
  virtual bool close() = 0;
};

/// A copy of the file, compressed. What went wrong, or nothing; then there is no `to`.
std::string compress(const std::string& from, const std::string& to);

inline constexpr const char* k_compressed_suffix = ".zst";
bool ends_with(const std::string& text, const std::string& end);

}  // namespace detent_tool
