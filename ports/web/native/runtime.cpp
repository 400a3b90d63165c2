#include <wasi/api.h>

#include "desk.h"

// The C library would write its error messages to a console, but a module has no console. Without these definitions,
// the module would import these functions from a system.
extern "C" {
__wasi_errno_t __wasi_fd_close(__wasi_fd_t) { return __WASI_ERRNO_BADF; }
__wasi_errno_t __wasi_fd_seek(__wasi_fd_t, __wasi_filedelta_t, __wasi_whence_t, __wasi_filesize_t*) {
  return __WASI_ERRNO_BADF;
}
__wasi_errno_t __wasi_fd_write(__wasi_fd_t, const __wasi_ciovec_t*, size_t, __wasi_size_t*) {
  return __WASI_ERRNO_BADF;
}
}

/// Called once before any other function. Without this function, the linker would make each function construct and
/// destroy all static objects.
extern "C" void __wasm_call_ctors();
DETENT_WEB(_initialize) void initialize() { __wasm_call_ctors(); }
