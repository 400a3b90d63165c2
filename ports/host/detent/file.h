#pragma once
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace detent_tool {

/// The largest file that is read whole, bytes. An OBJ file of the largest mesh takes about half of this.
inline constexpr uint64_t k_whole_file_bytes_max = uint64_t{1} << 28;

struct CloseFile {
  void operator()(FILE* file) const { fclose(file); }
};
using File = std::unique_ptr<FILE, CloseFile>;

/// Opens a file as binary on every system. `mode`: as for fopen(). Null if the file can't be opened or is a folder;
/// `errno` has the reason.
inline File open_file(const std::string& path, const char* mode) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    errno = EISDIR;
    return nullptr;
  }
  return File(fopen(path.c_str(), mode));
}

/// Appends the reason in `errno` to `what`.
inline std::string with_reason(const std::string& what) { return errno == 0 ? what : what + ": " + strerror(errno); }

/// Appends the bytes of the stream, up to its end, to `bytes`. Returns the problem; empty if none.
inline std::string read_stream(FILE* file, uint64_t bytes_max, std::vector<uint8_t>& bytes) {
  constexpr size_t k_piece_bytes = 65536;
  const size_t before = bytes.size();
  for (size_t got = k_piece_bytes; got == k_piece_bytes;) {
    const size_t at = bytes.size();
    bytes.resize(at + k_piece_bytes);
    got = fread(bytes.data() + at, 1, k_piece_bytes, file);
    bytes.resize(at + got);
    if (bytes.size() - before > bytes_max) return "has more than " + std::to_string(bytes_max) + " bytes";
  }
  return ferror(file) == 0 ? "" : with_reason("cannot be read");
}

/// Reads all bytes of a file, which may be a device or a pipe. Returns the problem; empty if none.
inline std::string read_file(const std::string& path, std::vector<uint8_t>& bytes,
                             uint64_t bytes_max = k_whole_file_bytes_max) {
  const File file = open_file(path, "rb");
  return file == nullptr ? with_reason("cannot be read") : read_stream(file.get(), bytes_max, bytes);
}

/// The file's size, 0 if unknown.
inline uint64_t file_bytes(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

/// Whether both paths lead to the same regular file, directly or by links. False for devices, pipes and missing files.
inline bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return std::filesystem::is_regular_file(a, error) && std::filesystem::equivalent(a, b, error);
}

}  // namespace detent_tool
