# DETENT_SCENE_SOURCES: what makes scenes(), for detent_per_config and other targets that see the repository's root.
set(DETENT_SCENE_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/scenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/piles.cpp
  ${CMAKE_CURRENT_LIST_DIR}/traffic.cpp
  ${CMAKE_CURRENT_LIST_DIR}/changes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/jointed.cpp
  ${CMAKE_CURRENT_LIST_DIR}/../../examples/billiards/billiards.cpp
  ${CMAKE_CURRENT_LIST_DIR}/../../examples/dominoes/dominoes.cpp)
