#pragma once
#include <memory>
#include <string>

#include "tests/bench/world/studies.h"

namespace detent_bench {

/// The motion that a study compares with.
struct Reference {
  std::vector<States> states;  ///< after each tick that is compared
  double uncertainty = 0;      ///< m: the error of states computed by steps of twice the length; 0 if exact
};

/// Null if the build lacks the engine that computes it; `problem` says so.
std::unique_ptr<Reference> make_reference(const WorldStudy& study, const Stage& stage, const WorldEngineList& engines,
                                          std::string& problem);

}  // namespace detent_bench
