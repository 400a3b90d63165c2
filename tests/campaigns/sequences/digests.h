#pragma once
#include <stdint.h>

/// Of the 100 sequences from `first` on. Written by tests/campaigns/sequences/regenerate.
struct SequencesDigest {
  const char* config;
  uint32_t first;
  uint64_t digest;
};
// clang-format off
inline constexpr SequencesDigest k_sequences_digests[] = {
    {"fx64", 1, 0x21ac71d0c7ce314b},
    {"fx64", 101, 0x3aebb0c7d0b1b05e},
    {"fx64", 201, 0xcb606fbb966bd0f2},
    {"fx64", 301, 0x740771e84b21f0a4},
    {"fx32", 1, 0x0802c8e9f30fc36d},
    {"fx32", 101, 0xec5b451e68ab6728},
    {"fx32", 201, 0x236c805a65534220},
    {"fx32", 301, 0x797592edddd749a9},
    {"f32", 1, 0x4a4c3acc4df2840c},
    {"f32", 101, 0x5be85b28918dd2dd},
    {"f32", 201, 0x4ea7ba3cbab706b1},
    {"f32", 301, 0x01e7a12a1cc8bcc3},
    {"f64", 1, 0x0e39026f852831fb},
    {"f64", 101, 0xf66d4b74c018ae01},
    {"f64", 201, 0x5b7b1ac555470350},
    {"f64", 301, 0xf8f831249e995345},
};
