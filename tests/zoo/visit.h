#pragma once
#include "tests/zoo/list.h"
#include "tests/zoo/watch.h"

/// Plays a scene of the list to its end, or until it flies apart, and judges it.
namespace detent_zoo {

struct Verdict {
  std::string problem;  ///< why it could not be played, or nothing
  Figures figures;
  std::string gap_joint;              ///< the bodies of the joint that opened most
  std::string sunk_body, moved_body;  ///< that sank and moved most
  std::set<std::string> failed;       ///< the checks that do not hold
};
Verdict visit(const Entry& entry, const Engine& engine, const std::string& folder);

/// What a check measured; `rest`: over what is allowed.
double measured(const Figures& figures, const std::string& check);
/// What fails or holds against the list, a line each; nothing if it is as the list says.
std::string surprises(const Entry& entry, const char* config, const Verdict& verdict);

}  // namespace detent_zoo
