#pragma once
#include <stdint.h>

/// Numbers as text through machine_print, for programs without stdio.

/// In decimal, without leading zeros.
void print_decimal(uint64_t value);
/// In lower-case hexadecimal, without "0x": exactly the lowest `digits` digits, in [1, 16].
void print_hex(uint64_t value, uint32_t digits);
