#pragma once
#include <stdint.h>
#include <stdio.h>

#include <filesystem>
#include <memory>
#include <string>

namespace detent_tool {

struct CloseFile {
  void operator()(FILE* file) const { fclose(file); }
};
using File = std::unique_ptr<FILE, CloseFile>;

/// Binary on every system. `mode`: "rb" or "wb". Null if it can't be opened, or is a folder.
inline File open_file(const std::string& path, const char* mode) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return nullptr;
  return File(fopen(path.c_str(), mode));
}

/// 0 if it is unknown.
inline uint64_t file_bytes(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

}  // namespace detent_tool
