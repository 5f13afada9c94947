# Run by CTest with -D: ASHLAR_BUILD, CONFIG, CONSUMER_SOURCE, WORK, GENERATOR, C, CXX.
file(REMOVE_RECURSE "${WORK}")
foreach(step
    "${CMAKE_COMMAND};--install;${ASHLAR_BUILD};--config;${CONFIG};--prefix;${WORK}/prefix"
    "${CMAKE_COMMAND};-S;${CONSUMER_SOURCE};-B;${WORK}/build;-G;${GENERATOR};-DCMAKE_BUILD_TYPE=${CONFIG};-DCMAKE_C_COMPILER=${C};-DCMAKE_CXX_COMPILER=${CXX};-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "${CMAKE_COMMAND};--build;${WORK}/build;--config;${CONFIG}"
    "${CMAKE_CTEST_COMMAND};--test-dir;${WORK}/build;--build-config;${CONFIG};--output-on-failure;--no-tests=error")
  execute_process(COMMAND ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
