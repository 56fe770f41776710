# SPDX-License-Identifier: MIT
# boxwood_warnings(TARGET): strict warnings, errors where BOXWOOD_WARNINGS_AS_ERRORS is
# on, and the sanitizers when they are on.
function(boxwood_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<BOOL:${BOXWOOD_WARNINGS_AS_ERRORS}>:-Werror>)
  # GCC 12 warns of overlapping copies inside its own std::string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(BOXWOOD_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
    boxwood_precompile(${target})
  endif()
endfunction()

# boxwood_precompile(TARGET): what many files include is read once. Only in builds of checks, so that others show where
# a file does not include what it needs.
function(boxwood_precompile target)
  target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional>
    <sstream> <string> <vector> <glm/glm.hpp> <glm/gtc/matrix_transform.hpp> <nlohmann/json.hpp>)
endfunction()
