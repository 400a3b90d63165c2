#pragma once
#include <stdint.h>

/// The functions that a program needs from its machine, the same on a PC, in a browser and on a microcontroller:
/// arguments, files, text, an exit code and its memory use. On a microcontroller the files and the text are those of
/// the host that debugs or emulates it (semihosting). Nothing here allocates, and nothing in the library includes this
/// header.
///
/// A program defines `machine_main` in place of `main`, includes this header, and is declared in CMake by
/// `detent_machine_executable(<name> <sources>...)`. Numbers are printed by ports/print.h.

/// The program. `argv[0]` is the program's name; the result is the exit code that the host sees, [0, 255].
int machine_main(int argc, char** argv);

enum class MachineMode : uint32_t {
  read,   ///< an existing file, from its start
  write,  ///< a new or emptied file
};

/// An open file of the host. Bytes are never translated: files are binary on every machine.
struct MachineFile {
  int32_t handle = -1;  ///< the port's own number; negative if not open
  constexpr bool is_open() const { return handle >= 0; }
};

/// At most this many files may be open at once.
inline constexpr int32_t k_machine_files_max = 8;

/// `path` is the host's. Errors: a file that is not open.
[[nodiscard]] MachineFile machine_open(const char* path, MachineMode mode);
/// Reads up to `byte_count` bytes at the file's position and moves it.
/// Returns the number of bytes read; fewer than requested at the end of the file or on an error.
uint32_t machine_read(MachineFile file, void* bytes, uint32_t byte_count);
/// Writes at the file's position and moves it. Returns the number of bytes written; fewer than given on an error.
uint32_t machine_write(MachineFile file, const void* bytes, uint32_t byte_count);
/// Moves the file's position to `offset` bytes from its start. Errors: false.
[[nodiscard]] bool machine_seek(MachineFile file, uint32_t offset);
/// The file's size in bytes, below 2^31. Errors: -1.
[[nodiscard]] int32_t machine_file_bytes(MachineFile file);
/// False if the file was not open or the written bytes did not reach it.
bool machine_close(MachineFile file);

/// Text to the host's standard output, nothing added: the caller ends its lines with '\n'.
void machine_print(const char* text);

/// Ends the program at once; `code` is the exit code that the host sees, [0, 255].
[[noreturn]] void machine_exit(int code);
/// Prints "panic: ", the reason and a line's end, then exits with k_machine_panic_code.
[[noreturn]] void machine_panic(const char* reason);
inline constexpr int k_machine_panic_code = 101;

/// The most bytes of stack used so far, measured by the fill pattern of the start-up code; 0 where the host owns the
/// stack.
uint32_t machine_stack_used();

/// The program's size, from the linker; all zero where a host's loader decides it.
struct MachineMemory {
  uint32_t flash_bytes = 0;  ///< code, constants and the initial values of data
  uint32_t ram_bytes = 0;    ///< data and zeroed data, without the stack
  uint32_t stack_bytes = 0;  ///< RAM left for the stack
};
MachineMemory machine_memory();
