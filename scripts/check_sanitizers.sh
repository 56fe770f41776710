#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the library and its tests with AddressSanitizer and UndefinedBehaviorSanitizer and runs them on small sizes.
# usage: scripts/check_sanitizers.sh [SUITE,...]
set -euo pipefail
cd "$(dirname "$0")/.."

suites=${1:-cli,hierarchy,render,io,traverse,primitives,bounds,runtime,scene}

cmake --preset asan
cmake --build --preset asan --target boxwood-tests
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1 BOXWOOD_SMALL=1
# A process for each suite, one on each core, longest first. Processes of the tool end while PoCL's threads do, where LeakSanitizer 14
# itself may fail: leaks are looked for in the other suites.
tr ',' '\n' <<<"$suites" | xargs -P "$(nproc)" -I{} bash -c '
    [[ {} != cli ]] || export ASAN_OPTIONS=detect_leaks=0
    build/asan/boxwood-tests --no-intro --test-suite={} >build/asan/{}.txt 2>&1 || { tail -c 20000 build/asan/{}.txt; exit 1; }
    tail -n 4 build/asan/{}.txt'
