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

inline bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Replaces control characters. Text from a file may contain any characters, and a terminal must not execute them.
inline std::string printable(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < ' ' || letter == 0x7f) letter = '?';
  }
  return text;
}

}  // namespace detent_tool
