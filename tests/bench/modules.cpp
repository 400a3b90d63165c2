#include "tests/bench/modules.h"

#include <dlfcn.h>

namespace detent_bench {

void* symbol_of_module(const char* module, const char* symbol, std::string& problem) {
  // A namespace of the linker's for each: the two Bullets have the same names for numbers of other sizes, among them
  // unique symbols (static members of inline functions), which RTLD_LOCAL and RTLD_DEEPBIND do not keep apart.
  void* const handle = dlmopen(LM_ID_NEWLM, module, RTLD_NOW);
  void* const address = handle != nullptr ? dlsym(handle, symbol) : nullptr;
  if (address == nullptr) problem += std::string(problem.empty() ? "" : "\n") + dlerror();
  return address;
}

}  // namespace detent_bench
