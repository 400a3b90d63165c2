# cmake -DROOT=<folder> -P offend.cmake
# Makes a small repository that breaks each rule once, and checks it.

file(REMOVE_RECURSE ${ROOT})
file(WRITE ${ROOT}/lib/CMakeLists.txt "add_subdirectory(base)\nadd_subdirectory(world)\n")
file(WRITE ${ROOT}/lib/base/low.h "#include \"world/high.h\"\n")
file(WRITE ${ROOT}/lib/base/near.cpp "#include \"low.h\"\n")
file(WRITE ${ROOT}/lib/base/words.cpp "// new in a comment is none\nauto made = new int;\n")
file(WRITE ${ROOT}/lib/world/high.h "#include \"ports/machine.h\"\n#include \"base/low.h\"\n")
file(WRITE ${ROOT}/lib/cellar/odd.h "")
file(WRITE ${ROOT}/include/detent/front.h "#include <math.h>\n#include <stdint.h>\n#include \"base/low.h\"\n")
file(WRITE ${ROOT}/ports/host/tool.h "#include \"tests/common/support/test.h\"\n#include \"examples/scenes/scene.h\"\n")
file(WRITE ${ROOT}/ports/host/tool.cpp "#include \"ports/host/tool.h\"\n#include \"examples/game/game.h\"\n")
file(WRITE ${ROOT}/examples/game/game.h "#include <tests/common/support/test.h>\n#include \"examples/scenes/scene.h\"\n")
file(WRITE ${ROOT}/examples/game/game.cpp "#include \"../../tests/common/support/test.h\"\n// tests/common/support\n")
include(${CMAKE_CURRENT_LIST_DIR}/check_floors.cmake)
