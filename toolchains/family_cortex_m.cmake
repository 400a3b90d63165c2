include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# detent_cortex_m_target(<name> <core flags> ROM <origin> <bytes> RAM <origin> <bytes> [VECTORS <origin> <bytes>]
# [SOFT_DOUBLE_FAULT]): a Cortex-M core on the board that the table's emulator names. ROM and RAM are the board's, for the
# linker script of ports/bare. VECTORS: the memory that the core starts from, where that is not ROM.
# SOFT_DOUBLE_FAULT: libgcc's double addition for this core rounds wrongly (see lib/detent.cmake).
macro(detent_cortex_m_target name flags)
  cmake_parse_arguments(detent_board SOFT_DOUBLE_FAULT "" "ROM;RAM;VECTORS" ${ARGN})
  detent_target(${name})
  detent_compilers(arm-none-eabi-gcc arm-none-eabi-g++)
  detent_cross(Generic arm "-mthumb ${flags}")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles --specs=nano.specs --specs=nosys.specs")
  set(DETENT_PORT cortex_m)
  set(DETENT_ROM ${detent_board_ROM})
  set(DETENT_RAM ${detent_board_RAM})
  set(DETENT_VECTORS ${detent_board_VECTORS})
  set(DETENT_SOFT_DOUBLE_FAULT ${detent_board_SOFT_DOUBLE_FAULT})
endmacro()
