include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
detent_target(x86-64-gcc)
detent_compilers(gcc g++)
