#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From nothing to a picture: installs what is missing, builds, makes a procedural forest, builds its tree and renders
# it. Leaves scene, tree, reports and pictures in output/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target boxwood

boxwood=build/release/boxwood
mkdir -p output
"$boxwood" devices
"$boxwood" scene forest --seed 1 -o output/forest.glb
"$boxwood" build output/forest.glb -o output/forest.bxw --report output/build.json
"$boxwood" render output/forest.bxw -o output/forest.exr --resolution 960x540 --report output/render.json

echo "Done. In output/:"
ls -sh output
