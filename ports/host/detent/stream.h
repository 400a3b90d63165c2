#pragma once
#include <stdint.h>

#include <memory>
#include <string>
#include <vector>

/// Files as streams of bytes: recordings to read, possibly compressed, and all files that the tool writes.
namespace detent_tool {

/// The largest number of bytes that are read from a compressed file, so that a small file cannot occupy a machine for
/// days.
inline constexpr uint64_t k_unpacked_bytes_max = uint64_t{1} << 30;
/// The largest snapshot in a compressed file, bytes. The limit bounds the memory of the world, which is a few times as
/// large as its snapshot.
inline constexpr uint64_t k_unpacked_snapshot_bytes_max = uint64_t{1} << 28;

/// A recording to read. The first bytes of the file, not its name, decide whether it is compressed.
class Input {
 public:
  /// Null on failure, with the reason in `problem`.
  static std::unique_ptr<Input> open(const std::string& path, std::string& problem);
  virtual ~Input() = default;
  /// Reads the next bytes. `got` is less than `count` only at the end. Returns false on a read error, with the reason
  /// in `problem`.
  virtual bool read(uint8_t* bytes, uint32_t count, uint32_t& got) = 0;
  virtual bool seek(uint64_t offset) = 0;
  /// Called after the last byte that is needed. Returns whether the rest of the file is complete; a compressed file
  /// ends with a checksum. If not, the reason is in `problem`.
  virtual bool ends_whole() { return true; }

  uint64_t file_bytes = 0;          ///< size of the file on the disk
  uint64_t bytes_max = 0;           ///< limit of the number of bytes that can be read
  uint64_t snapshot_bytes_max = 0;  ///< limit of the snapshot's size
  std::string problem;
};

/// Makes an input of bytes in memory.
std::unique_ptr<Input> open_bytes(std::shared_ptr<const std::vector<uint8_t>> bytes);

/// A file to write. The file gets its name when it is complete and closed. Until then the bytes are in a temporary file
/// in the same folder, and an existing file of that name stays unchanged. Devices and pipes are written directly. The
/// path "-" is standard output; all text that is printed afterwards goes to standard error.
class Output {
 public:
  /// Null on failure, with the reason in `problem`.
  static std::unique_ptr<Output> open(const std::string& path, bool compressed, std::string& problem);
  Output() = default;
  Output(const Output&) = delete;
  /// Discards the file if it was not closed.
  virtual ~Output();
  virtual bool write(const uint8_t* bytes, uint32_t count) = 0;
  /// Completes the file and gives it its name. Returns false if not all bytes have reached the file.
  bool close();

  uint64_t file_bytes = 0;  ///< bytes written; after close(), the file's size

 private:
  virtual bool finish() = 0;

  std::string path_, temporary_path_;  ///< empty: nothing is renamed
};

/// Writes a file of these bytes. Returns the problem; empty if none.
std::string write_file(const std::string& path, const std::vector<uint8_t>& bytes);

/// Writes a compressed copy of the file. Returns the problem; empty if none.
std::string compress(const std::string& from, const std::string& to);

inline constexpr const char* k_compressed_suffix = ".zst";

}  // namespace detent_tool
