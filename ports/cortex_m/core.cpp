#include <ports/bare/memory.h>
#include <ports/bare/semihosting.h>
#include <ports/bare/start.h>

int32_t semihosting(Semihosting operation, const void* argument) {
  register uint32_t r0 asm("r0") = static_cast<uint32_t>(operation);
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return static_cast<int32_t>(r0);
}

#if defined(__ARM_ARCH_6M__)
// The quotient (r0, r1) and the remainder (r2, r3) of two signed 64-bit integers, from those of their magnitudes.
// libgcc's own has a second division routine, which is 0.6 KB larger.
asm(".syntax unified\n"
    ".section .text.__aeabi_ldivmod, \"ax\", %progbits\n"
    ".balign 4\n"
    ".global __aeabi_ldivmod\n"
    ".type __aeabi_ldivmod, %function\n"
    ".thumb_func\n"
    "__aeabi_ldivmod:\n"
    "push {r4, r5, r6, lr}\n"
    "asrs r4, r1, #31\n"  // -1 if the dividend is negative, else 0
    "asrs r5, r3, #31\n"  // -1 if the divisor is negative, else 0
    "eors r0, r4\n"
    "eors r1, r4\n"
    "subs r0, r0, r4\n"
    "sbcs r1, r4\n"
    "eors r2, r5\n"
    "eors r3, r5\n"
    "subs r2, r2, r5\n"
    "sbcs r3, r5\n"
    "bl __aeabi_uldivmod\n"
    "eors r2, r4\n"  // the remainder has the sign of the dividend
    "eors r3, r4\n"
    "subs r2, r2, r4\n"
    "sbcs r3, r4\n"
    "eors r4, r5\n"  // the quotient is negative if the signs differ
    "eors r0, r4\n"
    "eors r1, r4\n"
    "subs r0, r0, r4\n"
    "sbcs r1, r4\n"
    "pop {r4, r5, r6, pc}\n"
    ".size __aeabi_ldivmod, . - __aeabi_ldivmod\n"
    ".text\n");
#endif

extern "C" {
// Kept small: until the floating-point unit is on, no function may save its registers.
[[noreturn]] void machine_reset() {
#if defined(__ARM_FP)
  volatile uint32_t& coprocessor_access = *reinterpret_cast<volatile uint32_t*>(0xE000ED88);
  coprocessor_access = coprocessor_access | (0xFu << 20);
  asm volatile("dsb\n isb" ::: "memory");
#endif
  machine_start();
}

// The hardware pushed 8 registers; the seventh is the address of the fault. The stack starts anew, because it may have
// caused the fault.
[[gnu::naked]] void machine_fault_handler() {
  asm volatile(
      "mrs r0, msp\n"
      "ldr r0, [r0, #24]\n"
      "ldr r1, =link_stack_top\n"
      "mov sp, r1\n"
      "ldr r1, =machine_fault\n"
      "bx r1\n"
      ".ltorg\n");
}
}

namespace {
using Handler = void (*)();

struct Vectors {
  uint8_t* stack_top;
  Handler handlers[15];
};

[[gnu::section(".vectors"), gnu::used]] const Vectors vectors = {
    link_stack_top,
    {machine_reset, machine_fault_handler, machine_fault_handler, machine_fault_handler, machine_fault_handler,
     machine_fault_handler, machine_fault_handler, machine_fault_handler, machine_fault_handler, machine_fault_handler,
     machine_fault_handler, machine_fault_handler, machine_fault_handler, machine_fault_handler,
     machine_fault_handler}};
}  // namespace
