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
    {"fx64", 1, 0x59d85da77e2026fe},
    {"fx64", 101, 0x494eaf0fdc7a5cba},
    {"fx64", 201, 0xd0983f0de103f979},
    {"fx64", 301, 0xab76ca2930052a22},
    {"fx32", 1, 0x9ffce9206a9bbbc7},
    {"fx32", 101, 0x906425d0d6665eaf},
    {"fx32", 201, 0xdd42a610d46dfaa1},
    {"fx32", 301, 0x5e65066324159884},
    {"f32", 1, 0x79d6b7fb27653335},
    {"f32", 101, 0x4327d155e3317778},
    {"f32", 201, 0xa985852d36e67038},
    {"f32", 301, 0xffb17c34f8c86f44},
    {"f64", 1, 0xdec561cc0ef3393b},
    {"f64", 101, 0x1e225dbf21dcdb6d},
    {"f64", 201, 0xe17522bbf7447656},
    {"f64", 301, 0x324653be81ce6566},
};
