#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of the READMEs in scenes/: of procedural scenes; when a folder with them is given, of real ones
# whose licences allow it with credit; and when a folder with the published experiments on known rays (areas.json,
# published_costs.csv) is given too, the plot of their study. Takes some minutes on two cores; SPP=8 is quick and
# noisy, ONLY="forest boxes" makes only these. The plots need matplotlib (scripts/setup.sh --checks installs it).
#
# usage: scripts/gallery.sh [FOLDER_OF_SCENES [FOLDER_OF_AREAS]]
set -euo pipefail
folder=${1:+$(realpath "$1")} # before cd: they may be relative
areas=${2:+$(realpath "$2")}
cd "$(dirname "$0")/.."
boxwood=${BOXWOOD:-build/release/boxwood}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# wanted NAME: whether to make scenes/NAME.png
wanted() { [[ -z ${ONLY:-} || " $ONLY " == *" $1 "* ]]; }

# picture NAME SCENE OPTIONS...: scenes/NAME.png
picture() {
    local name=$1 scene=$2
    shift 2
    wanted "$name" || return 0
    local options=("$@") i
    for i in "${!options[@]}"; do # SPP instead of the number given
        [ -z "${SPP:-}" ] || [ "${options[i]}" != --spp ] || options[i + 1]=$SPP
    done
    "$boxwood" render "$scene" -o "$work/$name.exr" "${options[@]}"
    cp "$work/$name.png" "scenes/$name.png"
}

# boxes KIND: the boxes of that kind over the same boards, as lines
boxes() {
    "$boxwood" info "$work/boards.glb" --boxes "$work/$1.glb" --depth 7-7 --bounds "$1" --layout binary --builder sah \
        --quiet
}

for kind in cornell materials menger planks hair; do
    "$boxwood" scene $kind -o "$work/$kind.glb" --quiet
done
"$boxwood" scene forest --instances 10001 --triangles 1154 -o "$work/forest.glb" --quiet
"$boxwood" scene planks --triangles 2400 -o "$work/boards.glb" --quiet

picture cornell "$work/cornell.glb" --resolution 480x300 --spp 384 --depth 8 --eye 0,0,3.4 --target 0,0,0 \
    --exposure 1
forest=(--eye '20,4.2,45' --target '0,0.1,10' --fov 20)
sun=(--environment sky --environment-rotation 25)
picture forest "$work/forest.glb" --resolution 640x360 --spp 128 "${forest[@]}" "${sun[@]}" --exposure 0.8
picture forest-ambient "$work/forest.glb" --resolution 480x270 --spp 48 "${forest[@]}" "${sun[@]}" \
    --integrator ambient --exposure 0
picture forest-cost "$work/forest.glb" --resolution 480x270 --spp 4 "${forest[@]}" --integrator cost
picture spheres "$work/materials.glb" --resolution 400x250 --spp 192 --eye -1.8,2,5.2 --target 0.1,-0.6,-0.3 --fov 38 \
    --environment sky --exposure 0
picture sponge "$work/menger.glb" --resolution 400x250 --spp 192 --depth 8 --eye 0.02,0.12,0.98 \
    --target -0.1,-0.05,0 --fov 75 --exposure 1
picture planks "$work/planks.glb" --resolution 400x250 --spp 96 --eye 1.1,0.9,1.8 --target 0,-0.05,0 --fov 40 \
    --exposure 0

if wanted boxes; then
    boxes aabb
    boxes obb-moments
    scripts/plot_boxes.py "$work/aabb.glb" "$work/obb-moments.glb" -o scenes/boxes.png
fi
if wanted quality; then
    for kind in hair planks; do
        "$boxwood" quality "$work/$kind.glb" --resolution 256x256 --report "$work/$kind.json"
    done
    scripts/plot_quality.py "$work/hair.json" "$work/planks.json" -o scenes/quality.png
fi
[ -n "$folder" ] || exit 0

picture teapot "$folder/teapot_15704.glb" --resolution 480x300 --spp 96 --eye 60,130,190 --target 5,34,0 --fov 32 \
    --exposure -0.5
picture box "$folder/cornellbox_original.glb" --resolution 480x300 --spp 512 --eye 0,1,3.6 --target 0,1,0 --fov 34 \
    --exposure 4
pines=(--eye '1650,160,3700' --target '1650,40,2800' --fov 35)
picture pines "$folder/synth_forest_pine_5000.glb" --resolution 480x300 --spp 96 "${pines[@]}" --exposure 0
picture pines-cost "$folder/synth_forest_pine_5000.glb" --resolution 480x300 --spp 4 "${pines[@]}" --integrator cost
[ -n "$areas" ] || exit 0

if wanted influence; then
    "$boxwood" study influence --areas "$areas/areas.json" --scenes "$folder" --published "$areas/published_costs.csv" \
        --report "$work/study.json"
    scripts/plot_influence.py "$work/study.json" -o scenes/influence.png
fi
