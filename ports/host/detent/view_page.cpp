#include "view_page.h"

#include <algorithm>
#include <filesystem>

#include "file.h"
#include "stream.h"
#include "text.h"

namespace detent_tool {

namespace {

constexpr const char* k_mark = "<!--recording-->";  // where ports/web/view/page.html takes the recording

std::string base64(const uint8_t* bytes, size_t count) {
  constexpr const char* k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (size_t i = 0; i < count; i += 3) {
    const size_t left = std::min<size_t>(count - i, 3);
    const uint32_t group = static_cast<uint32_t>(bytes[i]) << 16 |
                           (left > 1 ? static_cast<uint32_t>(bytes[i + 1]) << 8 : 0u) |
                           (left > 2 ? static_cast<uint32_t>(bytes[i + 2]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= left ? k_letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Escapes text for an attribute of the page, because the name of a file may contain any character.
std::string attribute(const std::string& text) {
  std::string safe;
  for (const char letter : printable(text)) {
    const auto unsafe = std::string("&<>\"'").find(letter) != std::string::npos;
    safe += unsafe ? "&#" + std::to_string(static_cast<int>(letter)) + ";" : std::string(1, letter);
  }
  return safe;
}

/// The path of the template that ports/web/build makes: the page of a configuration, without a recording. It is
/// installed with the tool, or it is in the build folder beside that of the tool. Empty if there is no template.
std::string find_template(const std::string& config) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const std::string name = config + ".html";
  for (const char* folder : {"../share/detent/view", "../../../../web/view"}) {
    const std::filesystem::path candidate = self / folder / name;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate.string();
  }
  return "";
}

}  // namespace

std::string ViewPage::open(const std::string& path, const std::string& config) {
  const std::string from = find_template(config);
  if (from.empty()) {
    if (find_template("fx64").empty())
      return "detent: this tool has no viewer: build it with ports/web/build, in a checkout of the same version";
    return path + ": this tool has no viewer of configuration " + config;
  }
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(from, bytes); !problem.empty()) return from + ": " + problem;
  page_.assign(bytes.begin(), bytes.end());
  mark_ = page_.find(k_mark);
  return mark_ == std::string::npos ? from + ": is not a page of the viewer" : "";
}

void ViewPage::add(const std::string& kind, const Attributes& attributes, const uint8_t* bytes, size_t count) {
  elements_ += "<script class=\"" + kind + "\" type=\"text/plain\"";
  for (const auto& [name, value] : attributes) elements_ += " data-" + name + "=\"" + attribute(value) + "\"";
  elements_ += ">" + base64(bytes, count) + "</script>\n";
}

std::string ViewPage::write(const std::string& output) const {
  std::string page = page_;
  page.replace(mark_, std::string(k_mark).size(), elements_);
  const std::string problem = write_file(output, {page.begin(), page.end()});
  return problem.empty() ? "" : output + ": " + problem;
}

}  // namespace detent_tool
