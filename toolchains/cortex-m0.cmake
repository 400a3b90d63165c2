include(${CMAKE_CURRENT_LIST_DIR}/family_cortex_m.cmake)
# At -O2 its products of 64 and 128 bits, which it has no instruction for, fill the board's flash.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG" CACHE STRING "")
# Without these options the program with all features (tests/guards/size) is 3 KB larger.
set(small "-fno-expensive-optimizations -fno-tree-loop-im -fira-loop-pressure -fno-early-inlining -fno-forward-propagate")
string(APPEND small " -fno-partial-inlining -fno-tree-scev-cprop -fsplit-wide-types-early")
string(APPEND small " --param=large-function-insns=1000")
detent_cortex_m_target(cortex-m0 "-mcpu=cortex-m0 -mfloat-abi=soft ${small}"
  ROM 0x00000000 256K RAM 0x20000000 16K)
