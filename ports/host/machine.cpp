#include <ports/machine.h>
#include <stdio.h>
#include <stdlib.h>
#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#elif defined(__wasi__)
#include <unistd.h>
#endif

namespace {
FILE* files[k_machine_files_max];

FILE* stream(MachineFile file) {
  return file.handle >= 0 && file.handle < k_machine_files_max ? files[file.handle] : nullptr;
}
}  // namespace

int main(int argc, char** argv) {
#if defined(_WIN32)
  _setmode(_fileno(stdout), _O_BINARY);  // "\n" is one byte in text, as everywhere else
#elif defined(__wasi__)
  // WASI has no current directory; ports/wasm/run.mjs passes the host's in PWD.
  const char* const directory = getenv("PWD");
  if (directory != nullptr && chdir(directory) != 0) machine_panic("the current directory does not exist");
#endif
  machine_exit(machine_main(argc, argv));
}

MachineFile machine_open(const char* path, MachineMode mode) {
  for (int32_t handle = 0; handle < k_machine_files_max; ++handle) {
    if (files[handle] != nullptr) continue;
    files[handle] = fopen(path, mode == MachineMode::read ? "rb" : "wb");
    return {files[handle] != nullptr ? handle : -1};
  }
  return {};
}

uint32_t machine_read(MachineFile file, void* bytes, uint32_t byte_count) {
  FILE* const open = stream(file);
  return open == nullptr ? 0 : static_cast<uint32_t>(fread(bytes, 1, byte_count, open));
}

uint32_t machine_write(MachineFile file, const void* bytes, uint32_t byte_count) {
  FILE* const open = stream(file);
  return open == nullptr ? 0 : static_cast<uint32_t>(fwrite(bytes, 1, byte_count, open));
}

bool machine_seek(MachineFile file, uint32_t offset) {
  FILE* const open = stream(file);
  return open != nullptr && fseek(open, static_cast<long>(offset), SEEK_SET) == 0;
}

int32_t machine_file_bytes(MachineFile file) {
  FILE* const open = stream(file);
  if (open == nullptr) return -1;
  const long position = ftell(open);
  if (position < 0 || fseek(open, 0, SEEK_END) != 0) return -1;
  const long bytes = ftell(open);
  if (fseek(open, position, SEEK_SET) != 0 || bytes > INT32_MAX) return -1;
  return static_cast<int32_t>(bytes);
}

bool machine_close(MachineFile file) {
  FILE* const open = stream(file);
  if (open == nullptr) return false;
  files[file.handle] = nullptr;
  return fclose(open) == 0;
}

void machine_print(const char* text) { fputs(text, stdout); }

void machine_exit(int code) { exit(code); }

uint32_t machine_stack_used() { return 0; }

MachineMemory machine_memory() { return {}; }
