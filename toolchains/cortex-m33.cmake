include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
detent_cortex_m_target(cortex-m33 "-mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard"
  ROM 0x10000000 4M RAM 0x38000000 4M SOFT_DOUBLE_FAULT)
