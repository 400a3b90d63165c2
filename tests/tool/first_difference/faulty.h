#pragma once
#include <stdint.h>

/// A machine that computes wrongly where it is told to.
struct FaultyRun {
  const char* scene = nullptr;
  const char* path = nullptr;
  uint32_t ticks = 0;
  uint32_t trace = 0;      ///< level, of all ticks
  uint32_t digests = 1;    ///< interval
  uint32_t keyframes = 0;  ///< interval
  const char* fault = "";  ///< see faulty.cpp
  uint32_t tick = 0;       ///< in which it happens
  uint32_t body = 0;       ///< slot, as in BodyId
  uint32_t bit = 0;
};
