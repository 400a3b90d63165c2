# Compile options of everything in the project, and the function that declares a floor of the library.

if(DETENT_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "detent: DETENT_FUZZ needs clang and its libFuzzer")
  endif()
  set(DETENT_SANITIZE ON)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(DETENT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined,float-cast-overflow -fno-sanitize=vptr  # there is no RTTI
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

add_library(detent_options INTERFACE)
target_compile_features(detent_options INTERFACE cxx_std_20)
target_compile_options(detent_options INTERFACE
  -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
  -Wno-float-conversion -Wno-implicit-float-conversion)  # a literal meant for f32 as for f64 is rounded
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(detent_options INTERFACE -Werror)  # a newer compiler's warning does not break a user's build
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86)$")
  target_compile_options(detent_options INTERFACE -msse2 -mfpmath=sse)  # x87 rounds to 64 bits
endif()
# GCC 12 with -flto drops stores that are read: where a function only passes parts of *p by value to a function that touches no
# memory, the pass ipa-modref counts *p as never read. At -Os create_body() refuses every body then: in make_motion() a
# product is never computed, for the comparison after it passes its components by value. GCC 11 is right; no later version is
# known to be mended.
string(TOUPPER "CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}" detent_build_flags)
get_directory_property(detent_directory_flags COMPILE_OPTIONS)
if("${CMAKE_CXX_FLAGS} ${${detent_build_flags}} ${detent_directory_flags}" MATCHES "-flto")
  set(detent_lto 1)
else()
  set(detent_lto "$<OR:$<BOOL:$<TARGET_PROPERTY:INTERPROCEDURAL_OPTIMIZATION>>,\
$<BOOL:$<TARGET_PROPERTY:INTERPROCEDURAL_OPTIMIZATION_$<UPPER_CASE:$<CONFIG>>>>>")
endif()
target_compile_options(detent_options INTERFACE
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>,${detent_lto}>:-fno-ipa-modref>)
# GCC's register allocator may compute a value again where it is read instead of keeping it (-flra-remat), also by an instruction
# that has a second result, and then takes that result's register from whatever is in it: a 64-bit product on a Cortex-M3 overwrote
# another number. Two 32-bit halves of a product are one instruction on every Arm, of 64-bit halves on x86-64 with BMI2.
target_compile_options(detent_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-lra-remat>)

# What the library's own objects need beyond that: nothing but the compiler's support routines.
add_library(detent_library_options INTERFACE)
target_link_libraries(detent_library_options INTERFACE detent_options)
target_compile_options(detent_library_options INTERFACE
  -fno-threadsafe-statics -fno-asynchronous-unwind-tables -fno-unwind-tables -ffunction-sections -fdata-sections
  $<$<NOT:$<BOOL:${DETENT_SANITIZE}>>:-fno-strict-overflow>)  # which would hide overflow from the sanitizer
# What they hoist and reorder is kept in registers that Arm's small cores have not: it is spilled.
target_compile_options(detent_library_options INTERFACE
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:MinSizeRel>>:-fno-move-loop-invariants;-fno-schedule-insns2>")
if(WIN32)
  # On Windows GCC takes an inline function's own copy for the one that the linker keeps, and trusts the registers that copy
  # leaves alone. The one kept may be a user's, compiled at another level.
  target_compile_options(detent_library_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-ipa-ra>)
endif()
if(DETENT_PORTABLE_WIDE)
  target_compile_definitions(detent_library_options INTERFACE DETENT_PORTABLE_WIDE=1)
endif()
set(DETENT_TOI_METHOD "" CACHE STRING "How time_of_impact() moves along an axis, if not as is best: paper, first_order, second_order, corotating, world_space or constant_angular_velocity")
if(DETENT_TOI_METHOD)
  target_compile_definitions(detent_library_options INTERFACE DETENT_TOI_METHOD=${DETENT_TOI_METHOD})
endif()
if(DETENT_VERIFY)
  target_compile_definitions(detent_library_options INTERFACE DETENT_VERIFY=1)
endif()

# A floor is compiled in about the time of one of its files. Apart, only what changed is compiled again, and a linker without
# --gc-sections can leave files out.
option(DETENT_UNITY "Compile each floor of the library as one translation unit" ON)

# detent_library(<target> <export name>): a static library, compiled as the library is.
function(detent_library target export_name)
  add_library(${target} STATIC)
  add_library(detent::${export_name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name} OUTPUT_NAME ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/lib)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:detent_library_options>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${DETENT_UNITY} UNITY_BUILD_MODE GROUP)
