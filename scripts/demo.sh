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
view=(--eye '20,4.2,45' --target '0,0.1,10' --fov 20 --environment sky --environment-rotation 25)
mkdir -p output
"$boxwood" devices
"$boxwood" scene forest --instances 10001 --triangles 1154 --seed 1 -o output/forest.glb
"$boxwood" build output/forest.glb -o output/forest.bxw --report output/build.json
"$boxwood" render output/forest.bxw -o output/forest.exr --resolution 960x540 --spp 48 --exposure 0.8 "${view[@]}" \
    --report output/render.json

echo "Done. In output/:"
ls -sh output
