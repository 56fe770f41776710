#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fails when a C++ file or a kernel is not as scripts/format.sh would leave it, a line has more than 120 columns, a
# shell script is not clean by shellcheck, the name of a test case does not begin with its file's (`scan: ` in
# scan_test.cpp), or a public header is missing from boxwood.hpp.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/format.sh --check
shellcheck .ci/run scripts/*.sh

# The macros of a kernel's line `// compile:` and an address cannot be broken.
long=$(find cl host include tests scripts -regextype egrep -regex '.*\.(cl|h|cpp|hpp|sh|py|cmake)' -print0 |
    LC_ALL=C.UTF-8 xargs -0 grep -nP '^(?!// compile: |.*https?://).{121}' || true)
if [[ -n $long ]]; then
    echo "check_format: these lines have more than 120 columns:"$'\n'"$long" >&2
    exit 1
fi

# shellcheck disable=SC2016 # $ARGV is Perl's
unnamed=$(find tests -name '*_test.cpp' -print0 | xargs -0 perl -0ne '
    my ($stem) = $ARGV =~ m{([^/]*)_test\.cpp$};
    while (/\bTEST_CASE(?:_TEMPLATE|_FIXTURE)?\((?:\s*\w+\s*,)?\s*"([^"]*)/g) {
        print "$ARGV: $1\n" if index($1, "$stem: ") != 0;
    }')
if [[ -n $unnamed ]]; then
    echo "check_format: these test cases are not named FILE: WHAT"$'\n'"$unnamed" >&2
    exit 1
fi

for header in include/boxwood/*.hpp; do
    name=boxwood/$(basename "$header")
    if [[ $name != boxwood/boxwood.hpp ]] && ! grep -q "#include \"$name\"" include/boxwood/boxwood.hpp; then
        echo "check_format: include/boxwood/boxwood.hpp does not include $name" >&2
        exit 1
    fi
done
