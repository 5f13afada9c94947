# WebAssembly, by Debian's clang with the options of Debian's emscripten, whose em++ links programs. em++ does not compile:
# it is a program in Python, which takes a second a source.
# ASHLAR_BROWSER_LIBRARIES is the folder that build_libraries.sh has filled.
# Libraries without CMake files are found as those for Windows are.
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}/cmake" "${CMAKE_CURRENT_LIST_DIR}/../windows/cmake")
set(CMAKE_SYSTEM_NAME Emscripten)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_C_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_CXX_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_SYSROOT /usr/share/emscripten/cache/sysroot)
set(CMAKE_AR llvm-ar CACHE FILEPATH "")
set(CMAKE_RANLIB llvm-ranlib CACHE FILEPATH "")

# Programs of CMake's own checks are compiled, not linked.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# No package of this system is found by mistake; interpreters are its own.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ASHLAR_BROWSER_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH "${ASHLAR_BROWSER_LIBRARIES}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(ashlar_wasm "-mllvm -combiner-global-alias-analysis=false -mllvm -enable-emscripten-sjlj -mllvm -disable-lsr")
set(ashlar_wasm "${ashlar_wasm} -Xclang -iwithsysroot/include/compat -isystem ${ASHLAR_BROWSER_LIBRARIES}/include")
set(CMAKE_C_FLAGS_INIT "${ashlar_wasm}")
# Vectors, with as many registers as Eigen has on 64-bit PCs: its products have the same order there. Eigen's alone:
# build_libraries.sh says what clang does with others.
set(ashlar_wasm "${ashlar_wasm} -msimd128 -fno-vectorize -fno-slp-vectorize -DEIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS=16")
set(ashlar_wasm_cxx "-D_LIBCPP_ABI_VERSION=2 -fno-threadsafe-statics -fwasm-exceptions")
set(CMAKE_CXX_FLAGS_INIT "${ashlar_wasm} ${ashlar_wasm_cxx} -include ${CMAKE_CURRENT_LIST_DIR}/missing_names.hpp")
# Memory as far as 32 bits reach, and twice the stack that a thread has in Linux. node has packages of Debian in a folder of
# its own.
set(ashlar_link "env NODE_PATH=/usr/share/nodejs em++ -fwasm-exceptions -O2 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB")
set(ashlar_link "${ashlar_link} -sINITIAL_MEMORY=64MB -sTOTAL_STACK=16MB -L${ASHLAR_BROWSER_LIBRARIES}/lib")
foreach(language C CXX)
  set(CMAKE_${language}_LINK_EXECUTABLE
    "${ashlar_link} <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
endforeach()

# Tests run in node, whose own fetch would be asked for the program.
find_program(ASHLAR_NODE NAMES node nodejs)
if(ASHLAR_NODE)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${ASHLAR_NODE};--no-experimental-fetch")
endif()
