include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(powerpc64 powerpc64-linux-gnu ppc64)
