#include "release.h"

#include <stdlib.h>
#include <string.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "stream.h"
#if !defined(_WIN32)
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace detent_tool {

namespace {

constexpr const char* k_called_by_a_release = "DETENT_CALLED_BY_A_RELEASE";
constexpr size_t k_line_bytes_max = 65536;

uint32_t word_at(const uint8_t* bytes) {
  return bytes[0] | static_cast<uint32_t>(bytes[1]) << 8 | static_cast<uint32_t>(bytes[2]) << 16 |
         static_cast<uint32_t>(bytes[3]) << 24;
}

bool is_program(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
#if defined(_WIN32)
  return true;
#else
  return access(path.c_str(), X_OK) == 0;
#endif
}

Outcome unanswered(const std::string& release, const std::string& why) {
  Outcome outcome;
  outcome.verdict = Verdict::bad;
  outcome.status = "no answer";
  outcome.problem = release + " " + why;
  outcome.release = release;
  return outcome;
}

/// `line` is the output of another program, so every field of it is checked.
Outcome outcome_of(const std::string& release, const std::string& line) {
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(line, nullptr, false);
  if (!json.is_object()) return unanswered(release, "gave no line of JSON");
  const auto text = [&json](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto count = [&json](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_number_unsigned() ? found->get<uint64_t>() : uint64_t{0};
  };
  Outcome outcome;
  outcome.release = release;
  const auto ok = json.find("ok");
  outcome.verdict = ok != json.end() && ok->is_boolean() && ok->get<bool>() ? Verdict::good : Verdict::bad;
  outcome.problem = text("problem");
  outcome.status = text("status");
  outcome.field = text("field");
  outcome.offset = count("offset");
  outcome.tick = count("tick");
  outcome.first_bad_tick = count("first_bad_tick");
  outcome.header.config = text("config");
  outcome.header.format_version = static_cast<uint32_t>(count("format_version"));
  outcome.header.simulation_version = static_cast<uint32_t>(count("simulation_version"));
  outcome.header_known = !outcome.header.config.empty();
  outcome.file_bytes = count("file_bytes");
  outcome.ticks = count("ticks");
  outcome.digests = count("digests");
  outcome.digest = strtoull(text("digest").c_str(), nullptr, 16);
  const auto seconds = json.find("seconds");
  if (seconds != json.end() && seconds->is_number()) outcome.seconds = seconds->get<double>();
  if (outcome.verdict != Verdict::good && outcome.problem.empty()) return unanswered(release, "named no problem");
  return outcome;
}

}  // namespace

std::optional<Versions> versions_of(const std::string& path) {
  std::string problem;
  const std::unique_ptr<Input> input = Input::open(path, problem);
  uint8_t bytes[16];
  uint32_t got = 0;
  if (input == nullptr || !input->read(bytes, sizeof bytes, got) || got != sizeof bytes) return {};
  if (engines().front().kind_of(bytes, got) != FileKind::recording) return {};
  return Versions{word_at(bytes + 8), word_at(bytes + 12)};
}

std::string find_release(uint32_t simulation_version) {
  const std::string name = "detent-" + std::to_string(simulation_version);
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error && is_program(self.parent_path() / name)) return (self.parent_path() / name).string();
  const char* const path = getenv("PATH");
  std::string folders = path != nullptr ? path : "";
  for (size_t start = 0; start < folders.size();) {
    const size_t end = std::min(folders.find(':', start), folders.size());
    const std::filesystem::path candidate = std::filesystem::path(folders.substr(start, end - start)) / name;
    // An empty entry of PATH means the current folder. The tool runs no program from the current folder.
    if (end != start && is_program(candidate)) return candidate.string();
    start = end + 1;
  }
  return "";
}

bool called_by_another_release() { return getenv(k_called_by_a_release) != nullptr; }

#if defined(_WIN32)
Outcome verify_by_release(const std::string& release, const std::vector<std::string>&, const ReadRequest&) {
  return unanswered(release, "is not called on this system");
}
#else
Outcome verify_by_release(const std::string& release, const std::vector<std::string>& asset_paths,
                          const ReadRequest& request) {
  std::vector<std::string> words = {release, "verify", "--json"};
  for (const std::string& path : asset_paths) {
    words.push_back("--asset");
    words.push_back(path);
  }
  if (request.from != 0) words.insert(words.end(), {"--from", std::to_string(request.from)});
  if (request.to != UINT64_MAX) words.insert(words.end(), {"--to", std::to_string(request.to)});
  words.insert(words.end(), {"--", request.path});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2];
  if (pipe(ends) != 0) return unanswered(release, "cannot be given a pipe");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    return unanswered(release, "cannot be started");
  }
  if (child == 0) {
    setenv(k_called_by_a_release, "1", 1);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(release.c_str(), arguments.data());
    _exit(127);
  }
  close(ends[1]);
  std::string line;
  char piece[4096];
  for (ssize_t got = 0; (got = ::read(ends[0], piece, sizeof piece)) > 0;) {
    if (line.size() < k_line_bytes_max) line.append(piece, static_cast<size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return unanswered(release, "broke off");
  Outcome outcome = outcome_of(release, line);
  if (outcome.verdict == Verdict::good && WEXITSTATUS(status) != 0) return unanswered(release, "contradicts itself");
  return outcome;
}
#endif

}  // namespace detent_tool
