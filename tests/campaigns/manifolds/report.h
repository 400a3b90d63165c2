#pragma once
#include "tests/campaigns/manifolds/measure.h"

namespace detent_manifolds {

/// Tables by kind, shapes and motion: for each measure the median, 99th percentile and maximum of the pairs' worst
/// ticks; the number of pairs with lost points, idle points or seams; and the fraction of kept names. For a terminal,
/// or as Markdown.
std::string tables_of(const std::vector<Verdict>& verdicts, bool markdown);

/// The worst pairs of each measure and kind, with their seeds and ticks, at most `count` of each measure.
std::string worst_of(const std::vector<Verdict>& verdicts, uint32_t count, bool markdown);

/// One line for each pair: configuration, seed, kind, motion, shapes, then for each measure the worst value and its
/// tick, empty if not measured.
std::string lines_of(const std::vector<Verdict>& verdicts, const std::string& config);

/// The quantile of the pairs' worst readings at `share`, 0 to 1; 0 if there are none.
double quantile_of(const std::vector<Verdict>& verdicts, Measure measure, double share);

}  // namespace detent_manifolds
