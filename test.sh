#!/usr/bin/env bash
# Installs what is missing, builds everything and passes every test. Exit code 0: all passed.
#   ./test.sh                 about half an hour on two processors, 20 s of it hostile input
#   ./test.sh --all           also what is long: nothing left out under sanitizers, static analysis, coverage, deliberate
#                             faults that tests must see, ten minutes of hostile input, films, job files of schedulers,
#                             Firefox, thousands of frames, a minute of animated glass, the browser's picture against its rivals'
#   ./test.sh --fuzz SECONDS  hostile input alone, for so long
set -eu
cd "$(dirname "$0")"

all=false
case ${1:-} in
  "") ;;
  --all) all=true ;;
  --fuzz) exec bash scripts/fuzz.sh "${2:-}" ;;
  --help | -h) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "test.sh: unknown option '$1'; it takes --all or --fuzz SECONDS" >&2; exit 1 ;;
esac

if $all; then
  bash scripts/dependencies.sh --all
else
  bash scripts/dependencies.sh
fi

echo "== native, release"
cmake --preset release -DBUILD_TESTING=ON "-DVT_LONG_TESTS=$all" >/dev/null
cmake --build --preset release

if command -v emcmake >/dev/null; then
  echo "== web"
  bash scripts/build-web.sh
else
  echo "== web: left out, emscripten is not installed"
fi

echo "== native, with address and undefined-behaviour sanitizers"
cmake --preset asan "-DVT_LONG_TESTS=$all" >/dev/null
cmake --build --preset asan

echo "== tests, sanitizers"
ctest --preset asan -j 2
echo "== tests, release"
ctest --preset release -j 2

$all || VITRINE_FUZZ_SEED=1 bash scripts/fuzz.sh 20 # the same each time: what is new is for longer runs to find

if $all; then
  bash scripts/fuzz.sh 600
  echo "== static analysis"
  bash scripts/analyse.sh
  echo "== coverage"
  bash scripts/coverage.sh
  echo "== deliberate faults"
  bash scripts/mutants.sh
  echo "== job files of schedulers"
  npm --prefix tests/many-machines install --no-audit --no-fund --loglevel=error
  node --test tests/many-machines/many-machines.test.mjs
  if command -v emcmake >/dev/null; then
    echo "== Firefox"
    node --test tests/firefox.test.mjs
    echo "== thousands of frames on a page, 200 programs at once"
    node --test tests/long.test.mjs
    echo "== a minute of animated glass"
    node --test tests/playing.test.mjs
    echo "== the browser's picture against its rivals'"
    npm --prefix tests/bench install --no-audit --no-fund --loglevel=error
    node tests/bench/glass.mjs --rounds 3
  fi
fi
