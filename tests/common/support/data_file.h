#pragma once
#include <stdio.h>
#include <stdlib.h>

#include <string>

namespace detent_test {

/// The path of a file in the public data sets, under $DETENT_DATA or the folder given to the build; empty if not found.
inline std::string data_file(const std::string& path) {
#if defined(DETENT_DATA)
  const char* folder = DETENT_DATA;
#else
  const char* folder = "";
#endif
  if (const char* named = getenv("DETENT_DATA")) folder = named;
  std::string text;
  if (FILE* file = fopen((std::string(folder) + "/" + path).c_str(), "rb")) {
    char piece[4096];
    for (size_t count = 1; (count = fread(piece, 1, sizeof piece, file)) > 0;) text.append(piece, count);
    fclose(file);
  }
  return text;
}

}  // namespace detent_test
