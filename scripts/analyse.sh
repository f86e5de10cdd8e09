#!/usr/bin/env bash
# Builds everything with clang, then has cppcheck and clang-tidy (.clang-tidy, scripts/cppcheck.txt) look at the C and C++
# sources for faults. Exit code 0: they found none. About a quarter of an hour on two cores.
set -eu
cd "$(dirname "$0")/.."

for tool in clang clang-tidy cppcheck; do
  if ! command -v "$tool" >/dev/null; then
    echo "analyse: left out, $tool is not installed (scripts/dependencies.sh --all)"
    exit 0
  fi
done
cmake -S . -B build/analyse -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ >/dev/null
cmake --build build/analyse

echo "== cppcheck"
cppcheck --quiet --std=c11 --enable=warning,portability,performance --suppressions-list=scripts/cppcheck.txt \
  --error-exitcode=1 -I src -I build/analyse/include -j 2 src native web/core web/three
echo "== clang-tidy"
git ls-files 'src/*.c' 'src/*.cpp' 'native/*.c' 'tests/*.c' 'tests/*.cpp' | xargs -P 2 -n 8 clang-tidy --quiet -p build/analyse
if command -v emcc >/dev/null; then
  # shellcheck disable=SC2046 # they are words
  clang-tidy --quiet $(git ls-files 'web/*.c') -- $(emcc --cflags) -std=c11 -I . -I src -I web -I native -D VT_WITH_GLFW -D VT_IS_FULL=1
fi
