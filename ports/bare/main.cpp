#include <errno.h>
#include <ports/machine.h>
#include <stddef.h>
#include <sys/stat.h>

// Runs a program that is written for a host: with main() in place of machine_main(), and with printf().

// By its symbol, for C++ lets nobody call main().
extern "C" int host_main() __asm__("main");

int machine_main(int, char**) { return host_main(); }

// What newlib's printf() asks of a system. Picolibc brings that itself (--oslib=semihost).
#if defined(__NEWLIB__) && !defined(__PICOLIBC__)
extern "C" {
int _write(int, const char* text, int byte_count) {
  static const MachineFile console = machine_open(":tt", MachineMode::write);
  return static_cast<int>(machine_write(console, text, static_cast<uint32_t>(byte_count)));
}

// What a double takes as text; the stream's own buffer finds no room, so that it has none.
void* _sbrk(ptrdiff_t byte_count) {
  alignas(8) static char heap[768];
  static ptrdiff_t used;
  if (byte_count > static_cast<ptrdiff_t>(sizeof heap) - used) {
    errno = ENOMEM;
    return reinterpret_cast<void*>(-1);
  }
  used += byte_count;
  return heap + used - byte_count;
}

int _fstat(int, struct stat* status) {
  status->st_mode = S_IFCHR;
  return 0;
}
int _isatty(int) { return 1; }
int _read(int, char*, int) { return 0; }
int _lseek(int, int, int) { return 0; }
int _close(int) { return 0; }
}
#endif
