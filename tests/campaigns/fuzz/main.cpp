#include <gtest/gtest.h>
#include <string.h>

#include <fstream>

#include "tests/campaigns/fuzz/target.h"

using detent_fuzz::k_target_count, detent_fuzz::k_targets;

extern "C" int LLVMFuzzerInitialize(int* argument_count, char*** arguments);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t count);

/// `--seeds FOLDER`: writes the targets' seeds there, each a file, and ends.
extern "C" int LLVMFuzzerInitialize(int* argument_count, char*** arguments) {
  if (*argument_count != 3 || strcmp((*arguments)[1], "--seeds") != 0) return 0;
  for (size_t target = 0; target < k_target_count; ++target) {
    const std::vector<detent_fuzz::Bytes> seeds = k_targets[target]->seeds();
    for (size_t i = 0; i < seeds.size(); ++i) {
      std::ofstream file(std::string((*arguments)[2]) + "/seed_" + std::to_string(target) + "_" + std::to_string(i),
                         std::ios::binary);
      file.put(static_cast<char>(target));
      file.write(reinterpret_cast<const char*>(seeds[i].data()), static_cast<std::streamsize>(seeds[i].size()));
      if (!file.good()) exit(1);
    }
  }
  exit(testing::Test::HasFailure() ? 1 : 0);
}

/// The first byte chooses among the targets.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t count) {
  if (count == 0) return -1;
  k_targets[data[0] % k_target_count]->take({data + 1, data + count});
  if (testing::Test::HasFailure()) __builtin_trap();
  return 0;
}
