#pragma once
#include "tests/common/support/mutant.h"

/// What reads bytes from outside, each as a function that any bytes may be given to.
namespace detent_fuzz {

using detent_test::Bytes;

/// The first byte says what is mended before the bytes are read: fuzzers do not find checksums.
struct Target {
  /// Fails the test that it runs in, or aborts, if the bytes do harm. True if they were let in.
  bool (*take)(const Bytes& bytes);
  /// Where mutation begins.
  std::vector<Bytes> (*seeds)();
};

/// Those of a program of libFuzzer's (list.cpp).
extern const Target* const k_targets[];
extern const size_t k_target_count;

}  // namespace detent_fuzz
