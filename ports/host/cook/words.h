#pragma once
#include <math.h>
#include <stdint.h>

#include <charconv>
#include <string>
#include <string_view>

/// Reads text by lines and words.
namespace detent_cook {

/// Takes the next line off the text.
inline std::string_view next_line(std::string_view& text) {
  const size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

inline constexpr std::string_view k_blanks = " \t\r\f\v";

/// Takes the next word off the line; empty if there is none.
inline std::string_view next_word(std::string_view& line) {
  const size_t from = line.find_first_not_of(k_blanks);
  if (from == std::string_view::npos) return {};
  const size_t to = line.find_first_of(k_blanks, from);
  const std::string_view word = line.substr(from, to == std::string_view::npos ? to : to - from);
  line.remove_prefix(to == std::string_view::npos ? line.size() : to);
  return word;
}

/// Reads the whole word as a finite number, independent of the locale.
inline bool number_from(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && isfinite(value);
}

/// Reads the number of a vertex in an OBJ: counted from 1, or backwards from -1. Ignores the text from a slash on.
inline bool index_from(std::string_view word, size_t vertex_count, uint32_t& index) {
  word = word.substr(0, word.find('/'));
  int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return false;
  const auto count = static_cast<int64_t>(vertex_count);
  if (number == 0 || number > count || number < -count) return false;
  index = static_cast<uint32_t>(number > 0 ? number - 1 : count + number);
  return true;
}

inline std::string at_line(size_t number, const std::string& problem) {
  return "line " + std::to_string(number) + ": " + problem;
}

/// Quotes a word of the file for a message, without unprintable characters.
inline std::string quoted(std::string_view word) {
  std::string text = "'";
  for (const char letter : word.substr(0, 40)) text += letter >= ' ' && letter <= '~' ? letter : '?';
  return text + "'";
}

}  // namespace detent_cook
