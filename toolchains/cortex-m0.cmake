include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
# At -O2 its products of 64 and 128 bits, which it has no instruction for, fill the board's flash. The two optimisations
# that are switched off add 1.5 KB.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -fno-expensive-optimizations -fno-tree-loop-im -DNDEBUG" CACHE STRING "")
detent_cortex_m_target(cortex-m0 "-mcpu=cortex-m0 -mfloat-abi=soft" ROM 0x00000000 256K RAM 0x20000000 16K)
