#pragma once
#include "tests/manifolds/measure.h"

namespace detent_manifolds {

/// Tables by kind, shapes and motion: each measure's median, 99th percentile and worst of the pairs' own worst ticks;
/// in how many pairs points were lost, idle or a seam's; and the names that stay. For a terminal, or as Markdown.
std::string tables_of(const std::vector<Verdict>& verdicts, bool markdown);

/// The worst pairs of each measure and kind, with their seeds and ticks, at most `count` of each measure.
std::string worst_of(const std::vector<Verdict>& verdicts, uint32_t count, bool markdown);

/// A line a pair: configuration, seed, kind, motion, shapes, then of each measure the worst and its tick, empty where
/// there is none.
std::string lines_of(const std::vector<Verdict>& verdicts, const std::string& config);

/// Of the pairs' worst readings at a share of their count, 0 to 1; 0 of none.
double quantile_of(const std::vector<Verdict>& verdicts, Measure measure, double share);

}  // namespace detent_manifolds
