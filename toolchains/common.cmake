# What every toolchain file shares. A toolchain file includes it, or a family file that does, and names its row of targets.csv.

set(DETENT_TOOLCHAINS ${CMAKE_CURRENT_LIST_DIR})

# detent_target(<name>): reads the target's facts from targets.csv into DETENT_TARGET (its name), DETENT_TARGET_KIND (hosted
# or bare), DETENT_TARGET_CONFIGS (what its arithmetic can build), DETENT_TARGET_BYTE_ORDER and DETENT_TARGET_WORD_BITS; sets the
# emulator that ctest puts before its programs, the first of its configurations as the one to build, ccache where it is
# installed, and -O2. A cache entry or -D of the user wins over each default.
macro(detent_target name)
  file(STRINGS ${DETENT_TOOLCHAINS}/targets.csv detent_row REGEX "^${name},")
  if(NOT detent_row)
    message(FATAL_ERROR "detent: no target '${name}' in ${DETENT_TOOLCHAINS}/targets.csv")
  endif()
  string(REPLACE "," ";" detent_row "${detent_row}")
  set(DETENT_TARGET ${name})
  list(GET detent_row 1 DETENT_TARGET_KIND)
  list(GET detent_row 2 detent_configs)
  list(GET detent_row 3 DETENT_TARGET_BYTE_ORDER)
  list(GET detent_row 4 DETENT_TARGET_WORD_BITS)
  list(GET detent_row 5 detent_emulator)

  string(REPLACE " " ";" DETENT_TARGET_CONFIGS "${detent_configs}")
  list(GET DETENT_TARGET_CONFIGS 0 detent_configs)
  set(DETENT_CONFIG ${detent_configs} CACHE STRING "The configuration that detent::detent stands for")
  find_program(DETENT_CCACHE ccache)
  mark_as_advanced(DETENT_CCACHE)
  if(DETENT_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${DETENT_CCACHE} CACHE STRING "")
  endif()
  set(CMAKE_BUILD_TYPE Release CACHE STRING "")
  set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")

  # In the table a file of this repository is named from the repository's root.
  set(CMAKE_CROSSCOMPILING_EMULATOR "")
  string(REPLACE " " ";" detent_emulator "${detent_emulator}")
  foreach(detent_word IN LISTS detent_emulator)
    if(detent_word MATCHES "/")
      cmake_path(ABSOLUTE_PATH detent_word BASE_DIRECTORY ${DETENT_TOOLCHAINS}/.. NORMALIZE)
    endif()
    list(APPEND CMAKE_CROSSCOMPILING_EMULATOR ${detent_word})
  endforeach()
endmacro()

# detent_compilers(<c compiler> <c++ compiler>): C is for what tests build from source, such as googletest.
macro(detent_compilers c cxx)
  set(CMAKE_C_COMPILER ${c})
  set(CMAKE_CXX_COMPILER ${cxx})
endmacro()

# detent_cross(<system> <processor> <flags>): the compiler's flags for another machine, whose packages are not this one's.
macro(detent_cross system processor flags)
  set(CMAKE_SYSTEM_NAME ${system})
  set(CMAKE_SYSTEM_PROCESSOR ${processor})
  set(CMAKE_C_FLAGS_INIT "${flags}")
  set(CMAKE_CXX_FLAGS_INIT "${flags}")
  set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
  set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
  set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
endmacro()
