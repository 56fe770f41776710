#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Formats C++ files and kernels by clang-format 14. With --check it changes nothing, prints what it would change, and
# fails if there is anything.
# usage: scripts/format.sh [--check]
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ $# -gt 1 || ${1:---check} != --check ]]; then
    sed -n 's/^# usage/usage/p' "$0" >&2
    exit 2
fi
export check=${1:-}

# format_kernels FILE...
# clang-format 14 has no option that ends the line after the attributes of a kernel, so it gets them as a comment.
format_kernels() {
    set -euo pipefail
    local attributes='kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))' file failed=0 formatted
    formatted=$(mktemp)
    for file in "$@"; do
        sed -E "s|^(${attributes//[()]/\\&}) *|//\1\n|" "$file" | sed '/^\/\/kernel /{n;/^$/d}' |
            clang-format --style=file:cl/.clang-format --assume-filename="$file" | sed 's|^//kernel |kernel |' \
            >"$formatted"
        if cmp -s "$file" "$formatted"; then
            continue
        elif [[ -z $check ]]; then
            cat "$formatted" >"$file"
        else
            diff -u --label "$file" --label "$file, formatted" "$file" "$formatted" || failed=1
        fi
    done
    rm "$formatted"
    return "$failed"
}
export -f format_kernels

options=(-i)
[[ -z $check ]] || options=(--dry-run -Werror)
find host include tests '(' -name '*.cpp' -o -name '*.hpp' ')' -print0 | xargs -0 clang-format "${options[@]}"
find cl tests '(' -name '*.cl' -o -name '*.h' ')' -print0 |
    xargs -0 -n 32 -P "$(nproc)" bash -c 'format_kernels "$@"' format
