include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(i686 i686-linux-gnu i686)
