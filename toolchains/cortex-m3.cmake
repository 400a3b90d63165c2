include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
detent_cortex_m_target(cortex-m3 "-mcpu=cortex-m3 -mfloat-abi=soft" ROM 0x00000000 4M RAM 0x20000000 4M SOFT_DOUBLE_FAULT)
