#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the tool by the preset `debug`, without optimisation and with assertions, and has it build trees and render.
# Fails when any of that does, or when a file is not the same bytes as that of the tool in BUILD_FOLDER.
# usage: scripts/check_debug.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."

release=$(realpath "${1:-build/release}")

cmake --preset debug
cmake --build --preset debug --target boxwood

# make_files TOOL FOLDER   a scene, a tree of either number of levels, one that knows lights, and a picture
make_files() {
    rm -rf "$2"
    mkdir -p "$2"
    cd "$2"
    "$1" scene cornell -o cornell.glb --quiet
    "$1" scene forest --instances 20 -o forest.glb --quiet
    "$1" build forest.glb -o forest.bxw --bounds obb-refined --quiet
    "$1" build cornell.glb -o cornell.bxw --builder blend --areas lights --quiet
    "$1" render cornell.glb -o cornell.exr --resolution 40x30 --spp 2 --quiet
    sha256sum -- *.glb *.bxw *.exr >sums
}

# In shells of their own, as both change folders.
(make_files "$release/boxwood" "$PWD/build/debug/by-release")
(make_files "$PWD/build/debug/boxwood" "$PWD/build/debug/by-debug")
diff build/debug/by-release/sums build/debug/by-debug/sums
