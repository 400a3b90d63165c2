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
    {"fx64", 1, 0x78d28d53f2fab2d2},
    {"fx64", 101, 0x43f8c2598885ebfb},
    {"fx64", 201, 0x17666bc5bf16a586},
    {"fx64", 301, 0x46b658adf425fb19},
    {"fx32", 1, 0x05f26b0d0de137dd},
    {"fx32", 101, 0x05eb6d526599373a},
    {"fx32", 201, 0xdee4051c39683274},
    {"fx32", 301, 0x88cfffd19da60483},
    {"f32", 1, 0x722cd1ad1b6cd8c0},
    {"f32", 101, 0x3ee4ee95bb763b40},
    {"f32", 201, 0x0d664515f4b2bc94},
    {"f32", 301, 0x8d3a835b0983f7db},
    {"f64", 1, 0xe57cb2c5b85148d3},
    {"f64", 101, 0x317723058e6cafed},
    {"f64", 201, 0x0101cb6188ca70eb},
    {"f64", 301, 0x6072214eb88eda06},
};
