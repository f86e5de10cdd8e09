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
rm -f "$pictures"/{torus,sphere}.png

for id in kay-linear kay-nonlinear kay-thickness single wyman oliveira layered exact reference; do
  "$vitrine" render knot -t "$id" -e sky -r 320,320 -o "$pictures/technique-$id.png"
done
"$vitrine" render ripples -t heightfield -e sky -r 320,320 -o "$pictures/technique-heightfield.png"
# Scenes, for the README.
"$vitrine" render --object cube:at=0,0,0.6 --object knot:at=0,0,-2 --camera 1.1,1,4.6 --target 0,0.05,-0.6 --fov 34 -e sky \
  --preset high --samples 16 -r 540,540 -o "$pictures/scene-knot.png"
"$vitrine" render --object tumbler --object water:ior=1.33,absorb=0.6,0.85,0.9 --object plane:at=0,0,-4,scale=2,checker \
  --camera 0.8,1.2,4 --target 0,0,0 -e studio --preset high --samples 16 -r 540,540 -o "$pictures/scene-water.png"
node scripts/scenes.mjs
# Reliefs, the same.
behind=(--camera 0.5,0.4,4.4 --target 0,0,0 --fov 32 -e studio --samples 16 -r 540,540)
"$vitrine" render --object fluted:at=0,0,0.6,samples=1024 --object plane:checker=0,colour=0.8,0.8,0.75,at=0,0,-3.5,scale=3 \
  --object knot:opaque,colour=0.85,0.25,0.1,roughness=0.35,at=-0.1,0,-1.2 "${behind[@]}" -o "$pictures/relief-fluted.png"
"$vitrine" render --object hammered:samples=1024 --object plane:checker=6,at=0,0,-3,scale=2 \
  --object sphere:opaque,colour=0.1,0.4,0.8,roughness=0.3,at=-0.6,-0.4,-1.4,scale=0.5 \
  --object torus:opaque,colour=0.9,0.6,0.1,roughness=0.3,at=0.4,0.3,-1.6,scale=0.6 "${behind[@]}" -o "$pictures/relief-hammered.png"

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
