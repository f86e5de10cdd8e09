#!/usr/bin/env bash
# Makes the demo's pictures anew: thumbnails of the shapes and the reference picture by the ray tracer, scenes by technique exact.
# Usage: web/demo/pictures/make.sh [VITRINE]
set -eu
vitrine=$(realpath "${1:-build/release/vitrine}")
cd "$(dirname "$0")"
draw() { "$vitrine" render "$1" -t reference --environment sky "${@:2}"; }
for shape in sphere knot goblet bottle diamond; do
  draw "$shape" --samples 16 --resolution 112,112 --fov 38 -o "$shape.png"
done
draw torus --samples 16 --resolution 112,112 --camera 0.9,2.3,2.6 --target 0,0,0 --fov 45 -o torus.png
# The scenes of state.js.
scene() { "$vitrine" render "${@:2}" -t exact --preset high --environment studio --samples 64 --resolution 112,112 -o "$1.png"; }
scene behind cube --object knot:at=0,0,-2 --camera 0.65,0.66,3.05 --target 0,0,-0.5 --fov 38
scene tumbler tumbler --object water:ior=1.333 --object plane:checker=24,scale=4,at=0,0,-3 --camera 0.5,0.75,2.95 --target 0,0,0 --fov 45
"$vitrine" render ripples --preset high --environment sky --samples 64 --resolution 112,112 --camera -0.81,0.58,3.24 --target 0,0,0 --fov 38 -o relief.png
models=$(mktemp -d)
trap 'rm -r "$models"' EXIT
node ../models.mjs "$models" # the bunny needs `npm ci` in tests/
draw "$models/bunny.glb" --samples 16 --resolution 112,112 --fov 38 -o bunny.png
# camera-orbit "30deg 72deg 3.4m", camera-target "0m 0m 0m": see `reference` in state.js
draw knot --samples 32 --resolution 1024,1024 --camera 1.616796,1.050658,2.800373 --target 0,0,0 --fov 45 -o reference.png
