# SPDX-License-Identifier: MIT
# Fails unless the first C++ block of README is the file EXAMPLE, but for the licence line and what is blank around it.
file(READ "${README}" readme)
file(READ "${EXAMPLE}" example)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" example "${example}")
string(STRIP "${example}" example)

set(fence "```")
string(FIND "${readme}" "${fence}cpp\n" start)
if(start EQUAL -1)
  message(FATAL_ERROR "${README} has no C++ block")
endif()
math(EXPR start "${start} + 7")
string(SUBSTRING "${readme}" ${start} -1 block)
string(FIND "${block}" "\n${fence}" end)
string(SUBSTRING "${block}" 0 ${end} block)
string(STRIP "${block}" block)

if(NOT block STREQUAL example)
  message(FATAL_ERROR "The C++ block of ${README} differs from ${EXAMPLE}; copy the file into the block")
endif()
