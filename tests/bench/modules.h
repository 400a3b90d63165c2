#pragma once
#include <string>

namespace detent_bench {

/// Loads a peer's module and finds what it exports under this name. Null, and a line more in `problem`, if either
/// fails.
void* symbol_of_module(const char* module, const char* symbol, std::string& problem);

}  // namespace detent_bench
