#include "tests/campaigns/zoo/list.h"

#include <charconv>
#include <fstream>
#include <sstream>

namespace detent_zoo {

namespace {

constexpr const char* k_head = "scene,source,wants,why,gaps";
constexpr size_t k_columns = 5;

/// Bounds for checks that a scene does not list (docs/zoo.md).
const std::map<std::string, double> k_defaults = {{"gain", 0.05}, {"gap", 0.02},    {"angle", 0.02}, {"limit", 0.05},
                                                  {"sunk", 0.02}, {"pierced", 0.5}, {"lost", 0},     {"speed", 3}};
const std::map<std::string, double> k_free_defaults = {{"momentum", 1e-3}, {"angular_momentum", 0.02}};

constexpr double k_some_time = 1e9;  // later than the end of any scene

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"') {
      quoted = !quoted;
    } else if (letter == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  return cells;
}

std::string cell(const std::string& text) { return text.find(',') == std::string::npos ? text : "\"" + text + "\""; }

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_check(const std::string& name) {
  for (const char* check : k_checks) {
    if (name == check) return true;
  }
  return false;
}

/// Adds a word of the column "wants". Returns the problem; empty if none.
std::string take_wanted(const std::string& word, Entry& entry) {
  if (word == "rests") {
    entry.rests = true;
    entry.bounds.emplace("rest", 1);
    return "";
  }
  if (word == "stands") {
    entry.bounds.emplace("moved", 0.05);
    return "";
  }
  if (word == "sleeps") {
    entry.bounds.emplace("asleep", k_some_time);
    return "";
  }
  if (word == "free") {
    for (const auto& bound : k_free_defaults) entry.bounds.insert(bound);
    return "";
  }
  const size_t equal = word.find('=');
  const std::string name = word.substr(0, equal);
  double value = 0;
  if (equal == std::string::npos || !is_check(name))
    return "\"" + word + "\" is no bound: rests, sleeps, stands, free, gap=0.05";
  const auto [end, error] = std::from_chars(word.data() + equal + 1, word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return "\"" + word + "\" has no number";
  entry.bounds[name] = value;
  return "";
}

/// Adds a word such as "fx64:gain+gap" of the column of gaps. Returns the problem; empty if none.
std::string take_gap(const std::string& word, Entry& entry) {
  const size_t colon = word.find(':');
  if (colon == std::string::npos) return "\"" + word + "\" is no gap: fx64:gain+gap";
  std::istringstream stream(word.substr(colon + 1));
  for (std::string check; std::getline(stream, check, '+');) {
    if (!is_check(check)) return "\"" + check + "\" is no check";
    entry.gaps[word.substr(0, colon)].insert(check);
  }
  return "";
}

}  // namespace

Entry make_entry(const std::string& scene, const std::string& source, const std::string& wants, std::string& problem) {
  Entry entry;
  entry.scene = scene;
  entry.source = source;
  entry.wants = wants;
  entry.bounds = k_defaults;
  for (const std::string& word : words_of(wants)) {
    if (const std::string wrong = take_wanted(word, entry); !wrong.empty()) problem = wrong;
  }
  return entry;
}

std::vector<Entry> read_list(const std::string& path, std::string& problem) {
  std::ifstream file(path);
  std::vector<Entry> entries;
  std::string line;
  if (!std::getline(file, line) || line != k_head) problem = path + ":1: is not \"" + k_head + "\"";
  for (uint32_t number = 2; problem.empty() && std::getline(file, line); ++number) {
    const auto fail = [&](const std::string& text) { problem = path + ":" + std::to_string(number) + ": " + text; };
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != k_columns) {
      fail("has not " + std::to_string(k_columns) + " columns");
      break;
    }
    std::string wrong_want;
    Entry entry = make_entry(cells[0], cells[1], cells[2], wrong_want);
    if (!wrong_want.empty()) fail(wrong_want);
    entry.why = cells[3];
    for (const std::string& word : words_of(cells[4])) {
      if (const std::string wrong = take_gap(word, entry); !wrong.empty()) fail(wrong);
    }
    entries.push_back(entry);
  }
  if (!problem.empty()) entries.clear();
  return entries;
}

std::string gaps_text(const std::map<std::string, std::set<std::string>>& gaps) {
  std::string text;
  for (const auto& [config, checks] : gaps) {
    if (checks.empty()) continue;
    text += (text.empty() ? "" : " ") + config + ":";
    for (const std::string& check : checks) text += (check == *checks.begin() ? "" : "+") + check;
  }
  return text;
}

bool write_list(const std::string& path, const std::vector<Entry>& entries) {
  std::string text = std::string(k_head) + "\n";
  for (const Entry& entry : entries) {
    text += entry.scene + "," + cell(entry.source) + "," + cell(entry.wants) + "," + cell(entry.why) + "," +
            gaps_text(entry.gaps) + "\n";
  }
  std::ofstream file(path);
  return static_cast<bool>(file << text);
}

}  // namespace detent_zoo
