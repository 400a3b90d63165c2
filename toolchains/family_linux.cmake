include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# detent_linux_target(<name> <triple> <processor>): a Linux cross compiler. Programs are static, so that an emulator needs no
# files of that machine. What foreign-packages unpacked into build/packages is found too.
macro(detent_linux_target name triple processor)
  detent_target(${name})
  detent_compilers(${triple}-gcc ${triple}-g++)
  detent_cross(Linux ${processor} "")
  set(CMAKE_FIND_ROOT_PATH /usr/${triple} ${DETENT_TOOLCHAINS}/../build/packages/${name})
  set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
endmacro()
