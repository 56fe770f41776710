#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds everything and runs the tests; further arguments go to ctest. With --checks first,
# also every check that .ci/run makes.
set -euo pipefail
cd "$(dirname "$0")/.."

configuration=Release
if [[ ${1:-} == --checks ]]; then
    shift
    configuration=checks
    scripts/setup.sh --checks
else
    scripts/setup.sh
fi
cmake --preset release
cmake --build --preset release
# As many at once as there are cores: most of their time is that of compilers of kernels, on one core each.
ctest --test-dir build/release --build-config "$configuration" --parallel "$(nproc)" --output-on-failure \
    --no-tests=error "$@"
