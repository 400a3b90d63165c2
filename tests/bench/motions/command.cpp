#include "tests/bench/motions/command.h"

#include <stdio.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/draw.h"
#include "tests/bench/motions/step_motion.h"

namespace detent_bench {

namespace {

using namespace detent_oracle;

constexpr const char* k_help =
    R"(How far motions between the same two poses of a body are apart on the way: the greatest over the step, of the point
where it is greatest in parts of the body's radius, and of the rotation in rad. The library's motion, of constant velocity
and angular_velocity, is asked of the library. A lever is how far the axis of the screw is from the body's centre, in radii.
  screw          from the library's motion: the screw at constant speed; the rotations are the same
  tangent        from the library's motion: the screw with the tangent of half its angle as clock; up to 2.65 rad
  nlerp          from the library's motion: positions and normalised quaternions on chords
  2, 4, 8 pieces from the screw: constant velocity and angular_velocity through so many poses of it; one piece is the library's
                 motion, and the rotations are the same)";

constexpr double k_pi = 3.141592653589793;
constexpr double k_tangent_angle_max = 2.65;  // of feature_toi_screw()
constexpr double k_levers[] = {0, 1, 10};
constexpr int k_rows_printed = 4;  // one row in as many

struct Row {
  const char* motion;
  double lever, angle;
  Apart apart;
};

/// Turned anyhow, and moved by half a radius along the axis, which no motion does differently.
PosesOfStep poses_of(double lever, double angle) {
  const Vector axis = normalised(Vector{{1, 2, 3}}), across = normalised(cross(axis, Vector{{1, 0, 0}}));
  PosesOfStep poses;
  poses.start = {{{0, 0, 0}}, rotation_by(Vector{{0.3, -1.1, 0.7}})};
  poses.displacement = axis * 0.5 + across * (2 * lever * sin(angle / 2));
  poses.rotation_vector = axis * angle;
  return poses;
}

std::vector<Row> rows_of(double lever, double angle) {
  const PosesOfStep poses = poses_of(lever, angle);
  const auto step = [&](double time) { return step_motion_at(poses, time); };
  const auto screw = [&](double time) { return even_screw_at(poses, time); };
  std::vector<Row> rows;
  rows.push_back({"screw", lever, angle, farthest_apart(step, screw, 1)});
  if (angle <= k_tangent_angle_max) {
    const auto tangent = [&](double time) { return tangent_screw_at(poses, time); };
    rows.push_back({"tangent", lever, angle, farthest_apart(step, tangent, 1)});
  }
  const auto nlerp = [&](double time) { return normalised_lerp_at(poses, time); };
  rows.push_back({"nlerp", lever, angle, farthest_apart(step, nlerp, 1)});
  const std::pair<int, const char*> counts[] = {{2, "2 pieces"}, {4, "4 pieces"}, {8, "8 pieces"}};
  for (const auto& [count, name] : counts) {
    const int pieces = count;
    const auto broken = [&](double time) { return pieces_at(poses, pieces, time); };
    rows.push_back({name, lever, angle, farthest_apart(screw, broken, 1)});
  }
  return rows;
}

/// Eight a decade from 0.01 rad on, and half a turn.
std::vector<double> angles() {
  std::vector<double> result;
  for (int eighth = -16; eighth <= 3; ++eighth) result.push_back(pow(10, eighth / 8.0));
  result.push_back(k_pi);
  return result;
}

/// What the rounding of the library leaves of nothing is nothing.
double rounded(double value) { return value < 1e-13 ? 0 : value; }

void print(const std::vector<Row>& rows) {
  printf("%9.4f", rows.front().angle);
  for (const Row& row : rows) {
    if (rows.size() < 6 && row.motion == std::string("nlerp")) printf("   %8s %8s", "-", "-");
    printf("   %8.2g %8.2g", rounded(row.apart.distance), rounded(row.apart.angle));
  }
  printf("\n");
}

}  // namespace

CLI::App* add_motions_command(CLI::App& app, MotionsOptions& options) {
  CLI::App* command = app.add_subcommand("motions", k_help);
  command->add_option("--json", options.json, "Write the rows to this file");
  command->add_option("--plot", options.plot, "Draw the rows (SVG) into this folder");
  return command;
}

int run_motions(const MotionsOptions& options) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const double lever : k_levers) {
    printf("lever %g: distance in radii, angle in rad\n%9s", lever, "turn, rad");
    for (const char* name : {"screw", "tangent", "nlerp", "2 pieces", "4 pieces", "8 pieces"}) printf("   %17s", name);
    printf("\n");
    int index = 0;
    for (const double angle : angles()) {
      const std::vector<Row> rows = rows_of(lever, angle);
      if (index++ % k_rows_printed == 0) print(rows);
      for (const Row& row : rows)
        all.push_back({{"motion", row.motion},
                       {"lever", row.lever},
                       {"rotation_vector", row.angle},
                       {"distance", rounded(row.apart.distance)},
                       {"angle", rounded(row.apart.angle)}});
    }
  }
  const std::string json = all.dump(1) + "\n";
  if (!options.json.empty() && !(std::ofstream(options.json) << json)) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return 1;
  }
  if (!options.plot.empty() && !draw(options.plot, "motions.json", json)) {
    fprintf(stderr, "bench: the plot could not be drawn (Debian: python3-matplotlib)\n");
    return 1;
  }
  return 0;
}

}  // namespace detent_bench
