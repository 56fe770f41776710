#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Intel's OpenCL runtime for CPUs beside PoCL: kernel tests on small sizes pass there too, none of them left out, and
# trees and pictures are the same bytes from both. setup.sh --checks installs that runtime in a folder of its own.
# usage: scripts/check_drivers.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."

build=$(realpath "${1:-build/release}")
second=$(scripts/intel_opencl.sh)
export build second
export work=$build/drivers
rm -rf "$work"
mkdir -p "$work"

# test_suites NAME ARGUMENT...   a run of boxwood-tests on the second driver
test_suites() {
    local log=$work/$1.txt
    shift
    if ! OCL_ICD_VENDORS=$second BOXWOOD_SMALL=1 "$build/boxwood-tests" --device=Intel --no-intro "$@" \
        >"$log" 2>&1; then
        tail -c 20000 "$log"
        return 1
    fi
    tail -n 4 "$log"
}

# make_files FOLDER   trees of all sorts and small pictures of all integrators with their checksums, by the first device
make_files() {
    mkdir -p "$1"
    local tool=$build/boxwood
    cd "$1"
    for scene in "terrain --triangles 3000" "planks --triangles 3000" "forest --instances 20" materials cornell; do
        # shellcheck disable=SC2086 # words
        "$tool" scene $scene -o "${scene%% *}.glb" --quiet
    done
    local kind
    for kind in aabb obb-points obb-boxes obb-quaternion obb-cascade obb-moments obb-refined; do
        "$tool" build planks.glb -o "$kind.bxw" --bounds "$kind" --quiet
    done
    "$tool" build forest.glb -o two-levels.bxw --bounds obb-refined --measure area --quiet
    "$tool" build terrain.glb -o binary.bxw --layout binary --morton 63 --quiet
    "$tool" build terrain.glb -o sah.bxw --builder sah --quiet
    "$tool" build cornell.glb -o blend.bxw --builder blend --areas lights --quiet
    local small=(--resolution 40x30 --spp 2 --quiet)
    "$tool" render materials.glb -o path.exr --environment sky --aov all "${small[@]}"
    "$tool" render cornell.glb -o boxes.exr --primary raster --sampler stratified "${small[@]}"
    "$tool" render materials.glb -o ambient.exr --integrator ambient --filter trilinear --environment sky "${small[@]}"
    sha256sum -- *.bxw *.exr >sums
}
export -f test_suites make_files

# The longest first.
printf '%s\0' \
    "OCL_ICD_VENDORS=$second make_files $work/second" \
    "test_suites traversal --test-suite=traverse --test-case='traversal:*'" \
    "test_suites other --test-suite=runtime,primitives,bounds,traverse --test-case-exclude='traversal:*'" \
    "make_files $work/first" \
    "test_suites areas --source-file='*projected_area_test*'" |
    xargs -0 -P "$(nproc)" -I{} bash -euo pipefail -c '{}'

if ! diff "$work/first/sums" "$work/second/sums"; then
    echo "check_drivers: these files differ between the first device and Intel's runtime" >&2
    exit 1
fi
echo "check_drivers: $(wc -l <"$work/first/sums") files are the same from both"
