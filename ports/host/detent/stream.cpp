#include "stream.h"

#include <string.h>

#include "zstandard.h"

namespace detent_tool {

namespace {

bool seek_in(FILE* file, uint64_t offset) {
#if defined(_WIN32)
  return _fseeki64(file, static_cast<int64_t>(offset), SEEK_SET) == 0;
#else
  return fseeko(file, static_cast<off_t>(offset), SEEK_SET) == 0;
#endif
}

struct PlainInput final : Input {
  explicit PlainInput(File opened) : file(std::move(opened)) {}
  bool read(uint8_t* bytes, uint32_t count, uint32_t& got) override {
    got = static_cast<uint32_t>(fread(bytes, 1, count, file.get()));
    if (got == count || ferror(file.get()) == 0) return true;
    problem = "cannot be read";
    return false;
  }
  bool seek(uint64_t offset) override { return seek_in(file.get(), offset); }

  File file;
};

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

struct PlainOutput final : Output {
  explicit PlainOutput(File opened) : file(std::move(opened)) {}
  bool write(const uint8_t* bytes, uint32_t count) override { return fwrite(bytes, 1, count, file.get()) == count; }
  bool close() override { return fclose(file.release()) == 0; }

  File file;
};

}  // namespace

std::unique_ptr<Input> Input::open(const std::string& path, std::string& problem) {
  problem = "cannot be opened";
  File file = open_file(path, "rb");
  if (file == nullptr) return nullptr;
  uint8_t magic[sizeof k_zstandard_magic] = {};
  const bool compressed =
      fread(magic, 1, sizeof magic, file.get()) == sizeof magic && memcmp(magic, k_zstandard_magic, sizeof magic) == 0;
  if (fseek(file.get(), 0, SEEK_SET) != 0) {
    problem = "is no file that can be sought in";
    return nullptr;
  }
  std::unique_ptr<Input> input;
  if (compressed) {
    input = unpack(std::move(file), problem);
    if (input == nullptr) return nullptr;
  } else {
    input = std::make_unique<PlainInput>(std::move(file));
    input->bytes_max = input->snapshot_bytes_max = detent_tool::file_bytes(path);
  }
  input->file_bytes = detent_tool::file_bytes(path);
  problem.clear();
  return input;
}

std::unique_ptr<Input> open_bytes(std::shared_ptr<const std::vector<uint8_t>> bytes) {
  auto input = std::make_unique<ByteInput>(std::move(bytes));
  input->file_bytes = input->bytes_max = input->snapshot_bytes_max = input->bytes->size();
  return input;
}

std::unique_ptr<Output> Output::open(const std::string& path, bool compressed, std::string& problem) {
  problem = "cannot be opened for writing";
  File file = open_file(path, "wb");
  if (file == nullptr) return nullptr;
  if (compressed) return pack(std::move(file), problem);
  return std::make_unique<PlainOutput>(std::move(file));
}

std::string compress(const std::string& from, const std::string& to) {
  std::string problem;
  const std::unique_ptr<Input> input = Input::open(from, problem);
  if (input == nullptr) return problem;
  if (ends_with(from, k_compressed_suffix)) return "is compressed already";
  const std::unique_ptr<Output> output = Output::open(to, true, problem);
  if (output == nullptr) return problem;
  uint8_t piece[4096];
  bool good = true;
  for (uint32_t got = sizeof piece; good && got == sizeof piece;) {
    good = input->read(piece, sizeof piece, got) && output->write(piece, got);
  }
  if (output->close() && good) return "";
  std::error_code error;
  std::filesystem::remove(to, error);
  return "cannot be compressed";
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace detent_tool
