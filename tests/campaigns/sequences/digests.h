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
    {"fx64", 1, 0xc41aee6097784548},
    {"fx64", 101, 0xea4ceeaf4b09c85c},
    {"fx64", 201, 0x52bb9d733fa6cfde},
    {"fx64", 301, 0x7d4a5187188787da},
    {"fx32", 1, 0x181f5376532e595b},
    {"fx32", 101, 0xc8d00f9226cbd9be},
    {"fx32", 201, 0x5ec7847fee2b9826},
    {"fx32", 301, 0x9c0af849cae0539d},
    {"f32", 1, 0xcee559088e74cf8e},
    {"f32", 101, 0xf9c4d82a2fb0a4eb},
    {"f32", 201, 0xc41119332f138652},
    {"f32", 301, 0x7e7e8e2c8dbcea08},
    {"f64", 1, 0xfab2519fd2bbbeb6},
    {"f64", 101, 0xb82f9fb6bd39ed24},
    {"f64", 201, 0xae8dba7f058ed4de},
    {"f64", 301, 0x415aeec61791446d},
};
