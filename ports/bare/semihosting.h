#pragma once
#include <stdint.h>

/// Operations of the host behind the debugger. Source: Arm, "Semihosting for AArch32 and AArch64", 2.0. RISC-V uses the
/// same numbers and blocks.
enum class Semihosting : uint32_t {
  open = 0x01,
  close = 0x02,
  write_text = 0x04,
  write = 0x05,
  read = 0x06,
  seek = 0x0a,
  file_bytes = 0x0c,
  command_line = 0x15,
  exit = 0x20,
};

/// `argument` is the operation's block of words, or the text of write_text. The result depends on the operation. Each
/// core implements it with its own instruction (ports/cortex_m, ports/riscv).
int32_t semihosting(Semihosting operation, const void* argument);
