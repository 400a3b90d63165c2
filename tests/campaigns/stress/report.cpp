#include "tests/campaigns/stress/report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/campaigns/stress/bounds.h"

namespace detent_stress {

namespace {

/// A measure of a scene at a scale: for each configuration the worst over all seeds.
struct Cell {
  std::string group, scene, measure;
  double scale = 1;
  struct Worst {
    std::string config;
    double value = 0;
    uint32_t seeds = 0;
  };
  std::vector<Worst> worst;
};

bool misses(const Wanted* wanted, double value) { return wanted != nullptr && !(value <= wanted->bound); }

std::vector<Cell> cells_of(const std::vector<Row>& rows) {
  std::vector<Cell> cells;
  for (const Row& row : rows) {
    for (const Measured& measured : row.outcome.measured) {
      auto cell = std::find_if(cells.begin(), cells.end(), [&](const Cell& other) {
        return other.scene == row.scene && other.scale == row.scale && other.measure == measured.name;
      });
      if (cell == cells.end()) cell = cells.insert(cell, {row.group, row.scene, measured.name, row.scale, {}});
      auto worst = std::find_if(cell->worst.begin(), cell->worst.end(),
                                [&](const Cell::Worst& other) { return other.config == row.config; });
      if (worst == cell->worst.end()) worst = cell->worst.insert(worst, {row.config, measured.value, 0});
      if (!(measured.value <= worst->value)) worst->value = measured.value;
      ++worst->seeds;
    }
  }
  return cells;
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// A value that exceeds its target.
struct Miss {
  std::string config;
  double scale = 1, value = 0;
};

bool are_alike(const std::vector<Miss>& misses) {
  double low = misses.front().value, high = low;
  for (const Miss& miss : misses) {
    low = fmin(low, miss.value);
    high = fmax(high, miss.value);
  }
  return high <= 2 * low;
}

/// A row of k_gaps, with 1.5 times the worst value as bound.
std::string gap_row(const Cell& cell, const std::string& config, double scale, const std::vector<Miss>& misses) {
  double worst = 0;
  for (const Miss& miss : misses) worst = fmax(worst, miss.value);
  char held[32];
  snprintf(held, sizeof held, "%.2g", worst * 1.5);
  return "    {" + quoted(cell.scene) + ", " + quoted(config) + ", " + figure(scale) + ", " + quoted(cell.measure) +
         ", " + held + "},\n";
}

}  // namespace

std::string figure(double value) {
  char text[32];
  if (value == rint(value) && fabs(value) < 1e6)
    snprintf(text, sizeof text, "%.0f", value);
  else
    snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string line_of(const Row& row) {
  std::string text = row.scene + " " + row.config + " scale " + figure(row.scale) + " seed " + std::to_string(row.seed);
  if (!row.outcome.problem.empty()) return text + ": " + row.outcome.problem;
  text += ":";
  for (const Measured& measured : row.outcome.measured) {
    const Wanted* wanted = find_wanted(row.scene, measured.name);
    if (wanted != nullptr && wanted->bound == 0 && measured.value == 0) continue;
    text += " " + measured.name + " " + figure(measured.value);
    if (misses(wanted, measured.value)) text += " (! " + figure(wanted->bound) + ")";
  }
  if (row.outcome.ticks != 0) {
    const double us = row.outcome.step_seconds / static_cast<double>(row.outcome.ticks) * 1e6;
    text += "; " + figure(us) + " us a step";
  }
  return text;
}

std::string markdown_of(const std::vector<Row>& rows) {
  std::vector<std::string> configs;
  for (const Row& row : rows) {
    if (std::find(configs.begin(), configs.end(), row.config) == configs.end()) configs.push_back(row.config);
  }
  std::string text = "| scene | scale | measure | wanted |", rule = "|---|---|---|---|";
  for (const std::string& config : configs) {
    text += " " + config + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const Cell& cell : cells_of(rows)) {
    const Wanted* wanted = find_wanted(cell.scene, cell.measure);
    text += "| " + cell.group + " " + cell.scene + " | " + figure(cell.scale) + " | " + cell.measure + " | " +
            (wanted != nullptr ? figure(wanted->bound) : "") + " |";
    for (const std::string& config : configs) {
      const auto worst = std::find_if(cell.worst.begin(), cell.worst.end(),
                                      [&](const Cell::Worst& other) { return other.config == config; });
      if (worst == cell.worst.end())
        text += " - |";
      else
        text +=
            misses(wanted, worst->value) ? " **" + figure(worst->value) + "** |" : " " + figure(worst->value) + " |";
    }
    text += "\n";
  }
  for (const Row& row : rows) {
    if (!row.outcome.problem.empty()) text += "\n" + line_of(row) + "\n";
  }
  return text;
}

std::string json_of(const std::vector<Row>& rows) {
  std::string text = "[";
  for (const Row& row : rows) {
    char digest[32];
    snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(row.outcome.digest));
    nlohmann::ordered_json json = {{"scene", row.scene},
                                   {"config", row.config},
                                   {"scale", row.scale},
                                   {"seed", row.seed},
                                   {"ticks", row.outcome.ticks}};
    if (row.outcome.problem.empty()) {
      json["digest"] = digest;
      for (const Measured& measured : row.outcome.measured) {
        const Wanted* wanted = find_wanted(row.scene, measured.name);
        json["measures"][measured.name] = measured.value;
        if (wanted != nullptr) json["wanted"][measured.name] = wanted->bound;
      }
    } else {
      json["problem"] = row.outcome.problem;
    }
    text += (text.size() > 1 ? ",\n " : "") + json.dump();
  }
  return text + "]\n";
}

std::string gaps_of(const std::vector<Row>& rows) {
  const std::vector<Cell> cells = cells_of(rows);
  std::string text;
  std::vector<std::string> done;
  for (const Cell& first : cells) {
    const std::string key = first.scene + " " + first.measure;
    if (std::find(done.begin(), done.end(), key) != done.end()) continue;
    done.push_back(key);
    const Wanted* wanted = find_wanted(first.scene, first.measure);
    // One row if all configurations and scales have similar values; otherwise one for each configuration, or one for
    // each value.
    std::vector<Miss> all;
    size_t measured = 0;
    std::vector<std::string> configs;
    for (const Cell& cell : cells) {
      if (cell.scene != first.scene || cell.measure != first.measure) continue;
      for (const Cell::Worst& worst : cell.worst) {
        ++measured;
        if (misses(wanted, worst.value)) all.push_back({worst.config, cell.scale, worst.value});
        if (std::find(configs.begin(), configs.end(), worst.config) == configs.end()) configs.push_back(worst.config);
      }
    }
    if (all.size() > 1 && all.size() == measured && are_alike(all)) {
      text += gap_row(first, "", 0, all);
      continue;
    }
    for (const std::string& config : configs) {
      std::vector<Miss> own;
      for (const Miss& miss : all) {
        if (miss.config == config) own.push_back(miss);
      }
      if (own.size() > 1 && own.size() * configs.size() == measured && are_alike(own)) {
        text += gap_row(first, config, 0, own);
        continue;
      }
      for (const Miss& miss : own) text += gap_row(first, config, miss.scale, {miss});
    }
  }
  for (const Gap& gap : k_gaps) {
    bool seen = false, needed = false;
    for (const Cell& cell : cells_of(rows)) {
      if (*gap.scene == 0 || cell.scene.compare(0, strlen(gap.scene), gap.scene) != 0 || cell.measure != gap.measure ||
          (gap.scale != 0 && gap.scale != cell.scale))
        continue;
      for (const Cell::Worst& worst : cell.worst) {
        if (*gap.config != 0 && worst.config != gap.config) continue;
        seen = true;
        needed = needed || misses(find_wanted(cell.scene, cell.measure), worst.value);
      }
    }
    if (seen && !needed)
      text += std::string("    // no longer needed: ") + gap.scene + " " + gap.config + " " + figure(gap.scale) + " " +
              gap.measure + "\n";
  }
  return text;
}

}  // namespace detent_stress
