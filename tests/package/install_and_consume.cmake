# Run by CTest with -D: ASHLAR_BUILD, CONFIG, CONSUMER_SOURCE, WORK, GENERATOR, C, CXX.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${ASHLAR_BUILD}" --config "${CONFIG}" --prefix "${WORK}/prefix"
  COMMAND_ERROR_IS_FATAL ANY)

# Installed headers find each other by <ashlar/...> alone, need no library but Eigen, and none is internal.
file(GLOB_RECURSE headers "${WORK}/prefix/include/*")
foreach(expected ashlar/geometry.hpp ashlar/mechanics.hpp ashlar/solver.hpp ashlar/scene.hpp ashlar/results.hpp
    ashlar/run.hpp ashlar/geometry/solid/polyhedron.hpp ashlar/run/run.hpp)
  if(NOT "${WORK}/prefix/include/${expected}" IN_LIST headers)
    message(SEND_ERROR "${expected} is not installed")
  endif()
endforeach()
foreach(header IN LISTS headers)
  file(STRINGS "${header}" internal REGEX "[Oo]nly sources of this layer")
  if(internal)
    message(SEND_ERROR "an internal header is installed: ${header}")
  endif()
  file(STRINGS "${header}" includes REGEX "^[ \t]*#[ \t]*include")
  foreach(include IN LISTS includes)
    if(include MATCHES "<ashlar/(.*)>")
      if(NOT EXISTS "${WORK}/prefix/include/ashlar/${CMAKE_MATCH_1}")
        message(SEND_ERROR "${header}: ${include} is not installed")
      endif()
    elseif(NOT include MATCHES "<([a-z_]+|Eigen/[A-Za-z]+)>")
      message(SEND_ERROR "${header}: ${include} is neither of ashlar nor of Eigen nor of the standard library")
    endif()
  endforeach()
endforeach()

foreach(step
    "${CMAKE_COMMAND};-S;${CONSUMER_SOURCE};-B;${WORK}/build;-G;${GENERATOR};-DCMAKE_BUILD_TYPE=${CONFIG};-DCMAKE_C_COMPILER=${C};-DCMAKE_CXX_COMPILER=${CXX};-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "${CMAKE_COMMAND};--build;${WORK}/build;--config;${CONFIG}"
    "${CMAKE_CTEST_COMMAND};--test-dir;${WORK}/build;--build-config;${CONFIG};--output-on-failure;--no-tests=error")
  execute_process(COMMAND ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(NOT EXISTS "${WORK}/build/pier.out/summary.json")
  message(SEND_ERROR "the consumer has written no results")
endif()

# The same without CMake.
find_program(PKG_CONFIG pkg-config)
if(NOT PKG_CONFIG)
  message(STATUS "no pkg-config")
  return()
endif()
file(GLOB_RECURSE package "${WORK}/prefix/*/ashlar.pc")
get_filename_component(package "${package}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${package}")
execute_process(COMMAND "${PKG_CONFIG}" --cflags --libs ashlar OUTPUT_VARIABLE flags
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
execute_process(COMMAND "${CXX}" -std=c++20 "${CONSUMER_SOURCE}/pier.cpp" ${flags} -o "${WORK}/pier"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/pier" "${CONSUMER_SOURCE}/pier.toml" "${WORK}/pier.out"
  OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said MATCHES "-120 kPa.*-220 kPa")
  message(SEND_ERROR "built by pkg-config: ${said}")
endif()
