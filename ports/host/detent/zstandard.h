#pragma once
#include "file.h"
#include "stream.h"

/// Zstandard (RFC 8878), if the build found it.
namespace detent_tool {

inline constexpr uint8_t k_zstandard_magic[4] = {0x28, 0xb5, 0x2f, 0xfd};

/// Makes an input that decompresses `file`, which must be at its start. Returns null on failure, with the reason in
/// `problem`.
std::unique_ptr<Input> unpack(File file, std::string& problem);
std::unique_ptr<Output> pack(File file, std::string& problem);

}  // namespace detent_tool
