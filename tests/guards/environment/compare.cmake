# cmake -DREFERENCE=<command> -DTRIED=<command> -P compare.cmake
# Runs both, and fails unless they succeed and print the same.

cmake_minimum_required(VERSION 3.25)

foreach(run REFERENCE TRIED)
  execute_process(COMMAND ${${run}} OUTPUT_VARIABLE ${run}_text RESULT_VARIABLE result)
  if(NOT result STREQUAL "0" OR ${run}_text STREQUAL "")
    message(FATAL_ERROR "${${run}}: ended with '${result}':\n${${run}_text}")
  endif()
  string(REGEX MATCHALL "[^\n]+" ${run}_lines "${${run}_text}")
endforeach()

foreach(expected actual IN ZIP_LISTS REFERENCE_lines TRIED_lines)
  if(NOT actual STREQUAL expected)
    message(FATAL_ERROR "${TRIED}:\n  ${actual}\nexpected:\n  ${expected}")
  endif()
endforeach()
