#!/usr/bin/env bash
# Installs what is missing, builds everything and passes every test. Exit code 0: all passed.
set -eu
cd "$(dirname "$0")"

bash scripts/dependencies.sh

echo "== native, release"
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release

if command -v emcmake >/dev/null; then
  echo "== web"
  bash scripts/build-web.sh
else
  echo "== web: left out, emscripten is not installed"
fi

echo "== native, with address and undefined-behaviour sanitizers"
cmake --preset asan >/dev/null
cmake --build --preset asan

echo "== tests, sanitizers"
ctest --preset asan -j 2
echo "== tests, release"
ctest --preset release
