#include <ports/bare/semihosting.h>
#include <ports/machine.h>
#include <string.h>

namespace {
uint32_t word(const volatile void* pointer) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(pointer)); }
uint32_t word(MachineFile file) { return static_cast<uint32_t>(file.handle); }

// Reads and writes return the number of bytes that they did not transfer.
uint32_t transfer(Semihosting operation, MachineFile file, const void* bytes, uint32_t byte_count) {
  const uint32_t block[] = {word(file), word(bytes), byte_count};
  const uint32_t left = static_cast<uint32_t>(semihosting(operation, block));
  return left > byte_count ? 0 : byte_count - left;
}
}  // namespace

MachineFile machine_open(const char* path, MachineMode mode) {
  constexpr uint32_t k_read_binary = 1;
  constexpr uint32_t k_write_binary = 5;
  const uint32_t block[] = {word(path), mode == MachineMode::read ? k_read_binary : k_write_binary,
                            static_cast<uint32_t>(strlen(path))};
  return {semihosting(Semihosting::open, block)};
}

uint32_t machine_read(MachineFile file, void* bytes, uint32_t byte_count) {
  return transfer(Semihosting::read, file, bytes, byte_count);
}

uint32_t machine_write(MachineFile file, const void* bytes, uint32_t byte_count) {
  return transfer(Semihosting::write, file, bytes, byte_count);
}

bool machine_seek(MachineFile file, uint32_t offset) {
  const uint32_t block[] = {word(file), offset};
  return semihosting(Semihosting::seek, block) == 0;
}

int32_t machine_file_bytes(MachineFile file) {
  const uint32_t block[] = {word(file)};
  return semihosting(Semihosting::file_bytes, block);
}

bool machine_close(MachineFile file) {
  const uint32_t block[] = {word(file)};
  return semihosting(Semihosting::close, block) == 0;
}

void machine_print(const char* text) { semihosting(Semihosting::write_text, text); }

void machine_exit(int code) {
  constexpr uint32_t k_application_exit = 0x20026;
  const uint32_t block[] = {k_application_exit, static_cast<uint32_t>(code)};
  for (;;) semihosting(Semihosting::exit, block);
}
