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
    {"fx64", 1, 0xef67cc02258f5c19},
    {"fx64", 101, 0xb10e382624ebb015},
    {"fx64", 201, 0xba65b13cc04bad5e},
    {"fx64", 301, 0xdb75d2c1bb13bae9},
    {"fx32", 1, 0xfa0808fb541bd173},
    {"fx32", 101, 0x76f583c3ded76ffd},
    {"fx32", 201, 0xc2695113dea06db8},
    {"fx32", 301, 0x1287a7a056444009},
    {"f32", 1, 0x45b242d0f4900c20},
    {"f32", 101, 0x952058605d453233},
    {"f32", 201, 0xa41ab2646bb485ed},
    {"f32", 301, 0xc00ead8d6565544b},
    {"f64", 1, 0xd8fae91de09db788},
    {"f64", 101, 0xeea2ef3a3a30c28d},
    {"f64", 201, 0x972fbd28a2a5c251},
    {"f64", 301, 0xc3cd780f4c4e870f},
};
