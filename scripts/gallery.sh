#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of the README's gallery in scenes/: of procedural scenes, and, when a folder with them is given, of
# real ones whose licences allow it with credit. Takes two minutes on two cores; SPP=8 is quick and noisy.
#
# usage: scripts/gallery.sh [FOLDER_OF_SCENES]
set -euo pipefail
folder=${1:+$(realpath "$1")} # before cd: it may be relative
cd "$(dirname "$0")/.."
boxwood=${BOXWOOD:-build/release/boxwood}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture NAME SCENE OPTIONS...: scenes/NAME.png
picture() {
    local name=$1 scene=$2
    shift 2
    local options=("$@") i
    for i in "${!options[@]}"; do # SPP instead of the number given
        [ -z "${SPP:-}" ] || [ "${options[i]}" != --spp ] || options[i + 1]=$SPP
    done
    "$boxwood" render "$scene" -o "$work/$name.exr" "${options[@]}"
    cp "$work/$name.png" "scenes/$name.png"
}

for kind in cornell forest materials menger planks; do
    "$boxwood" scene $kind -o "$work/$kind.glb" --quiet
done
picture cornell "$work/cornell.glb" --resolution 480x300 --spp 384 --depth 8 --eye 0,0,3.4 --target 0,0,0 --exposure 1
picture forest "$work/forest.glb" --resolution 480x300 --spp 96 --eye 2,2.2,19 --target 0,0.6,8 --fov 40 --exposure 0
picture forest-ambient "$work/forest.glb" --resolution 480x300 --spp 48 --eye 2,2.2,19 --target 0,0.6,8 --fov 40 \
    --integrator ambient --exposure 0
picture spheres "$work/materials.glb" --resolution 400x250 --spp 192 --eye -1.8,2,5.2 --target 0.1,-0.6,-0.3 \
    --fov 38 --environment sky --exposure 0
picture sponge "$work/menger.glb" --resolution 400x250 --spp 192 --depth 8 --eye 0.02,0.12,0.98 \
    --target -0.1,-0.05,0 --fov 75 --exposure 1
picture planks "$work/planks.glb" --resolution 400x250 --spp 96 --eye 1.1,0.9,1.8 --target 0,-0.05,0 --fov 40 \
    --exposure 0
[ -n "$folder" ] || exit 0

picture teapot "$folder/teapot_15704.glb" --resolution 480x300 --spp 96 --eye 60,130,190 --target 5,34,0 --fov 32 \
    --exposure -0.5
picture box "$folder/cornellbox_original.glb" --resolution 480x300 --spp 512 --eye 0,1,3.6 --target 0,1,0 --fov 34 \
    --exposure 4
pines=(--eye '1650,160,3700' --target '1650,40,2800' --fov 35)
picture pines "$folder/synth_forest_pine_5000.glb" --resolution 480x300 --spp 96 "${pines[@]}" --exposure 0
picture pines-cost "$folder/synth_forest_pine_5000.glb" --resolution 480x300 --spp 4 "${pines[@]}" --integrator cost
