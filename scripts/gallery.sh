#!/usr/bin/env bash
# Renders the gallery: each built-in shape where it looks best, and how the method sees one. The README's
# pictures are these: scripts/gallery.sh docs/pictures.
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

picture knot knot --environment studio --preset high --samples 16 --resolution 720,720
picture goblet goblet --environment sky --preset high --samples 16 --resolution 540,720
picture bottle bottle --environment studio --preset high --samples 16 --resolution 540,720
picture diamond diamond --ior 2.42 --max-events 24 --environment studio --preset high --samples 16 --resolution 720,720 --camera 1.2,2.2,2.6
picture torus torus --environment checker --preset high --samples 16 --resolution 720,540 --camera 0.4,2.6,3.4
picture sphere sphere --environment sky --samples 16 --resolution 540,540
picture knot-paths knot --analysis --preset high --resolution 720,720
picture knot-two-layers knot --technique layered --environment studio --layers 2 --samples 16 --resolution 720,720
"$vitrine" render knot --technique layered --layers 4 --resolution 360,360 --layer-sheet "$folder/knot-layers.png"
echo "  $folder/knot-layers.png"
