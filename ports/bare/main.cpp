#include <errno.h>
#include <ports/machine.h>
#include <stddef.h>
#include <sys/stat.h>

// Runs a program written for a host, which has main() in place of machine_main() and uses printf().

// Refers to main() by its symbol, because C++ does not allow a call of main().
extern "C" int host_main() __asm__("main");

int machine_main(int, char**) { return host_main(); }

// The system calls that newlib's printf() needs. Picolibc brings its own (--oslib=semihost).
#if defined(__NEWLIB__) && !defined(__PICOLIBC__)
extern "C" {
int _write(int, const char* text, int byte_count) {
  static const MachineFile console = machine_open(":tt", MachineMode::write);
  return static_cast<int>(machine_write(console, text, static_cast<uint32_t>(byte_count)));
}

// Enough memory to print a double. The stream's own buffer does not fit, so the stream is unbuffered.
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
