#include "scene_words.h"

#include <stddef.h>

#include <algorithm>
#include <numeric>

namespace detent_tool {

namespace {

constexpr size_t k_word_max = 32;
constexpr size_t k_named_max = 24;
constexpr size_t k_compared_max = 10000;  // most names that are compared: a hostile file with more would take minutes

/// The edit distance: letters to change, add or remove. Source: Levenshtein 1966.
size_t edits(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string* nearest = nullptr;
  size_t fewest = std::max<size_t>(word.size() / 3, 2) + 1;
  if (word.size() <= k_word_max && names.size() <= k_compared_max) {
    for (const std::string& name : names) {
      const size_t count = name.size() <= k_word_max ? edits(word, name) : fewest;
      if (count >= fewest) continue;
      fewest = count;
      nearest = &name;
    }
  }
  if (nearest != nullptr) return ", did you mean \"" + *nearest + "\"?";
  if (names.empty() || names.size() > k_named_max) return "";
  std::string text = "; there are:";
  for (const std::string& name : names) text += (&name == &names.front() ? " " : ", ") + name;
  return text;
}

}  // namespace detent_tool
