#pragma once
#include <stdint.h>

/// Where a core's reset goes once it has a stack and a floating-point unit: prepares memory, runs constructors, fetches
/// the arguments, runs machine_main and exits with its result.
extern "C" [[noreturn]] void machine_start();

/// Where a core's faults go: names the instruction's address, then panics.
extern "C" [[noreturn]] void machine_fault(uint32_t address);
