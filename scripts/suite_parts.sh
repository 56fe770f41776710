#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cuts suites into parts for processes that run side by side: no suite alone keeps one core busy while the other is
# idle. Prints a line "SUITE FIRST LAST" for each part, numbers of test cases as boxwood-tests --first and --last take
# them.
# usage: scripts/suite_parts.sh BOXWOOD_TESTS SIZE SUITE...
set -euo pipefail

tests=$1 size=$2
shift 2
for suite in "$@"; do
    count=$("$tests" --no-intro --count --test-suite="$suite" | sed -n 's/.*current filters: *//p')
    [[ $count -gt 0 ]] || { echo "suite_parts: no test case in suite $suite" >&2; exit 1; }
    for ((first = 1; first <= count; first += size)); do
        echo "$suite $first $((first + size - 1))"
    done
done
