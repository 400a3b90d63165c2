#pragma once
#include <stdint.h>

/// Of the 100 sequences from `first` on. Written by tests/sequences/regenerate.
struct SequencesDigest {
  const char* config;
  uint32_t first;
  uint64_t digest;
};
// clang-format off
inline constexpr SequencesDigest k_sequences_digests[] = {
    {"fx64", 1, 0xec36c225b8e639a9},
    {"fx64", 101, 0x6796eab42325eca8},
    {"fx64", 201, 0xbc04d92d9a54e952},
    {"fx64", 301, 0x602698a9daca6720},
    {"fx32", 1, 0x7aa8078a9f9adc34},
    {"fx32", 101, 0x1898608b16c98ad3},
    {"fx32", 201, 0xbed4c852799a594c},
    {"fx32", 301, 0xff51ecf34d632832},
    {"f32", 1, 0x26b439f96990c9bc},
    {"f32", 101, 0x2201734f7a102e31},
    {"f32", 201, 0xb85e592b33334770},
    {"f32", 301, 0xd3e579349a36203b},
    {"f64", 1, 0x48a15bdfa923b119},
    {"f64", 101, 0x0d98bd88a189d5e2},
    {"f64", 201, 0xbd76294f967774ef},
    {"f64", 301, 0x55f1b69b4c1bd737},
};
