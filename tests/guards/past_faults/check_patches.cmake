# cmake -DROOT=<repository> -P check_patches.cmake
# Fails if a fault of the past can no longer be put back: its patch does not apply to the sources as they are. Changes nothing.

cmake_minimum_required(VERSION 3.25)

find_program(patch_program patch)
if(NOT patch_program)
  message(STATUS "patches: the program `patch` is not installed")
  return()
endif()
file(GLOB patches RELATIVE ${ROOT} ${ROOT}/tests/guards/past_faults/patches/*.patch)
list(LENGTH patches count)
set(faults "")
foreach(path IN LISTS patches)
  execute_process(COMMAND ${patch_program} --dry-run --force --silent -p1 -i ${ROOT}/${path}
    WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(NOT result EQUAL 0)
    list(APPEND faults ${path})
  endif()
endforeach()
if(faults OR count EQUAL 0)
  list(JOIN faults "\n  " text)
  message(FATAL_ERROR "of ${count} patches these do not apply:\n  ${text}")
endif()
message(STATUS "${count} patches apply")
