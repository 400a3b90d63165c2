#pragma once
#include <functional>

#include "engine.h"

namespace detent_tool {

/// Whether this system has processes that begin as copies of their parent.
bool can_fork();

/// Verifies each file in a process of its own, `jobs` at a time. A file that crashes its process is reported as bad.
/// `done` is called in this process, in the order in which the files are finished.
void verify_in_workers(const std::vector<std::string>& paths, uint32_t jobs,
                       const std::function<Outcome(const std::string&, const Progress&)>& verify,
                       const std::function<void(const std::string&, const Outcome&)>& done);

}  // namespace detent_tool
