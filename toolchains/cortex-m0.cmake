include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
detent_cortex_m_target(cortex-m0 "-mcpu=cortex-m0 -mfloat-abi=soft" ROM 0x00000000 256K RAM 0x20000000 16K)
