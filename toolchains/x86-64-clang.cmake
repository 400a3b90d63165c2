include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
detent_target(x86-64-clang)
detent_compilers(clang clang++)
