#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Takes every kernel file with each of its macro sets (see check_kernels.sh) to SPIR-V, as many drivers do with a
# kernel: what clang accepts for this processor need not be expressible there. In OpenCL C 3.0, and not optimised, since
# what later passes make of it is the drivers' own.
set -euo pipefail
cd "$(dirname "$0")/.."

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export scratch

# translate "FILE [MACRO...]"
translate() {
    local words bitcode="$scratch/$BASHPID.bc"
    read -ra words <<<"$1"
    local file=${words[0]} macros=("${words[@]:1}")
    if ! clang-14 -x cl -target spir64 -cl-std=CL3.0 -D__OPENCL_VERSION__=300 -Xclang -finclude-default-header -O0 \
        -emit-llvm -c -DGROUP_SIZE=1 "${macros[@]/#/-D}" -I cl -I tests "$file" -o "$bitcode" ||
        ! llvm-spirv-14 "$bitcode" -o "$bitcode.spv"; then
        echo "check_spirv: $file fails with ${macros[*]}" >&2
        return 1
    fi
}
export -f translate

grep -rH --include='*.cl' '^// compile:' cl tests | sed 's,:// compile:, ,' | sort >"$scratch/sets"
[[ -s $scratch/sets ]]
# shellcheck disable=SC2016 # $1 is the inner shell's
xargs -P "$(nproc)" -d '\n' -n 1 bash -c 'translate "$1"' translate <"$scratch/sets"
echo "check_spirv: $(wc -l <"$scratch/sets") translations"
