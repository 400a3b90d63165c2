# DETENT_SCENE_ASSETS: the source of scene_assets(); DETENT_SCENE_SOURCES: that and what makes scenes(), for targets that see
# the repository's root and compile them with options of their own. Others take the objects of detent_scenes_<config>.
set(assets "")
set(table "")
foreach(file assets/valley.mesh assets/hills.field assets/round.hull assets/dumbbell.compound)
  cmake_path(GET file FILENAME name)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_LIST_DIR} NORMALIZE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REPLACE "." "_" name ${name})
  string(APPEND assets "alignas(8) constexpr uint8_t k_${name}[] = {${bytes}};\n")
  string(APPEND table "{k_${name}, sizeof k_${name}}, ")
endforeach()
set(DETENT_SCENE_ASSETS ${PROJECT_BINARY_DIR}/scene_assets.cpp)
file(CONFIGURE OUTPUT ${DETENT_SCENE_ASSETS} @ONLY CONTENT "#include \"examples/scenes/scene.h\"
namespace {
@assets@}
namespace detent {
inline namespace DETENT_NAMESPACE {
AssetTable scene_assets() {
  static constexpr Asset table[] = {@table@};
  return {table, sizeof table / sizeof table[0]};
}
}
}
")
set(DETENT_SCENE_SOURCES
  ${DETENT_SCENE_ASSETS}
  ${CMAKE_CURRENT_LIST_DIR}/terrain.cpp
  ${CMAKE_CURRENT_LIST_DIR}/scenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/piles.cpp
  ${CMAKE_CURRENT_LIST_DIR}/traffic.cpp
  ${CMAKE_CURRENT_LIST_DIR}/changes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/jointed.cpp
  ${CMAKE_CURRENT_LIST_DIR}/../billiards/billiards.cpp
  ${CMAKE_CURRENT_LIST_DIR}/../dominoes/dominoes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/../rollback/game.cpp)

if(NOT TARGET detent_scenes_${DETENT_CONFIG})
  detent_per_config(detent_scenes ${DETENT_SCENE_SOURCES})
  foreach(config IN LISTS DETENT_CONFIGS)
    set_target_properties(detent_scenes_${config} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0 EXCLUDE_FROM_ALL ON)
  endforeach()
endif()
