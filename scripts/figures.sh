#!/usr/bin/env bash
# Rebuilds every picture and figure of README and docs (docs/scenes.md and the branches of docs/method.md alone:
# node scripts/scenes.mjs). --models FOLDER adds models that cannot be shipped.
set -eu
cd "$(dirname "$0")/.."
vitrine=build/release/vitrine
pictures=docs/pictures
mkdir -p "$pictures"
bunny=""
[ "${1:-}" = --models ] && bunny="$2/bunny_69666.glb"

bash scripts/gallery.sh "$pictures"
rm -f "$pictures"/{bottle,torus,sphere}.png

for id in kay-linear kay-nonlinear kay-thickness single wyman oliveira layered exact bvh reference; do
  "$vitrine" render knot -t "$id" -e sky -r 320,320 -o "$pictures/technique-$id.png"
done
# Scenes, for the README.
"$vitrine" render --object cube:at=0,0,0.6 --object knot:at=0,0,-2 --camera 1.1,1,4.6 --target 0,0.05,-0.6 --fov 34 -e sky \
  --preset high --samples 16 -r 540,540 -o "$pictures/scene-knot.png"
"$vitrine" render --object tumbler --object water:ior=1.33,absorb=0.6,0.85,0.9 --object plane:at=0,0,-4,scale=2,checker \
  --camera 0.8,1.2,4 --target 0,0,0 -e studio --preset high --samples 16 -r 540,540 -o "$pictures/scene-water.png"
node scripts/scenes.mjs

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$vitrine" render torus -t reference -r 320,200 --directions "$scratch/truth.pfm"
for id in wyman oliveira layered; do
  "$vitrine" render torus -t "$id" -r 320,200 --directions "$scratch/$id.pfm"
  "$vitrine" compare "$scratch/$id.pfm" "$scratch/truth.pfm" --difference "$pictures/torus-error-$id.png" >/dev/null
done

"$vitrine" ladder knot -e sky -r 384,384 -o "$pictures/ladder.png" --table "$scratch/knot.md"
{
  echo "# The ladder in figures"
  echo
  echo "\`vitrine ladder MODEL -e sky\`, made by \`scripts/figures.sh\`. Directions are compared with the reference on"
  echo "all pixels whose true path leaves the glass; a lost pixel counts as wrong, and as 90° in the mean. Times are"
  echo "medians of 9 frames, drawn in turns with the reference tracer on the same processors: read the ratios."
  for model in goblet knot torus $bunny; do
    echo
    "$vitrine" ladder "$model" -e sky | sed "1s#^\`.*/#\`#"
  done
} >"$scratch/ladder.md"
mv "$scratch/ladder.md" docs/ladder.md

# The knot's table goes into the README between its marks.
awk -v table="$scratch/knot.md" '
  /<!-- ladder -->/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1 }
  /<!-- end -->/ { skip = 0 }
  !skip || /<!-- ladder -->/ { if (!/<!-- ladder -->/) print }
' README.md >"$scratch/README.md"
cp "$scratch/README.md" README.md
