#pragma once
#include "tests/campaigns/zoo/list.h"
#include "tests/campaigns/zoo/watch.h"

/// Plays a scene of the list to its end, or until its speed is far beyond the bound, and checks it.
namespace detent_zoo {

struct Verdict {
  std::string problem;  ///< why it could not be played; empty if it could
  Figures figures;
  detent_test::StageTimes stages;     ///< ns, of all ticks
  std::string gap_joint;              ///< the bodies of the joint with the greatest gap
  std::string sunk_body, moved_body;  ///< the bodies that sank and moved most
  std::set<std::string> failed;       ///< the failed checks
};
Verdict visit(const Entry& entry, const Engine& engine, const std::string& folder,
              detent_test::Ground ground = detent_test::Ground::own, const Variation& variation = {});

/// The measured value of a check; for `rest`: relative to the limit.
double measured(const Figures& figures, const std::string& check);
/// The checks that fail unexpectedly or pass although listed as gaps, one line each; empty if as listed.
std::string surprises(const Entry& entry, const char* config, const Verdict& verdict);

}  // namespace detent_zoo
