#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the library and its tests by the preset `debug`, with AddressSanitizer and UndefinedBehaviorSanitizer, and runs
# them on small sizes.
# usage: scripts/check_sanitizers.sh [SUITE,...]
set -euo pipefail
cd "$(dirname "$0")/.."

all=cli,build,render,io,traverse,influence,volumes,layout,metrics,tree_image,primitives,bounds,runtime,scene,common
suites=${1:-$all}

cmake --preset debug
cmake --build --preset debug --target boxwood-tests
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1 BOXWOOD_SMALL=1
# A process for each part of a suite, one on each core, longest first. Processes of the tool end while PoCL's threads
# do, where LeakSanitizer 14 itself may fail: leaks are looked for in the other suites.
check_part() {
    local log="build/debug/$1-$2.txt"
    [[ $1 != cli ]] || export ASAN_OPTIONS=detect_leaks=0
    build/debug/boxwood-tests --no-intro --test-suite="$1" --first="$2" --last="$3" >"$log" 2>&1 || {
        tail -c 20000 "$log"
        return 1
    }
    tail -n 4 "$log"
}
export -f check_part
# shellcheck disable=SC2086 # words
scripts/suite_parts.sh build/debug/boxwood-tests 40 ${suites//,/ } |
    xargs -P "$(nproc)" -L 1 bash -c 'check_part "$@"' part
