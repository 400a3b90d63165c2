#pragma once
#include <functional>

#include "engine.h"

namespace detent_tool {

/// Whether this system has processes that begin as copies of their parent.
bool can_fork();

/// Each file in a process of its own, `jobs` at a time: one that brings its process down is told as a bad one. `done`
/// is called here, in the order in which they end.
void verify_in_workers(const std::vector<std::string>& paths, uint32_t jobs,
                       const std::function<Outcome(const std::string&, const Progress&)>& verify,
                       const std::function<void(const std::string&, const Outcome&)>& done);

}  // namespace detent_tool
