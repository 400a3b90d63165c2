include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(aarch64 aarch64-linux-gnu aarch64)
