#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles every kernel file with warnings as errors, as OpenCL C 3.0 for this processor and as 1.2 for a plain
# SPIR device (so that both sides of each dialect and vendor switch are seen). A kernel file lists the macro sets to
# compile it with, one line each:
#     // compile: TYPE=float OPERATOR=0
# GROUP_SIZE is always given, as the runtime does. A file without such a line fails. (A parameter may be unused: the
# specialisations of a kernel share one signature.)
#
# What PoCL gets in place of Clang's header of all built-in functions, cl/runtime/builtins.h, must do for every kernel,
# and give the same code.
#
# Kernels of the library, which give the same bits on every device, may not call built-in functions whose result OpenCL
# leaves to the device; cl/runtime/products.h, cl/render/turn.h and cl/render/elementary.h have others. (Division and
# square root are as exact as the device says; of fmin() and fmax() only the sign of a zero is left open.)
set -euo pipefail
cd "$(dirname "$0")/.."

native=()
[[ $(uname -m) != x86_64 ]] || native=(-mavx2)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
compiled=0

# compile FILE OUTPUT [COMPILER FLAG...] with the macro set in $macros, to LLVM's language, not optimised
compile() {
    local file=$1 output=$2
    shift 2
    if ! clang -x cl -S -emit-llvm -O1 -Xclang -disable-llvm-passes -Wall -Wextra -Wno-unused-parameter -Wno-psabi \
        -Werror "$@" -DGROUP_SIZE=1 "${macros[@]/#/-D}" -I cl -I tests "$file" -o "$output"; then
        echo "check_kernels: $file fails with $* ${macros[*]}" >&2
        failed=1
    fi
    compiled=$((compiled + 1))
}

every_builtin=(-Xclang -finclude-default-header)
few_builtins=(-include opencl-c-base.h -D_OPENCL_H_ -include cl/runtime/builtins.h)
opencl_3=(-cl-std=CL3.0 -D__OPENCL_VERSION__=300 "${native[@]}")
opencl_1_2=(-cl-std=CL1.2 -D__OPENCL_VERSION__=120 -target spir64)

while IFS= read -r file; do
    mapfile -t sets < <(sed -n 's,^// compile: *,,p' "$file")
    if [[ ${#sets[@]} -eq 0 ]]; then
        echo "check_kernels: $file has no line '// compile: MACRO=VALUE ...'" >&2
        failed=1
    fi
    for set in "${sets[@]}"; do
        read -ra macros <<<"$set"
        compile "$file" "$work/every.ll" "${opencl_3[@]}" "${every_builtin[@]}"
        compile "$file" "$work/few.ll" "${opencl_3[@]}" "${few_builtins[@]}"
        if ! cmp "$work/every.ll" "$work/few.ll"; then
            echo "check_kernels: $file is other code by the declarations of cl/runtime/builtins.h, ${macros[*]}" >&2
            failed=1
        fi
        compile "$file" "$work/spir.ll" "${opencl_1_2[@]}" "${every_builtin[@]}"
    done
done < <(find cl tests -name '*.cl' | sort)

inexact='(native|half)_(recip|divide|sqrt)|((native|half)_)?(cos|sin|tan|exp(2|10)?|log(2|10)?|powr|rsqrt)|fast_[a-z]+'
inexact+='|a?(sin|cos|tan)(h|pi)|a(sin|cos|tan)|atan2(pi)?|sincos|expm1|log1p|pown?|rootn|cbrt|hypot'
inexact+='|[lt]gamma(_r)?|erfc?|mad|dot|cross|distance|length|normalize|mix|smoothstep|degrees|radians'
if grep -rnE --include='*.cl' --include='*.h' "^([^/]|/[^/])*\b($inexact) *\(" cl >&2; then
    echo "check_kernels: these call functions whose result is left to the device" >&2
    failed=1
fi

echo "check_kernels: $compiled compilations"
[[ $failed == 0 && $compiled -gt 0 ]]
