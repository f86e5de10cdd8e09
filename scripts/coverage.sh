#!/usr/bin/env bash
# Tells which lines of src the native tests run: builds with gcc's counters, runs the tests, sums up by folder.
#   scripts/coverage.sh     needs gcovr; about a quarter of an hour on two cores; exit code 1 below 90 % of all lines
set -eu
cd "$(dirname "$0")/.."

if ! command -v gcovr >/dev/null; then
  echo "coverage: left out, gcovr is not installed (scripts/dependencies.sh --all)"
  exit 0
fi
cmake -S . -B build/coverage -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_TESTING=ON -DCMAKE_C_FLAGS='--coverage -O1' \
  -DCMAKE_CXX_FLAGS='--coverage -O1' -DCMAKE_EXE_LINKER_FLAGS=--coverage >/dev/null
cmake --build build/coverage
find build/coverage -name '*.gcda' -delete
ctest --test-dir build/coverage -j 2 -L unit
for suite in cli cases series; do # they run the program of VITRINE_BINARY
  VITRINE_BINARY="$PWD/build/coverage/vitrine" node --test "tests/$suite.test.mjs" >/dev/null || echo "coverage: $suite failed"
done
# Threads that count at once leave some branches fewer than 0 runs, which gcovr would end at; lines are not concerned.
gcovr --gcov-ignore-parse-errors --root . --filter src/ build/coverage --csv build/coverage/lines.csv >/dev/null
awk -F, 'NR > 1 { split($1, path, "/"); all[path[2]] += $2; run[path[2]] += $3; sum += $2; done += $3 }
  END {
    print "| folder | lines | run |\n|---|---|---|"
    for (folder in all) if (all[folder] > 0) printf "| src/%s | %d | %.1f %% |\n", folder, all[folder], 100 * run[folder] / all[folder] | "sort"
    close("sort")
    printf "| all | %d | %.1f %% |\n", sum, 100 * done / sum
    exit done < 0.9 * sum
  }' build/coverage/lines.csv
