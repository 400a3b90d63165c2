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
    {"fx64", 1, 0xb4702b718d8e263e},
    {"fx64", 101, 0xbcd5968812b1b909},
    {"fx64", 201, 0x106235cbd488b6b5},
    {"fx64", 301, 0xfe603381c71c0a32},
    {"fx32", 1, 0x4437e4f3584843c3},
    {"fx32", 101, 0x492114bc43c62044},
    {"fx32", 201, 0x13bd9e5a34010810},
    {"fx32", 301, 0x94321b037486b5cb},
    {"f32", 1, 0x868c27405be56a39},
    {"f32", 101, 0xb143790e742c99c0},
    {"f32", 201, 0xdb5af02f8a357585},
    {"f32", 301, 0xa0a311d47c06f71f},
    {"f64", 1, 0x002ce3c34c69fe6d},
    {"f64", 101, 0xf4c75aa7fda7104c},
    {"f64", 201, 0x36f9390c7b0a8acf},
    {"f64", 301, 0xdc3b8874486aa320},
};
