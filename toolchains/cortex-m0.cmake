include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
# At -O2 its products of 64 and 128 bits, which it has no instruction for, fill the board's flash.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG" CACHE STRING "")
# The optimisations that are switched off take 1.5 KB of the program with all features (tests/guards/size).
detent_cortex_m_target(cortex-m0 "-mcpu=cortex-m0 -mfloat-abi=soft -fno-expensive-optimizations -fno-tree-loop-im"
  ROM 0x00000000 256K RAM 0x20000000 16K)
