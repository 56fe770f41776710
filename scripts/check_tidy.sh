#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs clang-tidy 14, with the checks of .clang-tidy, on the sources of some layers and, by the example, on all public
# headers. By default on the layers that two cores go through in about two minutes and a half; `all` takes long.
# usage: scripts/check_tidy.sh [BUILD_FOLDER [LAYER...|all]]
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:-build/release}
layers=("${@:2}")
[[ ${#layers[@]} -gt 0 ]] || layers=(common influence tree_image layout build traverse)
[[ ${layers[*]} != all ]] || layers=(.)

# The flags are GCC's, some of which clang does not know. How many warnings were left out is said on standard error.
{
    find "${layers[@]/#/host/}" -name '*.cpp' -print0
    printf 'tests/example/trace/main.cpp\0'
} | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
    2> >(grep -vE '^[0-9]+ warnings? (generated|treated as errors)' >&2 || true)
