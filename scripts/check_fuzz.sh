#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the fuzz targets and runs all of them at once for a while. Inputs that fail are left in build/fuzz.
# usage: scripts/check_fuzz.sh [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-30}

cmake --preset fuzz
cmake --build --preset fuzz

names=()
jobs=()
for source in tests/fuzz/*_fuzz.cpp; do
    name=$(basename "$source" _fuzz.cpp)
    mkdir -p "build/fuzz/corpus-$name"
    "build/fuzz/boxwood-fuzz-$name" -seed=1 -max_total_time="$seconds" -timeout=10 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/$name-" "build/fuzz/corpus-$name" >"build/fuzz/$name.log" 2>&1 &
    names+=("$name")
    jobs+=($!)
done

failed=0
for i in "${!jobs[@]}"; do
    if wait "${jobs[$i]}"; then
        files=$(sed -n 's/stat::number_of_executed_units: *//p' "build/fuzz/${names[$i]}.log")
        echo "check_fuzz: ${names[$i]}: $files files, no failure"
    else
        tail -n 60 "build/fuzz/${names[$i]}.log"
        failed=1
    fi
done
[[ $failed == 0 && ${#jobs[@]} -gt 0 ]]
