#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the library and its tests with AddressSanitizer and UndefinedBehaviorSanitizer and runs them on small sizes.
# usage: scripts/check_sanitizers.sh [SUITE,...]
set -euo pipefail
cd "$(dirname "$0")/.."

suites=${1:-runtime,primitives,bounds,hierarchy,traverse,render,scene,io,cli}

cmake --preset asan
cmake --build --preset asan --target boxwood-tests
LSAN_OPTIONS="suppressions=$PWD/scripts/lsan.supp:print_suppressions=0" \
    UBSAN_OPTIONS=print_stacktrace=1 BOXWOOD_SMALL=1 \
    build/asan/boxwood-tests --no-intro --test-suite="$suites"
