include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(riscv64 riscv64-linux-gnu riscv64)
