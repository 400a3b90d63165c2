include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(armhf arm-linux-gnueabihf arm)
