#include <stdio.h>

#include <CLI/CLI.hpp>

#include "command.h"
#include "file.h"
#include "progress.h"
#include "release.h"
#include "report.h"
#include "run.h"
#include "stream.h"
#include "verification.h"

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

/// False, and a line to standard error, if one cannot be read.
bool read_assets(const std::vector<std::string>& paths, Assets& assets) {
  for (const std::string& path : paths) {
    assets.push_back({});
    if (read_asset(path, assets.back())) continue;
    fprintf(stderr, "%s: cannot be read\n", path.c_str());
    return false;
  }
  return true;
}

int run_verify(VerificationRequest& request, const Report& report) {
  if (!read_assets(request.asset_paths, request.reading.assets)) return k_exit_bad;
  return verify_all(request, report) ? k_exit_good : k_exit_bad;
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
  if (!read_assets(asset_paths, request.assets)) return k_exit_bad;
  std::error_code error;
  if (std::filesystem::equivalent(request.path, output, error)) {
    fprintf(stderr, "%s: would be written over\n", output.c_str());
    return k_exit_usage;
  }
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
  if (!read_assets(asset_paths, request.reading.assets)) return k_exit_bad;
  std::error_code error;
  if (std::filesystem::equivalent(request.reading.path, request.output, error)) {
    fprintf(stderr, "%s: would be written over\n", request.output.c_str());
    return k_exit_usage;
  }
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

/// 0: equal, 1: different, 2: they cannot be compared, or not to the end.
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

int run_compress(const std::vector<std::string>& paths, const Report& report) {
  int code = k_exit_good;
  for (const std::string& path : paths) {
    const std::string output = path + k_compressed_suffix;
    const std::string problem = versions_of(path) ? compress(path, output) : "is no recording";
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
    if (is_hull_file(path)) {
      if (!describe_hull_file(path, report.json)) code = k_exit_bad;
      continue;
    }
    if (is_compound_file(path)) {
      if (!describe_compound_file(path, report.json)) code = k_exit_bad;
      continue;
    }
    if (is_surface_file(path)) {
      if (!describe_surface_file(path, report.json)) code = k_exit_bad;
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

int run_scenes(const Report& report) {
  for (const SceneLine& line : engines().front().scenes()) report.scene(line);
  return k_exit_good;
}

}  // namespace

int main(int argc, char** argv) {
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
  record->add_option("-o,--output", request.path, "The file to write; SCENE.rec if it is not given");
  record->add_option("--config", config, "The math configuration")
      ->check(CLI::IsMember(configs))
      ->capture_default_str();
  record->add_option("--ticks", request.ticks, "Its length; the scene's own if it is not given")
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
  verify->add_option("--jobs", verifying.jobs, "So many files at a time")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  verify->add_option("--from", verifying.reading.from, "Only what comes after this tick");
  verify->add_option("--to", verifying.reading.to, "Only up to this tick");
  add_assets(verify, verifying.asset_paths);

  ReadRequest reading;
  std::vector<std::string> asset_paths;
  CLI::App* state = app.add_subcommand("state", "Print the bodies of a recording after a tick");
  state->add_option("file", reading.path, "A recording")->required();
  state->add_option("--tick", reading.to, "How many ticks the world has completed")->required();
  add_assets(state, asset_paths);
  std::string output;
  CLI::App* recover = app.add_subcommand("recover", "Write what is whole of a cut recording as a recording");
  recover->add_option("file", reading.path, "The recording that was cut")->required();
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
  CLI::App* trace = app.add_subcommand(
      "trace", "Replay a recording and write what this machine makes of some of its ticks, for diff");
  trace->add_option("file", tracing.reading.path, "A recording")->required();
  trace->add_option("-o,--output", tracing.output, "The recording to write; compressed if its name ends in .zst")
      ->required();
  trace
      ->add_option("--level", trace_level, "1: digests of each body, contact and joint after each stage; 2: all fields")
      ->check(CLI::Range(1u, 2u))
      ->capture_default_str();
  trace->add_option("--from", tracing.reading.from, "The first tick")->required();
  trace->add_option("--to", tracing.reading.to, "The last tick")->required();
  add_assets(trace, asset_paths);

  CLI::App* info = app.add_subcommand(
      "info", "Say what recordings, hulls, compounds, meshes and height fields hold, without replaying them");
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
  cook->add_option("output", cooking.output, "The .hull, .compound, .mesh or .field to write")->required();
  bool one_sided = false;
  cook->add_flag("--one-sided", one_sided, "Of a mesh: met only from the side that sees its faces counter-clockwise");
  bool two_sided = false;
  HeightFieldRequest heights;
  cook->add_flag("--two-sided", two_sided, "Of a height field: met from below, too");
  cook->add_option("--spacing", heights.spacing, "Of a height field: from sample to sample, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  cook->add_option("--height", heights.height, "Of a height field: of the brightest pixel, m")->capture_default_str();
  cook->add_option(
          "--frame", frame,
          "principal: for bodies, about the centre of mass along the principal axes; source: as the points are")
      ->check(CLI::IsMember({"principal", "source"}))
      ->capture_default_str();
  cook->add_option("--weld", cooking.options.weld, "Leave out a point this near to another, m")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  cook->add_option("--vertices", cooking.options.vertex_limit, "Reduce the hull to so many vertices")
      ->check(CLI::Range(4u, 255u))
      ->capture_default_str();
  cook->add_flag("--exact", refuse_more, "Refuse a hull of more vertices, instead of reducing it");
  cook->add_option("--index", cooking.index, "Which of the clouds of a .bin, from 0 on")->capture_default_str();

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
      run->add_option("--ticks", running.request.ticks, "Its length; the scene's own if it is not given")
          ->check(CLI::Range(0u, 1000000000u));
  run->add_option("-r,--record", running.request.recording, "Write its recording to this file");
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

  for (CLI::App* command : {record, verify, state, recover, compress, diff, trace, info, scenes, cook, run}) {
    command->add_flag("--json", report.json, "One JSON object a file, each on one line");
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
  if (compress->parsed()) return run_compress(paths, report);
  if (info->parsed()) return run_info(paths, report);
  if (run->parsed() && (schema || fields)) {
    const std::vector<ObjectInfo> objects = engines().front().scene_format();
    fputs((schema ? scene_schema(objects) : scene_tables(objects)).c_str(), stdout);
    return k_exit_good;
  }
  if (run->parsed() && running.path.empty()) {
    fprintf(stderr, "detent run: which scene?\n");
    return k_exit_usage;
  }
  if (run->parsed()) {
    running.json = report.json;
    running.request.ticks_given = run_ticks->count() != 0;
    return run_scene(running, prints);
  }
  if (cook->parsed() && kind == "mesh") {
    return run_cook_mesh({cooking.input, cooking.output, {cooking.options.weld, one_sided}}, report);
  }
  if (cook->parsed() && kind == "compound")
    return cook_compound_file(cooking.input, cooking.output, report.json) ? k_exit_good : k_exit_bad;
  if (cook->parsed() && kind == "height-field") {
    heights.input = cooking.input;
    heights.output = cooking.output;
    heights.one_sided = !two_sided;
    return cook_height_field_file(heights, report.json) ? k_exit_good : k_exit_bad;
  }
  if (cook->parsed()) {
    cooking.options.frame = frame == "source" ? detent_cook::Frame::source : detent_cook::Frame::principal;
    cooking.options.reduce = !refuse_more;
    return cook_file(cooking, report.json) ? k_exit_good : k_exit_bad;
  }
  return run_scenes(report);
}
