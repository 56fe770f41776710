#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the kernel tests on small sizes under Oclgrind. Fails when a test fails, on any memory error, and on a data race
# outside the kernels whose file includes the documented hand-off (cl/runtime/handoff.h).
# usage: scripts/check_oclgrind.sh [BUILD_FOLDER [SUITE,...]]
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:-build/release}
suites=${2:-runtime,primitives,bounds,hierarchy,traverse,render}
log=$build/oclgrind.log

# A process for each suite: after every kernel Oclgrind goes through all buffers of its process, also those that the pool keeps.
# Not by --log: every context that a test opens would start that file anew.
: >"$log"
for suite in ${suites//,/ }; do
    if ! BOXWOOD_DEVICE=Oclgrind BOXWOOD_SMALL=1 oclgrind --data-races --max-errors 1000000 \
        "$build/boxwood-tests" --no-intro --test-suite="$suite" 2>>"$log"; then
        tail -c 20000 "$log"
        exit 1
    fi
done

# climb.h hands off for the kernels that include it.
# shellcheck disable=SC2016 # $1 is Perl's
handoff=$({ grep -rlE --include='*.cl' 'runtime/handoff.h|hierarchy/climb.h' cl tests || true; } |
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
    }' "$log"
