include(${CMAKE_CURRENT_LIST_DIR}/family_linux.cmake)
detent_linux_target(i686 i686-linux-gnu i686)

# An x86-64 machine runs its programs, unless the kernel has no 32-bit programs: then an emulator does.
set(detent_probe ${CMAKE_BINARY_DIR}/i686_probe)
if(NOT EXISTS ${detent_probe})
  file(WRITE ${detent_probe}.c "int main(void) { return 0; }\n")
  execute_process(COMMAND ${CMAKE_C_COMPILER} -static -o ${detent_probe} ${detent_probe}.c OUTPUT_QUIET ERROR_QUIET)
endif()
execute_process(COMMAND ${detent_probe} RESULT_VARIABLE detent_code OUTPUT_QUIET ERROR_QUIET)
if(NOT detent_code EQUAL 0)
  set(CMAKE_CROSSCOMPILING_EMULATOR qemu-i386)
endif()
