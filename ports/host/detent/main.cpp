#include <stdio.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "command.h"
#include "file.h"
#include "progress.h"
#include "release.h"
#include "report.h"
#include "run.h"
#include "scene_words.h"
#include "shrink.h"
#include "stream.h"
#include "text.h"
#include "verification.h"
#include "view.h"

namespace {

using namespace detent_tool;

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

std::string version_text() {
  std::string text = std::string("detent ") + DETENT_VERSION + " (";
  for (const Engine& engine : engines()) text += std::string(engine.config) + ", ";
  return text + "simulation version " + std::to_string(engines().front().simulation_version) + ", recording format " +
         std::to_string(engines().front().format_version) + ")";
}

const Engine* find_engine(const std::string& config) {
  for (const Engine& engine : engines()) {
    if (config == engine.config) return &engine;
  }
  return nullptr;
}

int run_record(const RecordRequest& request, const std::string& config, const Report& report) {
  ProgressBar bar(request.scene);
  const Outcome outcome =
      find_engine(config)->record(request, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
  report.recorded(request, outcome);
  return outcome.verdict == Verdict::good ? k_exit_good : k_exit_bad;
}

/// Reads the assets. Returns false, and prints a line to standard error, if a file cannot be read.
bool read_assets(const std::vector<std::string>& paths, Assets& assets) {
  for (const std::string& path : paths) {
    assets.push_back({});
    const std::string problem = read_asset(path, assets.back());
    if (problem.empty()) continue;
    fprintf(stderr, "%s\n", printable(path + ": " + problem).c_str());
    return false;
  }
  return true;
}

/// Whether the output is one of the input files, perhaps by another path. If so, prints a line to standard error.
bool overwrites(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (!is_same_file(input, output)) continue;
    fprintf(stderr, "%s\n", printable(output + ": is an input file, and is not overwritten").c_str());
    return true;
  }
  return false;
}

int run_verify(VerificationRequest& request, const Report& report) {
  if (!read_assets(request.asset_paths, request.reading.assets)) return k_exit_bad;
  const Verification result = verify_all(request, report);
  return result == Verification::good ? k_exit_good : result == Verification::bad ? k_exit_bad : k_exit_usage;
}

int run_state(ReadRequest request, const std::vector<std::string>& asset_paths, const Report& report) {
  if (!read_assets(asset_paths, request.assets)) return k_exit_bad;
  std::vector<BodyLine> bodies;
  const Outcome outcome = by_its_engine([&](const Engine& engine) { return engine.state(request, bodies); });
  report.state(request.path, outcome, bodies);
  return outcome.verdict == Verdict::good ? k_exit_good : k_exit_bad;
}

int run_recover(ReadRequest request, const std::string& output, const std::vector<std::string>& asset_paths,
                const Report& report) {
  if (overwrites(output, {request.path}) || overwrites(output, asset_paths)) return k_exit_usage;
  if (!read_assets(asset_paths, request.assets)) return k_exit_bad;
  Outcome outcome;
  {
    ProgressBar bar(request.path);
    outcome = by_its_engine([&](const Engine& engine) {
      return engine.recover(request, output, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
    });
  }
  report.recovered(request.path, output, outcome);
  return outcome.verdict == Verdict::good ? k_exit_good : k_exit_bad;
}

int run_trace(TraceRequest request, uint32_t level, const std::vector<std::string>& asset_paths, const Report& report) {
  if (overwrites(request.output, {request.reading.path}) || overwrites(request.output, asset_paths))
    return k_exit_usage;
  if (!read_assets(asset_paths, request.reading.assets)) return k_exit_bad;
  request.full = level == 2;
  Outcome outcome;
  {
    ProgressBar bar(request.reading.path);
    outcome = by_its_engine([&](const Engine& engine) {
      return engine.trace(request, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
    });
  }
  report.traced(request, outcome);
  return outcome.verdict == Verdict::good ? k_exit_good : k_exit_bad;
}

/// Runs `detent diff`. Returns the exit code. 0: equal, 1: different, 2: the files cannot be compared, or not to the
/// end.
int run_diff(DiffRequest request, const std::vector<std::string>& asset_paths, const Report& report) {
  if (!read_assets(asset_paths, request.assets)) return k_exit_usage;
  Difference difference;
  for (const Engine& engine : engines()) {
    difference = engine.diff(request);
    if (!difference.other_config) break;
  }
  if (!report.compared(request.a, request.b, difference)) return k_exit_usage;
  return difference.different ? k_exit_bad : difference.damaged ? k_exit_usage : k_exit_good;
}

int run_view(ViewRequest& request) {
  if (request.output.empty()) {
    request.output = request.paths.front();
    if (ends_with(request.output, k_compressed_suffix)) request.output.resize(request.output.size() - 4);
    request.output += ".html";
  }
  if (overwrites(request.output, request.paths) || overwrites(request.output, request.asset_paths)) return k_exit_usage;
  return write_view(request) ? k_exit_good : k_exit_bad;
}

int run_shrink(ShrinkCommand& command, const Report& report) {
  ShrinkRequest& request = command.request;
  if (const std::string misused = take_shrink_options(command); !misused.empty()) {
    fprintf(stderr, "shrink: %s\n", misused.c_str());
    return k_exit_usage;
  }
  for (const std::string& output : {request.output, command.page}) {
    if (overwrites(output, {request.reading.path}) || overwrites(output, command.asset_paths)) return k_exit_usage;
  }
  if (command.page == request.output) {
    fprintf(stderr, "%s: --page and --output are the same file\n", printable(command.page).c_str());
    return k_exit_usage;
  }
  if (!read_assets(command.asset_paths, request.reading.assets)) return k_exit_bad;
  command.json = report.json;
  return shrink_file(command) ? k_exit_good : k_exit_bad;
}

int run_compress(const std::vector<std::string>& paths, const Report& report) {
  int code = k_exit_good;
  for (const std::string& path : paths) {
    const std::string output = path + k_compressed_suffix;
    if (overwrites(output, {path})) {
      code = k_exit_usage;
      continue;
    }
    std::string problem;
    if (Input::open(path, problem) != nullptr)
      problem = versions_of(path) ? compress(path, output) : is_not(kind_of_file(path), "a recording");
    if (problem.empty())
      report.compressed(path, output, file_bytes(path), file_bytes(output));
    else
      code = report.problem(path, problem) ? k_exit_good : k_exit_bad;
  }
  return code;
}

int run_info(const std::vector<std::string>& paths, const Report& report) {
  int code = k_exit_good;
  for (const std::string& path : paths) {
    const FileKind kind = kind_of_file(path);
    if (kind >= FileKind::hull) {
      const auto describe = kind == FileKind::hull       ? describe_hull_file
                            : kind == FileKind::compound ? describe_compound_file
                                                         : describe_terrain_file;
      if (!describe(path, report.json)) code = k_exit_bad;
      continue;
    }
    Outcome outcome;
    {
      ProgressBar bar(path);
      const ReadRequest request = {path};
      outcome = by_its_engine([&](const Engine& engine) {
        return engine.info(request, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
      });
    }
    report.described(path, outcome);
    if (outcome.verdict == Verdict::bad) code = k_exit_bad;
  }
  return code;
}

int run_scene(RunCommand& command, const std::vector<std::string>& prints) {
  if (overwrites(command.request.recording, {command.path})) return k_exit_usage;
  for (const std::string& print : prints) {
    RunPrints& wanted = command.request.prints;
    (print == "bodies"    ? wanted.bodies
     : print == "events"  ? wanted.events
     : print == "queries" ? wanted.queries
                          : wanted.ticks) = true;
  }
  return run_scene_file(command) ? k_exit_good : k_exit_bad;
}

int run_cook_mesh(const MeshRequest& request, const Report& report) {
  ProgressBar bar(request.input);
  const bool good =
      cook_mesh_file(request, report.json, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
  return good ? k_exit_good : k_exit_bad;
}

/// The problem with the first word, which must be a sub-command; empty if none.
std::string command_problem(const CLI::App& app, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (!word.empty() && word[0] == '-')
    return app.get_option_no_throw(word) != nullptr ? "" : "there is no option '" + word + "' before a sub-command";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return "";
  const std::string all = suggestion("", names), hint = suggestion(word, names);
  if (word.empty()) return "no sub-command is named" + all;
  const std::string text = "there is no sub-command '" + word + "'" + hint;
  return hint == all ? text : text + " (" + all.substr(2) + ")";
}

int run_scenes(const Report& report) {
  for (const SceneLine& line : engines().front().scenes()) report.scene(line);
  return k_exit_good;
}

/// Returns the exit code.
int run_command(int argc, char** argv) {
  CLI::App app(
      "Records, verifies and describes recordings of the Detent physics library, plays scenes, and cooks hulls and "
      "meshes for it.\n"
      "Exit code: 0 if all is well and every tick of every file agrees, 1 if not, 2 for wrong usage.",
      "detent");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  Report report;

  std::vector<std::string> configs;
  for (const Engine& engine : engines()) configs.push_back(engine.config);
  std::vector<std::string> scene_names;
  for (const SceneLine& line : engines().front().scenes()) scene_names.push_back(line.name);

  RecordRequest request;
  std::string config = configs.front();
  CLI::App* record = app.add_subcommand("record", "Run a scene and write its recording");
  record->add_option("scene", request.scene, "The scene's name (see: detent scenes)")
      ->required()
      ->check(CLI::IsMember(scene_names));
  record->add_option("-o,--output", request.path,
                     "The file to write, -: standard output; SCENE.rec if it is not given");
  record->add_option("--config", config, "The math configuration")
      ->check(CLI::IsMember(configs))
      ->capture_default_str();
  record->add_option("--ticks", request.ticks, "How many to run; the scene's own length if it is not given")
      ->check(CLI::Range(1u, 1000000000u));
  record
      ->add_option("--digest-interval", request.digest_interval,
                   "Record a digest every so many ticks; 0: only at the end")
      ->capture_default_str();
  record
      ->add_option("--keyframe-interval", request.keyframe_interval,
                   "Record the whole state every so many ticks, to go to; 0: only at the start")
      ->capture_default_str();
  record->add_flag("--compress", request.compressed, "Write Zstandard, as SCENE.rec.zst if no output is given");

  std::vector<std::string> paths;
  const auto add_assets = [](CLI::App* command, std::vector<std::string>& asset_paths) {
    command
        ->add_option(
            "--asset", asset_paths,
            "A cooked file of the recorded world's asset table, from its first on; the scenes' own if none is given")
        ->allow_extra_args(false);
  };
  VerificationRequest verifying;
  CLI::App* verify = app.add_subcommand(
      "verify", "Replay recordings and compare every digest; those of other simulation versions by detent-VERSION");
  verify->add_option("file", verifying.paths, "Recordings, and folders of *.rec and *.rec.zst");
  verify->add_option("--list", verifying.list, "A file with the path of a recording a line; -: standard input");
  verify->add_option("--resume", verifying.log, "Pass over the files that this log of an earlier --json run has");
  verify->add_option("--jobs", verifying.jobs, "How many files to verify at the same time")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  verify->add_option("--from", verifying.reading.from, "Verify only the ticks after this one")
      ->check(CLI::NonNegativeNumber);
  verify->add_option("--to", verifying.reading.to, "Only up to this tick")->check(CLI::NonNegativeNumber);
  add_assets(verify, verifying.asset_paths);

  ReadRequest reading;
  std::vector<std::string> asset_paths;
  CLI::App* state = app.add_subcommand("state", "Print the bodies of a recording after a tick");
  state->add_option("file", reading.path, "A recording")->required();
  state->add_option("--tick", reading.to, "How many ticks the world has completed")
      ->required()
      ->check(CLI::NonNegativeNumber);
  add_assets(state, asset_paths);
  std::string output;
  CLI::App* recover = app.add_subcommand("recover", "Write the complete part of a truncated recording as a recording");
  recover->add_option("file", reading.path, "The truncated recording")->required();
  recover->add_option("output", output, "The file to write; compressed if its name ends in .zst")->required();
  add_assets(recover, asset_paths);
  CLI::App* compress = app.add_subcommand("compress", "Write FILE.zst beside each recording");
  compress->add_option("file", paths, "Recordings")->required();

  DiffRequest diffing;
  CLI::App* diff = app.add_subcommand(
      "diff",
      "Find where two recordings part: tick, stage of the step, body and field. Exit code: 0 equal, 1 different, "
      "2 not to be compared");
  diff->add_option("a", diffing.a, "A recording")->required();
  diff->add_option("b", diffing.b, "Another of the same match")->required();
  add_assets(diff, asset_paths);
  TraceRequest tracing;
  uint32_t trace_level = 2;
  CLI::App* trace =
      app.add_subcommand("trace", "Replay a recording and write this machine's traces of some of its ticks, for diff");
  trace->add_option("file", tracing.reading.path, "A recording")->required();
  trace->add_option("-o,--output", tracing.output, "The recording to write; compressed if its name ends in .zst")
      ->required();
  trace
      ->add_option("--level", trace_level, "1: digests of each body, contact and joint after each stage; 2: all fields")
      ->check(CLI::Range(1u, 2u))
      ->capture_default_str();
  trace->add_option("--from", tracing.reading.from, "The first tick")->required()->check(CLI::NonNegativeNumber);
  trace->add_option("--to", tracing.reading.to, "The last tick")->required()->check(CLI::NonNegativeNumber);
  add_assets(trace, asset_paths);

  ViewRequest viewing;
  CLI::App* view = app.add_subcommand(
      "view",
      "Write a page that replays, verifies and draws a recording in a browser, without a network; with two, it plays "
      "them to the first difference; a scene goes on live, and bodies can be thrown");
  view->add_option("file", viewing.paths, "A recording, two of the same match, or scenes (*.json)")->required();
  viewing.config = configs.front();
  view->add_option("--config", viewing.config, "The math configuration of scenes")
      ->check(CLI::IsMember(configs))
      ->capture_default_str();
  view->add_option("-o,--output", viewing.output, "The page to write; FILE.html if it is not given");
  add_assets(view, viewing.asset_paths);

  ShrinkCommand shrinking;
  CLI::App* shrink = add_shrink_command(app, shrinking);
  add_assets(shrink, shrinking.asset_paths);

  CLI::App* info = app.add_subcommand(
      "info", "Print the contents of recordings, hulls, compounds, meshes and height fields, without replaying them");
  info->add_option("file", paths, "Recordings and cooked shapes")->required();
  CLI::App* scenes = app.add_subcommand("scenes", "List the scenes that can be recorded");

  CookRequest cooking;
  std::string kind = "hull";
  std::string frame = "principal";
  bool refuse_more = false;
  CLI::App* cook = app.add_subcommand("cook",
                                      "Make a convex hull of points, a compound of hulls, a mesh of triangles or a "
                                      "field of heights, ready for the library");
  cook->add_option(
          "--kind", kind,
          "hull: of the vertices; compound: a hull of each group; mesh: of the faces; height-field: of a PGM's pixels")
      ->check(CLI::IsMember({"hull", "compound", "mesh", "height-field"}))
      ->capture_default_str();
  cook->add_option(
          "input", cooking.input,
          "An OBJ; clouds of points, by a name that ends in .bin; a mesh also as .gltf or .glb; heights as .pgm")
      ->required();
  cook->add_option("output", cooking.output, "The .hull, .compound, .mesh or .field to write; -: standard output")
      ->required();
  bool one_sided = false;
  cook->add_flag("--one-sided", one_sided,
                 "Mesh: bodies touch only the side from which its faces are counter-clockwise");
  bool two_sided = false;
  HeightFieldRequest heights;
  cook->add_flag("--two-sided", two_sided, "Height field: bodies touch its lower side, too");
  cook->add_option("--spacing", heights.spacing, "Height field: distance between samples, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  cook->add_option("--height", heights.height, "Height field: height of the brightest pixel, m")->capture_default_str();
  cook->add_option(
          "--frame", frame,
          "principal: for bodies, about the centre of mass along the principal axes; source: the frame of the points; "
          "its origin is then a compound's centre of mass")
      ->check(CLI::IsMember({"principal", "source"}))
      ->capture_default_str();
  cook->add_option("--weld", cooking.options.weld, "Leave out a point that is at most this far from another, m")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  cook->add_option("--vertices", cooking.options.vertex_limit,
                   "Hull: the greatest number of vertices; larger hulls are reduced")
      ->check(CLI::Range(4u, 255u))
      ->capture_default_str();
  cook->add_flag("--exact", refuse_more, "Hull: refuse one of more vertices, instead of reducing it");
  cook->add_option("--index", cooking.index, "Hull: which of the clouds of a .bin, from 0 on")->capture_default_str();

  RunCommand running;
  running.config = configs.front();
  std::vector<std::string> prints;
  bool schema = false, fields = false;
  CLI::App* run = app.add_subcommand("run", "Play a scene that is written as JSON (docs/scene.md)");
  run->add_option("scene", running.path, "The scene");
  run->add_option("--config", running.config, "The math configuration")
      ->check(CLI::IsMember(configs))
      ->capture_default_str();
  CLI::Option* run_ticks =
      run->add_option("--ticks", running.request.ticks, "How many to run; the scene's own length if it is not given")
          ->check(CLI::Range(0u, 1000000000u));
  run->add_option("-r,--record", running.request.recording,
                  "Write its recording to this file; compressed if its name ends in .zst");
  run->add_option("--digest-interval", running.request.digest_interval,
                  "Record a digest every so many ticks; 0: only at the end")
      ->capture_default_str();
  run->add_option("--print", prints,
                  "bodies: where they are at the end; events: of contacts, sensors, joints, sleep; queries: what they "
                  "found; ticks: the digest after each")
      ->delimiter(',')
      ->check(CLI::IsMember({"bodies", "events", "queries", "ticks"}));
  run->add_flag("--schema", schema, "Print the JSON Schema of scenes, and nothing else");
  run->add_flag("--fields", fields, "Print the tables of docs/scene.md, and nothing else");

  for (CLI::App* command :
       {record, verify, state, recover, compress, diff, trace, view, shrink, info, scenes, cook, run}) {
    command->add_flag("--json", report.json, "Print one JSON object per file, each on one line");
  }

  // Prints one short line instead of the parser's two.
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "detent: " + printable(error.what()) + " (see: detent --help)\n";
  });
  if (const std::string problem = command_problem(app, argc, argv); !problem.empty()) {
    fprintf(stderr, "detent: %s\n", printable(problem).c_str());
    return k_exit_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? k_exit_good : k_exit_usage;
  }
  if (verify->parsed() && verifying.paths.empty() && verifying.list.empty()) {
    fputs("verify: no recording is named\n", stderr);
    return k_exit_usage;
  }
  if (verifying.reading.from > verifying.reading.to || tracing.reading.from > tracing.reading.to) {
    fputs(trace->parsed() ? "trace: --from comes after --to\n" : "verify: --from comes after --to\n", stderr);
    return k_exit_usage;
  }
  if (request.path.empty()) request.path = request.scene + (request.compressed ? ".rec.zst" : ".rec");
  request.compressed = request.compressed || ends_with(request.path, k_compressed_suffix);
  if (record->parsed()) return run_record(request, config, report);
  if (verify->parsed()) return run_verify(verifying, report);
  if (state->parsed()) return run_state(reading, asset_paths, report);
  if (recover->parsed()) return run_recover(reading, output, asset_paths, report);
  if (diff->parsed()) return run_diff(diffing, asset_paths, report);
  if (trace->parsed()) return run_trace(tracing, trace_level, asset_paths, report);
  viewing.json = report.json;
  if (view->parsed()) return run_view(viewing);
  if (shrink->parsed()) return run_shrink(shrinking, report);
  if (compress->parsed()) return run_compress(paths, report);
  if (info->parsed()) return run_info(paths, report);
  if (run->parsed() && (schema || fields)) {
    const std::vector<ObjectInfo> objects = engines().front().scene_format();
    fputs((schema ? scene_schema(objects) : scene_tables(objects)).c_str(), stdout);
    return k_exit_good;
  }
  if (run->parsed() && running.path.empty()) {
    fputs("run: no scene is named\n", stderr);
    return k_exit_usage;
  }
  if (run->parsed()) {
    running.json = report.json;
    running.request.ticks_given = run_ticks->count() != 0;
    return run_scene(running, prints);
  }
  cooking.options.frame = frame == "source" ? detent_cook::Frame::source : detent_cook::Frame::principal;
  if (cook->parsed() && overwrites(cooking.output, {cooking.input})) return k_exit_usage;
  if (cook->parsed() && kind == "mesh") {
    return run_cook_mesh({cooking.input, cooking.output, {cooking.options.weld, one_sided}}, report);
  }
  if (cook->parsed() && kind == "compound")
    return cook_compound_file(cooking.input, cooking.output, cooking.options.frame, report.json) ? k_exit_good
                                                                                                 : k_exit_bad;
  if (cook->parsed() && kind == "height-field") {
    heights.input = cooking.input;
    heights.output = cooking.output;
    heights.one_sided = !two_sided;
    return cook_height_field_file(heights, report.json) ? k_exit_good : k_exit_bad;
  }
  if (cook->parsed()) {
    cooking.options.reduce = !refuse_more;
    return cook_file(cooking, report.json) ? k_exit_good : k_exit_bad;
  }
  return run_scenes(report);
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run_command(argc, argv);
  if (fflush(stdout) == 0 && ferror(stdout) == 0) return code;
  fprintf(stderr, "detent: %s\n", with_reason("standard output cannot be written").c_str());
  return code == k_exit_good ? k_exit_bad : code;
}
