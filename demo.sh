#!/usr/bin/env bash
# Glass in a minute: installs what is missing, builds, renders a gallery into out/ and serves the demo page.
#   ./demo.sh              all of it; Ctrl-C ends the server
#   ./demo.sh --no-serve   ends after the gallery
#   PORT=9000 ./demo.sh    another port
set -eu
cd "$(dirname "$0")"
serve=1
case "${1:-}" in
  "") ;;
  --no-serve) serve=0 ;;
  -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "demo.sh: unknown option '$1'; see ./demo.sh --help" >&2; exit 1 ;;
esac

bash scripts/dependencies.sh

echo "== building vitrine"
cmake --preset release >/dev/null
cmake --build --preset release --target vitrine

echo "== rendering the gallery into out/"
bash scripts/gallery.sh out

if ! command -v emcmake >/dev/null; then
  echo "== demo page: left out, emscripten is not installed"
  exit 0
fi
echo "== building the demo page"
bash scripts/build-web.sh
if [ "$serve" = 0 ]; then
  echo "== done; the page is in build/web, './demo.sh' serves it"
  exit 0
fi
if ! command -v python3 >/dev/null; then
  echo "== the page is in build/web; python3, which would serve it, is not installed"
  exit 0
fi
port="${PORT:-8080}"
echo "== Vitrine is at http://localhost:$port/demo/ (Ctrl-C ends); the plain GLFW page is at http://localhost:$port/"
exec python3 -m http.server "$port" --bind 127.0.0.1 --directory build/web
