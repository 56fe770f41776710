#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fails when a C++ file is not as clang-format would leave it, a shell script is not clean by shellcheck, or a public
# header is missing from boxwood.hpp.
set -euo pipefail
cd "$(dirname "$0")/.."

find host include tests -name '*.cpp' -print0 -o -name '*.hpp' -print0 | xargs -0 clang-format --dry-run -Werror
shellcheck .ci/run scripts/*.sh

for header in include/boxwood/*.hpp; do
    name=boxwood/$(basename "$header")
    if [[ $name != boxwood/boxwood.hpp ]] && ! grep -q "#include \"$name\"" include/boxwood/boxwood.hpp; then
        echo "check_format: include/boxwood/boxwood.hpp does not include $name" >&2
        exit 1
    fi
done
