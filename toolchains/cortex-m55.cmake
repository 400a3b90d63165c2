include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
# The vector unit's float operations flush denormals to zero, whatever the mode, and the compiler uses them at -O2: leave
# them out (nomve.fp). Its integer operations are exact, but GCC 12 ends in internal errors where it puts them in by itself.
# The core starts in its 512 KB of tightly coupled memory; programs with all features are larger at -O2.
detent_cortex_m_target(cortex-m55 "-mcpu=cortex-m55+nomve.fp -mfpu=auto -mfloat-abi=hard -fno-tree-vectorize"
  ROM 0x01000000 2M RAM 0x20000000 512K VECTORS 0x00000000 512K)
