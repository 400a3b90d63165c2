#pragma once
#include "tests/campaigns/joint_fuzz/verdict.h"

namespace detent_joint_fuzz {

/// Tables of the scenes by kind, with and without gravity, and by the type of their joints; and the worst scenes that
/// gain energy. As Markdown or for a terminal.
std::string tables_of(const std::vector<Verdict>& verdicts, bool markdown);

/// One line for each scene: configuration, seed, kind, types, bodies, joints, gravity, growth, rise, saturations, gap
/// (m, rad), substeps, ns, mass ratio, speed of the fastest anchor at the start (m/s), longest arm over its body's
/// size, first tick of growth or 0.
std::string lines_of(const std::vector<Verdict>& verdicts, const std::string& config);

/// The scenes that gain energy, worst first, at most `count`.
std::string worst_of(const std::vector<Verdict>& verdicts, uint32_t count);

}  // namespace detent_joint_fuzz
