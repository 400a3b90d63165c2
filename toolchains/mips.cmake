include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(mips mips-linux-gnu mips)
