# cmake -DROOT=<repository> -DWORDS=<retired_words.csv> -P check_words.cmake
# Fails if the library, the examples or the documents use a retired word: alone, or between underscores of a name. Pages that
# a program writes with the names of scenes and tests are left out.

cmake_minimum_required(VERSION 3.25)

file(STRINGS ${WORDS} rows)
list(POP_FRONT rows)
set(words "")
foreach(row IN LISTS rows)
  string(REGEX REPLACE ",.*" "" word ${row})
  list(APPEND words ${word})
  string(REGEX REPLACE "^[^,]*," "" instead_of_${word} ${row})
endforeach()
list(JOIN words "|" any)

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/include/*.h ${ROOT}/lib/*.h ${ROOT}/lib/*.cpp ${ROOT}/examples/*.h
  ${ROOT}/examples/*.cpp ${ROOT}/docs/design/*.md)
file(GLOB pages RELATIVE ${ROOT} ${ROOT}/*.md ${ROOT}/docs/*.md)
list(APPEND files ${pages})
list(FILTER files EXCLUDE REGEX "^(CHANGELOG|docs/(zoo|stability|testing|mutation|past_faults))\\.md$")
list(LENGTH files count)

set(faults "")
foreach(path IN LISTS files)
  file(READ ${ROOT}/${path} text)
  if(" ${text} " MATCHES "[^a-zA-Z0-9](${any})[^a-zA-Z0-9]")
    set(found ${CMAKE_MATCH_1})
    foreach(word IN LISTS words)
      if(found MATCHES "^(${word})$")
        list(APPEND faults "${path} says '${found}': ${instead_of_${word}}")
      endif()
    endforeach()
  endif()
endforeach()

list(JOIN faults "\n  " text)
if(faults)
  message(FATAL_ERROR "${count} files:\n  ${text}")
endif()
message(STATUS "${count} files use no retired word")
