#pragma once
#include <stdint.h>

#include <memory>
#include <string>
#include <vector>

/// Files as streams of bytes: recordings to read, which may be compressed, and whatever the tool writes.
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

/// A file to write. It appears under its name when it is closed, whole: until then the bytes lie in a temporary file of
/// the same folder, and what had the name before stays as it was. Devices and pipes are written as they are. "-" is
/// standard output; what the program prints after that goes to standard error.
class Output {
 public:
  /// Null, and why not.
  static std::unique_ptr<Output> open(const std::string& path, bool compressed, std::string& problem);
  Output() = default;
  Output(const Output&) = delete;
  /// What was not closed is discarded.
  virtual ~Output();
  virtual bool write(const uint8_t* bytes, uint32_t count) = 0;
  /// Whether all of it has reached the file, which then has its name.
  bool close();

  uint64_t file_bytes = 0;  ///< written: in the file, once it is closed

 private:
  virtual bool finish() = 0;

  std::string path_, temporary_path_;  ///< empty: nothing is renamed
};

/// Writes a file of these bytes. What went wrong, or nothing.
std::string write_file(const std::string& path, const std::vector<uint8_t>& bytes);

/// A copy of the file, compressed. What went wrong, or nothing.
std::string compress(const std::string& from, const std::string& to);

inline constexpr const char* k_compressed_suffix = ".zst";
bool ends_with(const std::string& text, const std::string& end);

}  // namespace detent_tool
