include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
detent_target(rv32imac)
# No C++ library exists for this target, so the C driver links.
detent_compilers(riscv64-unknown-elf-gcc riscv64-unknown-elf-gcc)
# Naming zicsr in -march, as a newer -misa-spec demands, would silently pick the 64-bit libgcc.
detent_cross(Generic riscv32 "--specs=picolibc.specs -march=rv32imac -mabi=ilp32 -misa-spec=2.2 -mcmodel=medany")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_EXE_LINKER_FLAGS_INIT -nostartfiles)
set(DETENT_PORT riscv)
# The board has one memory; its first half plays the flash.
set(DETENT_ROM 0x80000000 4M)
set(DETENT_RAM 0x80400000 4M)
