#include "tests/campaigns/manifolds/report.h"

#include <algorithm>
#include <set>

#include "tests/common/support/text_table.h"

namespace detent_manifolds {

namespace {

using detent_text::Cells;
using detent_text::table_of;
using detent_text::text;

double reading_of(const Verdict& verdict, Measure measure) {
  return verdict.worst[static_cast<uint32_t>(measure)].value;
}
bool has(const Verdict& verdict, Measure measure) { return verdict.measured[static_cast<uint32_t>(measure)]; }

std::string share_of(uint32_t part, uint32_t whole) {
  if (whole == 0) return "";
  return part == whole ? "1" : text("%.4f", static_cast<double>(part) / whole);
}

Cells header(const std::string& first) {
  Cells cells = {first, "pairs", "reused"};
  for (uint32_t i = 0; i < k_measures; ++i) cells.push_back(name_of(static_cast<Measure>(i)));
  cells.insert(cells.end(), {"lost", "idle", "seams", "names kept", "found anew"});
  return cells;
}

Cells row_of(const std::string& name, const std::vector<Verdict>& verdicts) {
  Verdict sum;
  for (const Verdict& verdict : verdicts) {
    sum.ticks += verdict.ticks;
    sum.reused += verdict.reused;
    sum.lost += verdict.lost != 0;
    sum.idle += verdict.idle != 0;
    sum.seams += verdict.seams != 0;
    sum.names += verdict.names;
    sum.names_kept += verdict.names_kept;
    sum.names_anew += verdict.names_anew;
    sum.names_anew_kept += verdict.names_anew_kept;
  }
  if (verdicts.empty()) return {};
  Cells cells = {name, text("%zu", verdicts.size()), text("%.2f", static_cast<double>(sum.reused) / sum.ticks)};
  for (uint32_t i = 0; i < k_measures; ++i) {
    const Measure measure = static_cast<Measure>(i);
    const bool any =
        std::any_of(verdicts.begin(), verdicts.end(), [&](const Verdict& verdict) { return has(verdict, measure); });
    std::string cell;
    for (const double share : {0.5, 0.99, 1.0})
      cell += (cell.empty() ? "" : ", ") + text("%.2g", quantile_of(verdicts, measure, share));
    cells.push_back(any ? cell : "");
  }
  cells.insert(cells.end(), {text("%u", sum.lost), text("%u", sum.idle), text("%u", sum.seams),
                             share_of(sum.names_kept, sum.names), share_of(sum.names_anew_kept, sum.names_anew)});
  return cells;
}

template <class Belongs>
std::vector<Verdict> those(const std::vector<Verdict>& verdicts, const Belongs& belongs) {
  std::vector<Verdict> result;
  std::copy_if(verdicts.begin(), verdicts.end(), std::back_inserter(result), belongs);
  return result;
}

}  // namespace

double quantile_of(const std::vector<Verdict>& verdicts, Measure measure, double share) {
  std::vector<double> values;
  for (const Verdict& verdict : verdicts) {
    if (has(verdict, measure)) values.push_back(reading_of(verdict, measure));
  }
  return detent_text::quantile(std::move(values), share);
}

std::string tables_of(const std::vector<Verdict>& verdicts, bool markdown) {
  std::vector<Cells> by_kind = {header("kind")}, by_shapes = {header("shapes")}, by_motion = {header("motion")};
  for (uint32_t kind = 0; kind < k_kinds; ++kind) {
    by_kind.push_back(row_of(name_of(static_cast<Kind>(kind)), those(verdicts, [&](const Verdict& verdict) {
                               return static_cast<uint32_t>(verdict.kind) == kind;
                             })));
  }
  by_kind.push_back(row_of("all", verdicts));
  std::set<std::string> shapes;
  for (const Verdict& verdict : verdicts) shapes.insert(verdict.shapes);
  for (const std::string& name : shapes)
    by_shapes.push_back(row_of(name, those(verdicts, [&](const Verdict& verdict) { return verdict.shapes == name; })));
  for (uint32_t motion = 0; motion < k_motions; ++motion) {
    by_motion.push_back(row_of(name_of(static_cast<Motion>(motion)), those(verdicts, [&](const Verdict& verdict) {
                                 return static_cast<uint32_t>(verdict.motion) == motion;
                               })));
  }
  return table_of(by_kind, markdown) + table_of(by_shapes, markdown) + table_of(by_motion, markdown);
}

std::string lines_of(const std::vector<Verdict>& verdicts, const std::string& config) {
  std::string lines;
  for (const Verdict& verdict : verdicts) {
    lines += config + text(",%llu,%s,%s,%s", static_cast<unsigned long long>(verdict.seed), name_of(verdict.kind),
                           name_of(verdict.motion), verdict.shapes.c_str());
    for (uint32_t i = 0; i < k_measures; ++i)
      lines += verdict.measured[i] ? text(",%.4g,%u", verdict.worst[i].value, verdict.worst[i].tick) : ",,";
    lines += "\n";
  }
  return lines;
}

std::string worst_of(const std::vector<Verdict>& verdicts, uint32_t count, bool markdown) {
  std::vector<Cells> rows = {{"measure", "value", "seed", "tick", "kind", "motion", "shapes"}};
  for (uint32_t i = 0; i < k_measures; ++i) {
    const Measure measure = static_cast<Measure>(i);
    std::vector<Verdict> measured = those(verdicts, [&](const Verdict& verdict) { return has(verdict, measure); });
    std::stable_sort(measured.begin(), measured.end(), [&](const Verdict& a, const Verdict& b) {
      return reading_of(a, measure) > reading_of(b, measure);
    });
    for (size_t k = 0; k < measured.size() && k < count; ++k) {
      const Verdict& verdict = measured[k];
      rows.push_back({name_of(measure), text("%.3g", reading_of(verdict, measure)),
                      text("%llu", static_cast<unsigned long long>(verdict.seed)), text("%u", verdict.worst[i].tick),
                      name_of(verdict.kind), name_of(verdict.motion), verdict.shapes});
    }
  }
  for (const Verdict& verdict : verdicts) {
    if (verdict.lost == 0 && verdict.idle == 0 && verdict.capped == 0) continue;
    rows.push_back({verdict.lost != 0   ? "lost"
                    : verdict.idle != 0 ? "idle"
                                        : "capped",
                    text("%u", verdict.lost + verdict.idle + verdict.capped),
                    text("%llu", static_cast<unsigned long long>(verdict.seed)), "", name_of(verdict.kind),
                    name_of(verdict.motion), verdict.shapes});
  }
  return table_of(rows, markdown);
}

}  // namespace detent_manifolds
