#pragma once
#include <stdint.h>

/// A core's reset code jumps here once it has a stack and a floating-point unit: prepares memory, runs constructors,
/// fetches the arguments, runs machine_main and exits with its result.
extern "C" [[noreturn]] void machine_start();

/// A core's fault handlers jump here: prints the instruction's address, then panics.
extern "C" [[noreturn]] void machine_fault(uint32_t address);
