#pragma once
#include <stdint.h>
#include <stdio.h>

#include <string>

namespace detent_tool {

/// A digest as the tool prints it: 16 digits.
inline std::string hexadecimal(uint64_t value) {
  char text[17];
  snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace detent_tool