endfunction()

foreach(config IN LISTS DETENT_CONFIGS)
  if(NOT config IN_LIST DETENT_ALL_CONFIGS)
    message(FATAL_ERROR "detent: unknown configuration '${config}'; choose from: ${DETENT_ALL_CONFIGS}")
  endif()
  string(TOUPPER ${config} upper)
  detent_library(detent_${config} ${config})
  target_compile_definitions(detent_${config} PUBLIC DETENT_${upper}=1)
  target_include_directories(detent_${config} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
endforeach()
if(NOT DETENT_CONFIG IN_LIST DETENT_CONFIGS)
  message(FATAL_ERROR "detent: DETENT_CONFIG is '${DETENT_CONFIG}', which DETENT_CONFIGS (${DETENT_CONFIGS}) does not build")
endif()
add_library(detent::detent ALIAS detent_${DETENT_CONFIG})

# detent_floor(<sources>...): a floor of the library, compiled once for each configuration. Its folder is its name; it may
# include its own folder and the floors listed before it in lib/CMakeLists.txt (held by tests/guards/floors).
function(detent_floor)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME floor)
  set(unit ${floor})
  if(DEFINED detent_unit_of_${floor})
    set(unit ${detent_unit_of_${floor}})
  endif()
  set_source_files_properties(${sources} DIRECTORY ${PROJECT_SOURCE_DIR} PROPERTIES UNITY_GROUP ${unit})
  foreach(config IN LISTS DETENT_CONFIGS)
    target_sources(detent_${config} PRIVATE ${sources})
  endforeach()
endfunction()

# detent_library_beside(<name> <sources>...): a floor that is a library of its own in each configuration, for who asks for it:
# detent::<name>_<config>, and detent::<name> for the default one.
function(detent_library_beside name)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  set_source_files_properties(${sources} PROPERTIES UNITY_GROUP ${name})
  foreach(config IN LISTS DETENT_CONFIGS)
    detent_library(detent_${name}_${config} ${name}_${config})
    target_link_libraries(detent_${name}_${config} PUBLIC detent_${config})
    target_sources(detent_${name}_${config} PRIVATE ${sources})
  endforeach()
  add_library(detent::${name} ALIAS detent_${name}_${DETENT_CONFIG})
endfunction()

# detent_per_config(<name> <sources>...): an object library <name>_<config> for each configuration, that sees the public
# headers, lib/ and the repository's root; for adapters, scenes and tests that are compiled once per configuration.
function(detent_per_config name)
  foreach(config IN LISTS DETENT_CONFIGS)
    add_library(${name}_${config} OBJECT ${ARGN})
    target_link_libraries(${name}_${config} PUBLIC detent_${config} PRIVATE detent_options)
    target_include_directories(${name}_${config} PRIVATE ${PROJECT_SOURCE_DIR}/lib ${PROJECT_SOURCE_DIR})
  endforeach()
endfunction()

# Targets whose arithmetic is not IEEE-correct are refused here, with the reason, and not special-cased anywhere.

if("f64" IN_LIST DETENT_CONFIGS AND DETENT_SOFT_DOUBLE_FAULT)
  message(FATAL_ERROR "detent: f64 is refused on this target: its compiler's soft double addition (__aeabi_dadd) rounds "
    "wrongly at an exponent gap of 33, so the digests would differ. Leave f64 out of DETENT_CONFIGS.")
endif()
