include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
detent_target(wasm32)
detent_compilers(clang clang++)
detent_cross(Generic wasm32 "")  # CMake knows no WASI
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# The linker's own stack is 64 KB and overflows into data in silence: a larger one, placed where an overflow traps.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-z,stack-size=1048576 -Wl,--stack-first")
