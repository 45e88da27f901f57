#!/usr/bin/env bash
# Draws the pictures of samples/gallery, and samples/caterpillar.png from the demo's; needs ImageMagick, to make them
# small. The banana is not bundled: it is drawn where MODELS has banana.obj.
#   bash samples/gallery.sh [MODELS]
set -euo pipefail
models=$(realpath "${1:-.}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash samples/demo.sh
export PATH=$PWD/build/release/bin:$PATH
to=$PWD/samples/gallery data=$PWD/tests/data work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

goffer base --length 30 --radius 1 --columns 32 --rows 481 --caps -o worm.ply
goffer bend worm.ply --regions 0.5,0.5 --angles 120,-120 -o s.glb --png s.png

goffer base --length 60 --radius 1 --columns 40 --rows 1201 --caps -o tentacle.ply
goffer bend tentacle.ply --regions 0.25,0.2,0.17,0.15,0.13,0.1 --angles 60,70,80,95,110,115 -o spiral.glb --png spiral.png

for pair in bottle=wine_bottle.glb trunk=log_01.glb drink=fuze.ply; do
    name=${pair%=*} model=$data/${pair#*=}
    goffer bend "$model" --angle 90 -o "$name.glb" --png "$name.png"
    goffer bend "$model" --angle 90 --paper -o "$name.glb" --png "${name}_paper.png"
done
goffer bend "$data/insect_leg.glb" --by 60 -o leg.glb --png leg.png
goffer bend "$data/insect_leg.glb" --angle 0 -o leg.glb --png leg_straight.png --ghost

if [[ -f $models/banana.obj ]]; then
    goffer bend "$models/banana.obj" --angle 0 -o straight.obj --png banana.png --ghost
else
    echo "gallery: no banana.obj in $models: its picture stays as it is"
fi
for picture in *.png; do convert "$picture" -strip -resize 50% +dither -colors 255 "$to/$picture"; done
convert "$to/../../out/bent.png" -strip -resize 75% +dither -colors 255 "$to/../caterpillar.png"
