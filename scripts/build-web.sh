#!/usr/bin/env bash
# The same core for the browser, into build/web. The first build also compiles Emscripten's own libraries.
set -eu
cd "$(dirname "$0")/.."
emcmake cmake --preset web >/dev/null
cmake --build --preset web
