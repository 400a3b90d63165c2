# What `cmake --install` puts under a prefix: the headers, the library of every built configuration, what find_package and
# pkg-config read, and with DETENT_TOOLS the tool, the pages and the schema of scenes. Nothing in it names the prefix, so an
# installed tree can be moved.

option(DETENT_INSTALL "Make the rules that install the library" ${PROJECT_IS_TOP_LEVEL})
if(NOT DETENT_INSTALL)
  return()
endif()

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/detent DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET detent_tool)
  install(TARGETS detent_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  file(GLOB detent_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.schema.json)
  install(FILES ${detent_pages} DESTINATION ${CMAKE_INSTALL_DOCDIR})
  # The pages of `detent view`, if ports/web/build has made them.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/web/view/ DESTINATION ${CMAKE_INSTALL_DATADIR}/detent/view OPTIONAL)
endif()

set(detent_libraries "")
foreach(config IN LISTS DETENT_CONFIGS)
  list(APPEND detent_libraries detent_${config} detent_toi_methods_${config})
endforeach()
install(TARGETS ${detent_libraries} EXPORT detent_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(detent_cmake_directory ${CMAKE_INSTALL_LIBDIR}/cmake/detent)
install(EXPORT detent_targets FILE detent-targets.cmake NAMESPACE detent:: DESTINATION ${detent_cmake_directory})
configure_file(${CMAKE_CURRENT_LIST_DIR}/detent-config.cmake.in detent-config.cmake @ONLY)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/detent-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/detent-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/detent-config-version.cmake
  DESTINATION ${detent_cmake_directory})

set(detent_pkgconfig_directory ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH detent_pkgconfig_to_include ${detent_pkgconfig_directory} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
# detent_install_pkgconfig(<name> <config>): <name>.pc, which stands for the library of one configuration.
function(detent_install_pkgconfig name config)
  string(TOUPPER ${config} upper)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/detent.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
detent_install_pkgconfig(detent ${DETENT_CONFIG})
foreach(config IN LISTS DETENT_CONFIGS)
  detent_install_pkgconfig(detent-${config} ${config})
endforeach()
