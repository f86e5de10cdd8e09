#!/usr/bin/env bash
# Renders the gallery: what glass does, some built-in shapes, and how the method sees one. The README's pictures
# are these: scripts/gallery.sh docs/pictures.
#   scripts/gallery.sh [FOLDER]
set -eu
cd "$(dirname "$0")/.."
folder="${1:-out}"
vitrine=build/release/vitrine
mkdir -p "$folder"

picture() { # name, then what to render
  local name="$1"
  shift
  "$vitrine" render "$@" -o "$folder/$name.png"
  echo "  $folder/$name.png"
}

models=$(mktemp -d)
trap 'rm -rf "$models"' EXIT
node scripts/gallery-models.mjs "$models"
# A table under a lamp, in the studio; samples as the frost of the cap needs them.
table=(--ground -e studio --resolution 420,560)

picture ring --object "$models/ring.glb:colour=1,0.62,0.22,metallic=1,roughness=0.2,rotate=0,-40,0" \
  --object diamond:glass=diamond,scale=0.5,at=0,1.5,0,rotate=0,-20,0 --max-events 16 --samples 16 "${table[@]}" \
  --ground-color 0.1,0.1,0.11 --sun -0.42,1,-0.1,1,5,4.8,4.3 --exposure 0.1 --tone-mapping agx \
  --camera 1.5,3.6,4.4 --target 0.12,0.36,0 --fov 33
picture perfume --object "$models/flacon.glb:ior=1.52" --object "$models/cap.glb:ior=1.5,roughness=0.35" \
  --object "$models/liquid.glb:ior=1.36,attenuation-color=0.95,0.5,0.25,attenuation-distance=0.7" \
  --object "$models/collar.glb:colour=1,0.7,0.35,metallic=1,roughness=0.25" --samples 24 "${table[@]}" \
  --ground-color 0.35,0.36,0.4 --sun -0.5,0.55,-0.6,2,5,4.7,4.2 --exposure -0.3 --tone-mapping aces \
  --camera 1.5,2.4,3.9 --target 0.1,0.92,0.1 --fov 33
picture goblet --object goblet:ior=1.52 \
  --object "$models/wine.glb:ior=1.35,attenuation-color=0.85,0.08,0.1,attenuation-distance=0.6" --samples 24 "${table[@]}" \
  --ground-color 0.2,0.115,0.065 --sun -0.62,1,-0.25,1,8,7.6,6.8 --exposure -0.6 --tone-mapping aces \
  --camera 0.3,1.7,4.2 --target 0.3,-0.1,0.1 --fov 33
picture knot knot --environment studio --preset high --samples 16 --resolution 720,720
picture torus torus --environment checker --preset high --samples 16 --resolution 720,540 --camera 0.4,2.6,3.4
picture sphere sphere --environment sky --samples 16 --resolution 540,540
picture knot-paths knot --analysis --preset high --resolution 720,720
picture knot-two-layers knot --technique layered --environment studio --layers 2 --samples 16 --resolution 720,720
"$vitrine" render knot --technique layered --layers 4 --resolution 360,360 --layer-sheet "$folder/knot-layers.png"
echo "  $folder/knot-layers.png"
