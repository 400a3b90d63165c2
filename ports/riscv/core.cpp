#include <ports/bare/semihosting.h>
#include <ports/bare/start.h>

// The host recognises the request by these three instructions; they must be uncompressed and in one page. Source:
// RISC-V International, "RISC-V Semihosting", 1.0.
int32_t semihosting(Semihosting operation, const void* argument) {
  register uint32_t a0 asm("a0") = static_cast<uint32_t>(operation);
  register const void* a1 asm("a1") = argument;
  asm volatile(
      ".balign 16\n"
      ".option push\n"
      ".option norvc\n"
      "slli x0, x0, 0x1f\n"
      "ebreak\n"
      "srai x0, x0, 7\n"
      ".option pop\n"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return static_cast<int32_t>(a0);
}

// The board starts at the program's first byte, without a stack. A trap resets the stack, which may have caused it.
asm(R"(
  .section .vectors, "ax", @progbits
  .global machine_reset
machine_reset:
  la sp, link_stack_top
  la t0, machine_trap
  csrw mtvec, t0
  j machine_start
  .balign 4
machine_trap:
  la sp, link_stack_top
  csrr a0, mepc
  j machine_fault
)");
