#include <wasi/api.h>

#include "desk.h"

// A module has no console, to which the C library would write of a fault of its own. Without these definitions it would
// import them from a system.
extern "C" {
__wasi_errno_t __wasi_fd_close(__wasi_fd_t) { return __WASI_ERRNO_BADF; }
__wasi_errno_t __wasi_fd_seek(__wasi_fd_t, __wasi_filedelta_t, __wasi_whence_t, __wasi_filesize_t*) {
  return __WASI_ERRNO_BADF;
}
__wasi_errno_t __wasi_fd_write(__wasi_fd_t, const __wasi_ciovec_t*, size_t, __wasi_size_t*) {
  return __WASI_ERRNO_BADF;
}
}

/// Called once before any other function. Without it the linker would make each function construct and destroy all
/// static objects.
extern "C" void __wasm_call_ctors();
DETENT_WEB(_initialize) void initialize() { __wasm_call_ctors(); }
