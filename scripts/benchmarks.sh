#!/usr/bin/env bash
# Writes docs/benchmarks.md and the plots beside it. --models FOLDER adds the bunny; --backend egl measures a GPU;
# ROUNDS=3 is quicker.
set -eu
cd "$(dirname "$0")/.."
vitrine=build/release/vitrine
models="" backend=auto
while [ $# -gt 0 ]; do
  case $1 in
    --models) models=$2 ;;
    --backend) backend=$2 ;;
    *) echo "benchmarks: unknown option '$1'; it takes --models FOLDER and --backend egl" >&2; exit 1 ;;
  esac
  shift 2
done
common=(--rendering-backend "$backend" --rounds "${ROUNDS:-9}" --camera 0.36,0.3,3.05 --target 0,0,0)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# sweep NAME MODEL OPTIONS...: its table, and its plot beside the docs' other pictures.
sweep() {
  "$vitrine" bench "$2" "${common[@]}" --sweep "$1" "${@:3}" --json --table "$scratch/$1.md" >"$scratch/$1.json"
  node scripts/plot.mjs "$scratch/$1.json" "$scratch/bench-$1.svg"
  cat "$scratch/$1.md"
}
{
  cat <<'TEXT'
# Benchmarks

`vitrine bench`, made by `scripts/benchmarks.sh`. Every technique's frames are drawn in turns with the reference tracer
(Embree, on the same processors): read the ratios, the times are those of one machine on one day.

- *frame*: median time of a frame of strict paths, which only refract, or reflect where they must, GL finished; *CPU*: the
  processors' time for it, all threads, which other programs disturb less. Ratios of both *to Embree*, which traces the
  same paths and stores their directions; *to its strict picture*, light at the paths' ends included; and to `layered`.
- *picture*: the same of the frame as it is by default, with Fresnel reflection and the preset's branches; Embree's is that
  of `vitrine render -t reference`, every reflection followed down to 0.002 of the light.
- *within 1°, 5°, lost*: exit directions against the reference, on pixels whose true path meets at most four surfaces.
- *reads*: texture reads of the path, counted by the shaders themselves, a pixel that sees glass and an event.
- *textures*: all that a renderer holds that draws only this technique, but the mesh; *bytes a triangle*: the mesh on the
  GPU; *build*: the hierarchies, on one processor; *upload*: the scene with them to the GPU.
TEXT
  [ "${ROUNDS:-9}" -ge 9 ] || printf '\nMedians of few frames: read the CPU ratios.\n'
  for model in ${models:+"$models/bunny_69666.glb"} knot torus; do
    name=$(basename "$model" .glb)
    printf '\n## %s\n\n' "${name%%_*}"
    "$vitrine" bench "$model" "${common[@]}"
  done
  printf '\n## Triangles\n\nThe knot in ever more triangles; the picture hardly changes.\n\n![time over triangles](pictures/bench-triangles.svg)\n\n'
  sweep triangles knot
  printf '\n## Resolution\n\n![time over pixels](pictures/bench-resolution.svg)\n\n'
  sweep resolution knot
  cat <<'TEXT'

## Objects

Copies of the knot side by side, 1 to 1,000, as large as all stay inside the picture: about as many pixels see glass,
and there are ever more objects. Then one behind the other, all as large in the picture: the same pixels, and ever more
surfaces. *CPU a glass pixel* and *paths alone* (the CPU time of the stage that follows them) are to those of one
object; copies share all memory of their mesh, Embree's too, which finds them by a hierarchy over their boxes.

![time over objects](pictures/bench-objects.svg)

TEXT
  sweep objects knot
  printf '\n![time over objects, one behind the other](pictures/bench-depth.svg)\n\n'
  sweep depth knot --max-events 64
  cat <<'TEXT'

## Reliefs

The pattern `ripples` in ever more samples, by its heights alone (`heightfield`, no triangles are made) and as triangles
(`exact`); the picture hardly changes. *memory* is that of the heights with their pyramid, or of the mesh, beside the
GPU; *GPU memory* that of the same there; *triangulation* makes the mesh, *upload* sends heights or mesh to the GPU.
[reliefs.md](reliefs.md) says what follows.

![time over samples](pictures/bench-relief.svg)

TEXT
  sweep relief ripples
} >"$scratch/benchmarks.md"
mv "$scratch"/bench-*.svg docs/pictures/
mv "$scratch/benchmarks.md" docs/benchmarks.md
