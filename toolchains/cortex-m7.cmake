include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
detent_cortex_m_target(cortex-m7 "-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard" ROM 0x00000000 4M RAM 0x20000000 4M)
