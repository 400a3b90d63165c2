#include "stream.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>

#include "file.h"
#include "text.h"
#include "zstandard.h"
#if defined(_WIN32)
#include <io.h>
#include <sys/stat.h>
#else
#include <unistd.h>
#endif

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

struct PlainOutput final : Output {
  explicit PlainOutput(File opened) : file(std::move(opened)) {}
  bool write(const uint8_t* bytes, uint32_t count) override {
    file_bytes += count;
    return count == 0 || fwrite(bytes, 1, count, file.get()) == count;
  }
  bool finish() override { return fclose(file.release()) == 0; }

  File file;
};

/// The newest temporary file; a signal that ends the program removes it.
char temporary_to_remove[4096];

void remove_temporary(int signal_number) {
  if (temporary_to_remove[0] != 0) remove(temporary_to_remove);
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

void remove_at_signals(const std::string& path) {
  temporary_to_remove[0] = 0;
  if (path.empty() || path.size() >= sizeof temporary_to_remove) return;
  memcpy(temporary_to_remove, path.c_str(), path.size() + 1);
#if defined(_WIN32)
  const int signals[] = {SIGINT, SIGTERM};
#else
  const int signals[] = {SIGINT, SIGTERM, SIGHUP};
#endif
  for (const int each : signals) {
    if (signal(each, remove_temporary) == SIG_IGN) signal(each, SIG_IGN);
  }
}

#if defined(_WIN32)
/// Creates a file. Null if the file exists or creation fails; `errno` has the reason.
File create_file(const std::string& path) {
  const int file = _open(path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
  return File(file < 0 ? nullptr : _fdopen(file, "wb"));
}

/// Reserves standard output for these bytes: all printed text goes to standard error from here on.
File take_standard_output() {
  fflush(stdout);
  const int file = _dup(_fileno(stdout));
  if (file < 0 || _dup2(_fileno(stderr), _fileno(stdout)) < 0) return nullptr;
  _setmode(file, _O_BINARY);
  return File(_fdopen(file, "wb"));
}
#else
File create_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  return File(file < 0 ? nullptr : fdopen(file, "wb"));
}

File take_standard_output() {
  fflush(stdout);
  const int file = dup(STDOUT_FILENO);
  return File(file < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0 ? nullptr : fdopen(file, "wb"));
}
#endif

/// Creates a file beside `path` with an unused name. Null on failure; `errno` has the reason.
File create_temporary(const std::string& path, std::string& temporary_path) {
  constexpr uint32_t k_names = 1000;
  for (uint32_t i = 0; i < k_names; ++i) {
    temporary_path = path + "." + std::to_string(i) + ".tmp";
    File file = create_file(temporary_path);
    if (file != nullptr || errno != EEXIST) return file;
  }
  return nullptr;
}

/// The path that symbolic links lead to; the file there need not exist yet.
std::string resolved(const std::string& path) {
  constexpr uint32_t k_links_max = 40;
  std::error_code error;
  std::filesystem::path at = path;
  for (uint32_t i = 0; i < k_links_max && std::filesystem::is_symlink(at, error); ++i) {
    at = at.parent_path() / std::filesystem::read_symlink(at, error);
  }
  return at.string();
}

}  // namespace

Output::~Output() {
  if (temporary_path_.empty()) return;
  std::error_code error;
  std::filesystem::remove(temporary_path_, error);
  remove_at_signals("");
}

bool Output::close() {
  if (!finish()) return false;
  if (temporary_path_.empty()) return true;
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error) {
    errno = error.default_error_condition().value();
    return false;
  }
  temporary_path_.clear();
  remove_at_signals("");
  return true;
}

std::unique_ptr<Input> Input::open(const std::string& path, std::string& problem) {
  File file = open_file(path, "rb");
  if (file == nullptr) {
    problem = with_reason("cannot be opened");
    return nullptr;
  }
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

std::unique_ptr<Output> Output::open(const std::string& path, bool compressed, std::string& problem) {
  errno = 0;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const bool exists = std::filesystem::exists(status);
  std::string target, temporary_path;
  File file;
  if (path == "-" || path == "/dev/stdout") {
    file = take_standard_output();
  } else if (exists && !std::filesystem::is_regular_file(status)) {
    file = open_file(path, "wb");
  } else {
    target = resolved(path);
    // A file without write permission must not be replaced either.
    if (!exists || open_file(target, "r+b") != nullptr) file = create_temporary(target, temporary_path);
    if (file != nullptr && exists) std::filesystem::permissions(temporary_path, status.permissions(), error);
    if (file != nullptr) remove_at_signals(temporary_path);
  }
  if (file == nullptr) {
    problem = with_reason("cannot be written");
    return nullptr;
  }
  std::unique_ptr<Output> output =
      compressed ? pack(std::move(file), problem) : std::make_unique<PlainOutput>(std::move(file));
  if (output == nullptr) {
    std::filesystem::remove(temporary_path, error);
    return nullptr;
  }
  output->path_ = target;
  output->temporary_path_ = temporary_path;
  return output;
}

std::string write_file(const std::string& path, const std::vector<uint8_t>& bytes) {
  std::string problem;
  const std::unique_ptr<Output> output = Output::open(path, false, problem);
  if (output == nullptr) return problem;
  const bool written = output->write(bytes.data(), static_cast<uint32_t>(bytes.size())) && output->close();
  return written ? "" : with_reason("cannot be written");
}

std::string compress(const std::string& from, const std::string& to) {
  std::string problem;
  const std::unique_ptr<Input> input = Input::open(from, problem);
  if (input == nullptr) return problem;
  if (ends_with(from, k_compressed_suffix)) return "is compressed already";
  const std::unique_ptr<Output> output = Output::open(to, true, problem);
  if (output == nullptr) return to + " " + problem;
  uint8_t piece[4096];
  for (uint32_t got = sizeof piece; got == sizeof piece;) {
    if (!input->read(piece, sizeof piece, got)) return input->problem;
    if (!output->write(piece, got)) return with_reason(to + " cannot be written");
  }
  return output->close() ? "" : with_reason(to + " cannot be written");
}

}  // namespace detent_tool
