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
    {"fx64", 1, 0x3e4b11d7a2e74419},
    {"fx64", 101, 0x30475670ef37b133},
    {"fx64", 201, 0xe87cd145035cff78},
    {"fx64", 301, 0xfd7c24ade3782739},
    {"fx32", 1, 0x68e27e0e1965768b},
    {"fx32", 101, 0x5dc2f9bc6a131c62},
    {"fx32", 201, 0x6dc2dea5bb17ecd6},
    {"fx32", 301, 0x275a2b02bb14af54},
    {"f32", 1, 0x4aee6ed7cfb7197e},
    {"f32", 101, 0x94f33ada559a2db4},
    {"f32", 201, 0xc19a176fa56dd64f},
    {"f32", 301, 0x3840136183427aa8},
    {"f64", 1, 0x3dc8563338df47fd},
    {"f64", 101, 0x75797558d78c755d},
    {"f64", 201, 0xb7e28d84e9b8dbad},
    {"f64", 301, 0x271e511c79d9fb21},
};
