#include "tests/bench/world/rows.h"

#include <algorithm>

#include "tests/bench/step_json.h"

namespace detent_bench {

namespace {

using detent_text::Cells;
using detent_text::text;

constexpr const char* k_configs[] = {"fx64", "f32", "f64", "fx32"};

std::string number(double value) {
  const double size = value < 0 ? -value : value;
  if (value == 0) return "0";
  return text(size >= 100 ? "%.0f" : size >= 0.01 ? "%.3g" : "%.1e", value);
}

std::string ratio(const WorldRow* row, const WorldRow* reference) {
  if (row == nullptr || reference == nullptr || reference->times.median <= 0) return "-";
  const double value = row->times.median / reference->times.median;
  return text(value < 0.01 ? "%.1g" : "%.2f", value);
}

std::string effort_text(const Effort& effort) {
  std::string result;
  if (effort.substeps != 0) result += text("%u substeps", effort.substeps);
  if (effort.iterations != 0) result += (result.empty() ? "" : ", ") + text("%u iterations", effort.iterations);
  if (effort.penetration != 0) result += text("penetration 1/%u", effort.penetration);
  return result.empty() ? "default" : result;
}

/// The row of this engine and configuration at its own settings, or null.
const WorldRow* find_row(const std::vector<WorldRow>& rows, const WorldRow& like, const std::string& engine,
                         const std::string& config) {
  for (const WorldRow& row : rows) {
    if (row.scene == like.scene && row.ground == like.ground && row.engine == engine && row.config == config &&
        row.effort.is_default())
      return &row;
  }
  return nullptr;
}

/// The first row of each scene and ground.
std::vector<const WorldRow*> firsts_of(const std::vector<WorldRow>& rows) {
  std::vector<const WorldRow*> firsts;
  for (const WorldRow& row : rows) {
    if (std::none_of(firsts.begin(), firsts.end(), [&row](const WorldRow* first) {
          return first->scene == row.scene && first->ground == row.ground;
        }))
      firsts.push_back(&row);
  }
  return firsts;
}

std::string name_of(const WorldRow& row) { return row.scene + (row.ground == "own" ? "" : ", " + row.ground); }

}  // namespace

std::string world_table_of(const std::vector<WorldRow>& rows) {
  if (rows.empty()) return "";
  std::vector<Cells> cells = {{"scene", "engine", "config", "effort", "us", "p99", "max", "p99/us", "ratio", "contacts",
                               "ns each", "kB", "allocs", "losses"}};
  for (const auto& measure : rows.front().measures) cells.front().push_back(measure.first);
  for (const WorldRow& row : rows) {
    Cells line = {name_of(row), row.engine, row.config, effort_text(row.effort)};
    for (const double value : {row.times.median, row.times.p99, row.times.max}) line.push_back(number(value));
    line.push_back(row.times.median > 0 ? text("%.2f", row.times.p99 / row.times.median) : "-");
    line.push_back(ratio(&row, find_row(rows, row, "bullet", "double")));
    line.push_back(std::to_string(row.contacts));
    line.push_back(row.contacts > 0 ? text("%.0f", 1000 * row.times.median / row.contacts) : "-");
    for (const uint64_t value : {(row.bytes + 999) / 1000, row.allocs, row.losses})
      line.push_back(std::to_string(value));
    for (const auto& measure : row.measures) line.push_back(number(measure.second));
    cells.push_back(line);
  }
  return detent_text::table_of(cells, false);
}

std::string world_summary_of(const std::vector<WorldRow>& rows) {
  std::vector<Cells> cells = {{"scene", "bullet double, us"}};
  for (const char* config : k_configs) cells.front().push_back(std::string(config) + " / bullet");
  for (const char* name : {"bullet float / double", "ode / bullet", "fx64 / f32", "fx64 p99/us", "fx64 stages"})
    cells.front().emplace_back(name);
  for (const WorldRow* first : firsts_of(rows)) {
    const auto row = [&](const char* engine, const char* config) { return find_row(rows, *first, engine, config); };
    const WorldRow *bullet = row("bullet", "double"), *fx64 = row("detent", "fx64");
    Cells line = {name_of(*first), bullet != nullptr ? number(bullet->times.median) : "-"};
    for (const char* config : k_configs) line.push_back(ratio(row("detent", config), bullet));
    line.push_back(ratio(row("bullet", "float"), bullet));
    line.push_back(ratio(row("ode", "double"), bullet));
    line.push_back(ratio(fx64, row("detent", "f32")));
    line.push_back(fx64 != nullptr && fx64->times.median > 0 ? text("%.2f", fx64->times.p99 / fx64->times.median)
                                                             : "-");
    line.push_back(fx64 != nullptr ? stages_text(fx64->stages) : "-");
    cells.push_back(line);
  }
  return detent_text::table_of(cells, false);
}

std::string growth_table_of(const std::vector<WorldRow>& rows) {
  std::vector<Cells> cells = {{"scene", "bodies", "contact points"}};
  for (const WorldRow& row : rows) {
    if (row.scene == rows.front().scene && row.ground == rows.front().ground)
      cells.front().push_back((row.engine == "detent" ? "" : row.engine + " ") + row.config + ", ns");
  }
  for (const WorldRow* first : firsts_of(rows)) {
    Cells line = {name_of(*first), std::to_string(first->bodies), std::to_string(first->contacts)};
    for (const WorldRow& row : rows) {
      if (row.scene == first->scene && row.ground == first->ground)
        line.push_back(text("%.0f", 1000 * row.times.median / row.bodies));
    }
    cells.push_back(line);
  }
  return detent_text::table_of(cells, false);
}

std::string world_json_of(const std::vector<WorldRow>& rows, bool study) {
  std::vector<nlohmann::ordered_json> lines;
  for (const WorldRow& row : rows) {
    nlohmann::ordered_json json = {
        {"scene", row.scene}, {"ground", row.ground}, {"engine", row.engine}, {"config", row.config}};
    if (study) {
      json["substeps"] = row.effort.substeps;
      json["iterations"] = row.effort.iterations;
      json["penetration"] = row.effort.penetration;
    }
    json["bodies"] = row.bodies;
    add_times(json, row.times, row.stages);
    json["contacts"] = row.contacts;
    json["bytes"] = row.bytes;
    json["allocs"] = row.allocs;
    json["settings"] = row.settings;
    json["measures"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : row.measures) json["measures"][name] = rounded(value, 5);
    lines.push_back(json);
  }
  return lines_of(lines);
}

}  // namespace detent_bench
