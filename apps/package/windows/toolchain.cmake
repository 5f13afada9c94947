# Debian's cross-compiler for 64-bit Windows (MinGW-w64, with threads of POSIX, as std::thread and oneTBB need).
# ASHLAR_WINDOWS_LIBRARIES is the folder that build_libraries.sh has filled.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(ashlar_triple x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${ashlar_triple}-gcc-posix)
set(CMAKE_CXX_COMPILER ${ashlar_triple}-g++-posix)
set(CMAKE_RC_COMPILER ${ashlar_triple}-windres)
set(CMAKE_AR ${ashlar_triple}-gcc-ar-posix CACHE FILEPATH "")
set(CMAKE_RANLIB ${ashlar_triple}-gcc-ranlib-posix CACHE FILEPATH "")

# No package of this system is found by mistake; interpreters are its own.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ASHLAR_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH "${ASHLAR_WINDOWS_LIBRARIES}" /usr/${ashlar_triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}/cmake")

# Sources with many templates have more sections than the older format of objects can number.
set(CMAKE_C_FLAGS_INIT "-isystem ${ASHLAR_WINDOWS_LIBRARIES}/include")
set(CMAKE_CXX_FLAGS_INIT "-isystem ${ASHLAR_WINDOWS_LIBRARIES}/include -Wa,-mbig-obj")
# The program needs no other file: the compiler's libraries are in it too.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -L${ASHLAR_WINDOWS_LIBRARIES}/lib")

# Tests run in Wine where it is installed.
find_program(ASHLAR_WINE NAMES wine)
if(ASHLAR_WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${ASHLAR_WINE}")
endif()
