# cmake -DDOXYGEN=<program> -DROOT=<repository> -DOUT=<folder> -P reference.cmake
# Makes the API reference in OUT/html. Fails if a public name has no docstring, or a docstring refers to what is not there.

cmake_minimum_required(VERSION 3.25)

if(NOT DOXYGEN)
  message(FATAL_ERROR "reference: Doxygen is not installed")
endif()

file(REMOVE_RECURSE ${OUT})
file(WRITE ${OUT}/Doxyfile "@INCLUDE = ${CMAKE_CURRENT_LIST_DIR}/Doxyfile\nOUTPUT_DIRECTORY = ${OUT}\n")
execute_process(COMMAND ${DOXYGEN} ${OUT}/Doxyfile WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE code)

# Doxygen does not ask for docstrings of an enumeration's values.
file(READ ${OUT}/xml/namespacedetent.xml text)
string(REGEX REPLACE "[][;]" "" text "${text}")
string(REGEX MATCHALL "<name>[^<]*</name>[^<]*(<initializer>[^<]*</initializer>[^<]*)?<briefdescription>[^<]*</briefdescription>[^<]*<detaileddescription>[^<]*</detaileddescription>[^<]*</enumvalue>"
  undocumented "${text}")
list(TRANSFORM undocumented REPLACE "<name>([^<]*)</name>.*" "warning: value \\1 is not documented")
list(JOIN undocumented "\n" faults)
if(code OR undocumented)
  message(FATAL_ERROR "reference: see the warnings\n${faults}")
endif()
message(STATUS "reference: ${OUT}/html/index.html")
