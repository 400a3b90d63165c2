#pragma once
#include <stdarg.h>
#include <stdio.h>

#include <algorithm>
#include <string>
#include <vector>

/// Tables of measured values, for a terminal or as Markdown.
namespace detent_text {

/// The cells of a row.
using Cells = std::vector<std::string>;

/// Formats as printf() does; at most 255 characters.
[[gnu::format(printf, 1, 2)]] inline std::string text(const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  return line;
}

/// The quantile of the values at `share`, 0 to 1; 0 if there are no values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Writes a table whose first row is the header; empty rows are left out.
inline std::string table_of(const std::vector<Cells>& rows, bool markdown) {
  std::vector<size_t> width(rows[0].size());
  for (const Cells& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string result;
  for (const Cells& row : rows) {
    if (row.empty()) continue;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string fill(width[i] - row[i].size(), ' ');
      result += markdown ? "| " + row[i] + " " : (i == 0 ? row[i] + fill : "  " + fill + row[i]);
    }
    result += markdown ? "|\n" : "\n";
    if (!markdown || &row != &rows[0]) continue;
    for (size_t i = 0; i < row.size(); ++i) result += i == 0 ? "|---" : "|---:";
    result += "|\n";
  }
  return result + "\n";
}

}  // namespace detent_text
