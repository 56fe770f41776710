# SPDX-License-Identifier: MIT
# What .ci/run checks beyond the tests, as CTest entries of the configuration `checks` (`ctest -C checks`), so that a
# plain `ctest` needs neither the tools nor the time.
function(boxwood_check name)
  cmake_parse_arguments(PARSE_ARGV 1 check "" "TIMEOUT;PROCESSORS" "COMMAND")
  add_test(NAME ${name} CONFIGURATIONS checks COMMAND ${check_COMMAND} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS check TIMEOUT ${check_TIMEOUT} PROCESSORS ${check_PROCESSORS}
    ENVIRONMENT "POCL_CACHE_DIR=${PROJECT_BINARY_DIR}/pocl-cache")
endfunction()

set(scripts ${PROJECT_SOURCE_DIR}/scripts)
boxwood_check(format COMMAND ${scripts}/check_format.sh TIMEOUT 120 PROCESSORS 1)
boxwood_check(tidy COMMAND ${scripts}/check_tidy.sh ${PROJECT_BINARY_DIR} TIMEOUT 900 PROCESSORS 2)
boxwood_check(layers COMMAND ${scripts}/check_layers.sh TIMEOUT 60 PROCESSORS 1)
boxwood_check(kernels COMMAND ${scripts}/check_kernels.sh TIMEOUT 300 PROCESSORS 1)
boxwood_check(spirv COMMAND ${scripts}/check_spirv.sh TIMEOUT 300 PROCESSORS 2)
boxwood_check(oclgrind COMMAND ${scripts}/check_oclgrind.sh ${PROJECT_BINARY_DIR} TIMEOUT 1500 PROCESSORS 2)
boxwood_check(sanitizers COMMAND ${scripts}/check_sanitizers.sh TIMEOUT 1800 PROCESSORS 2)
boxwood_check(gpu-profile COMMAND ${CMAKE_COMMAND} -E env BOXWOOD_SMALL=1 ${PROJECT_BINARY_DIR}/boxwood-tests
  --tuning=64,2048,4,1 --test-suite=runtime,primitives,bounds,influence,volumes,layout,metrics,build,traverse --no-intro
  TIMEOUT 900 PROCESSORS 1)
boxwood_check(drivers COMMAND ${scripts}/check_drivers.sh ${PROJECT_BINARY_DIR} TIMEOUT 900 PROCESSORS 2)
boxwood_check(watertight COMMAND ${PROJECT_BINARY_DIR}/boxwood-benchmark-watertight --rays 1e7
  TIMEOUT 1200 PROCESSORS 2)
boxwood_check(fuzz COMMAND ${scripts}/check_fuzz.sh 60 TIMEOUT 600 PROCESSORS 2)
