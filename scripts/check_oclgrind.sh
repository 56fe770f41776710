#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the kernel tests on small sizes under Oclgrind. Fails when a test fails, on any memory error, and on a data race
# outside the kernels whose file includes the documented hand-off (cl/runtime/handoff.h).
# usage: scripts/check_oclgrind.sh [BUILD_FOLDER [SUITE,...]]
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:-build/release}
suites=${2:-render,build,traverse,influence,volumes,layout,metrics,primitives,bounds,runtime}
export build
export logs=$build/oclgrind
rm -rf "$logs"
mkdir -p "$logs"

# A process for each part of a suite, one on each core: after every kernel Oclgrind goes through all buffers of its
# process, on one thread. Not by --log: every context that a test opens would start that file anew.
check_part() {
    local log="$logs/$1-$2"
    if ! BOXWOOD_DEVICE=Oclgrind BOXWOOD_SMALL=1 oclgrind --data-races --max-errors 1000000 \
        "$build/boxwood-tests" --no-intro --test-suite="$1" --first="$2" --last="$3" >"$log.txt" 2>"$log.log"; then
        cat "$log.txt"
        tail -c 20000 "$log.log"
        return 1
    fi
}
export -f check_part
# Longest first.
# shellcheck disable=SC2086 # words
scripts/suite_parts.sh "$build/boxwood-tests" 40 ${suites//,/ } |
    xargs -P "$(nproc)" -L 1 bash -c 'check_part "$@"' part
cat "$logs"/*.txt

# climb.h hands off for the kernels that include it.
# shellcheck disable=SC2016 # $1 is Perl's
handoff=$({ grep -rlE --include='*.cl' 'runtime/handoff.h|volumes/climb.h' cl tests || true; } |
    xargs -r perl -0ne 'print "$1 " while /\bkernel\b[^;{]*?\bvoid\s+(\w+)\s*\(/g')

# An entry of the log starts at the margin; the lines that explain it, "Kernel: NAME" among them, are indented. What
# names no kernel is not Oclgrind's (a compiler's words about a text that a test breaks on purpose).
awk -v handoff="$handoff" '
    function judge() {
        if (kernel == "") return
        if (entry ~ /data race/ && kernel in allowed) races++
        else { printf "%s", text; bad++ }
        kernel = ""
    }
    BEGIN { split(handoff, names, " "); for (i in names) allowed[names[i]] }
    /^[^ \t]/ { judge(); entry = $0; text = "" }
    { text = text $0 "\n" }
    $1 == "Kernel:" { kernel = $2 }
    END {
        judge()
        printf "check_oclgrind: %d races in the documented hand-off, %d other findings\n", races, bad
        exit bad > 0
    }' "$logs"/*.log
