#include "tests/campaigns/joint_fuzz/report.h"

#include <algorithm>

#include "tests/common/support/text_table.h"

namespace detent_joint_fuzz {

namespace {

using detent_text::Cells;
using detent_text::quantile;
using detent_text::table_of;
using detent_text::text;

Cells header() {
  return {"scenes",       "count",    "grow",      "in space",       "tenfold",   "silent",
          "not a number", "worst, x", "rise, p90", "gap, m: median", "p90",       "worst",
          "rad: median",  "p90",      "substeps",  "us/joint/tick",  "saturated", "undecided"};
}

template <class Belongs>
Cells row_of(const std::string& name, const std::vector<Verdict>& verdicts, const Belongs& belongs) {
  uint32_t count = 0, grow = 0, in_space = 0, tenfold = 0, silent = 0, broken = 0, saturated = 0, undecided = 0;
  double worst = 0, substeps = 0, nanoseconds = 0, joint_ticks = 0;
  std::vector<double> lengths, angles, rises;
  for (const Verdict& verdict : verdicts) {
    if (!belongs(verdict)) continue;
    ++count;
    grow += verdict.grows();
    in_space += verdict.grows() && !verdict.gravity;
    tenfold += verdict.grows_tenfold();
    silent += verdict.is_silent();
    broken += !verdict.finite;
    saturated += verdict.saturations != 0;
    undecided += verdict.undecided != 0;
    worst = std::max(worst, verdict.growth);
    substeps += verdict.substeps;
    nanoseconds += verdict.nanoseconds;
    joint_ticks += static_cast<double>(verdict.joints) * verdict.ticks;
    lengths.push_back(verdict.gap.length);
    angles.push_back(verdict.gap.angle);
    rises.push_back(verdict.rise);
  }
  if (count == 0) return {};
  return {name,
          text("%u", count),
          text("%u", grow),
          text("%u", in_space),
          text("%u", tenfold),
          text("%u", silent),
          text("%u", broken),
          text("%.4g", 1 + worst),
          text("%.2g", quantile(rises, 0.9)),
          text("%.2g", quantile(lengths, 0.5)),
          text("%.2g", quantile(lengths, 0.9)),
          text("%.2g", quantile(lengths, 1)),
          text("%.2g", quantile(angles, 0.5)),
          text("%.2g", quantile(angles, 0.9)),
          text("%.2f", substeps / count),
          text("%.2f", nanoseconds / std::max(joint_ticks, 1.0) / 1000),
          text("%u", saturated),
          text("%u", undecided)};
}

bool is_passive(const Verdict& verdict) { return verdict.kind < Kind::contact; }

/// A table by the properties that make a scene hard.
std::vector<Cells> hardness_of(const std::vector<Verdict>& verdicts) {
  constexpr double k_slow = 6, k_fast = 30, k_alike = 10, k_short = 4;
  struct Part {
    const char* name;
    bool (*belongs)(const Verdict&);
  };
  constexpr Part k_parts[] = {
      {"anchors to 6 m/s", [](const Verdict& v) { return v.tip_speed <= k_slow; }},
      {"6 to 30 m/s", [](const Verdict& v) { return v.tip_speed > k_slow && v.tip_speed <= k_fast; }},
      {"faster", [](const Verdict& v) { return v.tip_speed > k_fast; }},
      {"masses to 10 : 1", [](const Verdict& v) { return v.mass_ratio <= k_alike; }},
      {"beyond", [](const Verdict& v) { return v.mass_ratio > k_alike; }},
      {"arms to 4 sizes", [](const Verdict& v) { return v.arm_ratio <= k_short; }},
      {"longer", [](const Verdict& v) { return v.arm_ratio > k_short; }},
      {"slow, alike, short",
       [](const Verdict& v) { return v.tip_speed <= k_slow && v.mass_ratio <= k_alike && v.arm_ratio <= k_short; }},
  };
  std::vector<Cells> rows = {header()};
  rows[0][0] = "no drives, no contacts";
  for (const Part& part : k_parts)
    rows.push_back(row_of(part.name, verdicts, [&](const Verdict& v) { return is_passive(v) && part.belongs(v); }));
  return rows;
}

}  // namespace

std::string tables_of(const std::vector<Verdict>& verdicts, bool markdown) {
  std::vector<Cells> by_kind = {header()};
  for (uint32_t kind = 0; kind < k_kinds; ++kind) {
    const auto belongs = [&](const Verdict& verdict) { return static_cast<uint32_t>(verdict.kind) == kind; };
    by_kind.push_back(row_of(name_of(static_cast<Kind>(kind)), verdicts, belongs));
  }
  by_kind.push_back(row_of("no drives, no contacts", verdicts, is_passive));
  by_kind.push_back(row_of("all", verdicts, [](const Verdict&) { return true; }));
  std::vector<Cells> by_type = {header()};
  by_type[0][0] = "no drives, no contacts";
  for (uint32_t hold = 1; hold <= k_holds; ++hold) {
    const std::string name = name_of(static_cast<Hold>(hold));
    const auto belongs = [&](const Verdict& verdict) { return is_passive(verdict) && verdict.types == name; };
    by_type.push_back(row_of("all " + name, verdicts, belongs));
  }
  const auto mixed = [](const Verdict& verdict) { return is_passive(verdict) && verdict.types == "mixed"; };
  by_type.push_back(row_of("mixed", verdicts, mixed));
  return table_of(by_kind, markdown) + table_of(by_type, markdown) + table_of(hardness_of(verdicts), markdown);
}

std::string lines_of(const std::vector<Verdict>& verdicts, const std::string& config) {
  std::string lines;
  for (const Verdict& v : verdicts) {
    lines += text("%s,%llu,%s,%s,%u,%u,%d,%.6g,%.6g,%llu,%.6g,%.6g,%.3f,%.0f,%.3g,%.3g,%.3g,%u\n", config.c_str(),
                  static_cast<unsigned long long>(v.seed), name_of(v.kind), v.types.c_str(), v.bodies, v.joints,
                  v.gravity, v.growth, v.rise, static_cast<unsigned long long>(v.saturations), v.gap.length,
                  v.gap.angle, v.substeps, v.nanoseconds, v.mass_ratio, v.tip_speed, v.arm_ratio, v.grown_at);
  }
  return lines;
}

std::string worst_of(const std::vector<Verdict>& verdicts, uint32_t count) {
  std::vector<Verdict> bad;
  std::copy_if(verdicts.begin(), verdicts.end(), std::back_inserter(bad), [](const Verdict& v) { return v.grows(); });
  std::stable_sort(bad.begin(), bad.end(), [](const Verdict& a, const Verdict& b) { return a.growth > b.growth; });
  std::vector<Cells> rows = {
      {"seed", "kind", "types", "bodies", "joints", "gravity", "grown at", "x", "substeps", "saturations"}};
  for (const Verdict& verdict : bad) {
    if (rows.size() > count) break;
    rows.push_back({text("%llu", static_cast<unsigned long long>(verdict.seed)), name_of(verdict.kind), verdict.types,
                    text("%u", verdict.bodies), text("%u", verdict.joints), verdict.gravity ? "yes" : "no",
                    text("%u", verdict.grown_at), text("%.4g", 1 + verdict.growth), text("%.2f", verdict.substeps),
                    text("%llu", static_cast<unsigned long long>(verdict.saturations))});
  }
  return bad.empty() ? "" : table_of(rows, false);
}

}  // namespace detent_joint_fuzz
