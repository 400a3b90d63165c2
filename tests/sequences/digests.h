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
    {"fx64", 1, 0xb7da9cbb1e178d3b},
    {"fx64", 101, 0xccba5860445ee05a},
    {"fx64", 201, 0x36ed5b3a8d3aa453},
    {"fx64", 301, 0xc998bfc758bca574},
    {"fx32", 1, 0x0a67d8d042fbb597},
    {"fx32", 101, 0xd34823de60fed27c},
    {"fx32", 201, 0xb66ae28f6a8c5d0a},
    {"fx32", 301, 0x5889726da41da83f},
    {"f32", 1, 0xcc051c8687fd41b8},
    {"f32", 101, 0x80241bdf7de18bda},
    {"f32", 201, 0xeda7311e73e5379a},
    {"f32", 301, 0x436231a669b389d0},
    {"f64", 1, 0x6216739e4aa388c9},
    {"f64", 101, 0xd3c4fa29c5ceb7c2},
    {"f64", 201, 0x71b930db39c59a7b},
    {"f64", 301, 0xd66817225105cffd},
};
