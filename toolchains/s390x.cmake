include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(s390x s390x-linux-gnu s390x)
