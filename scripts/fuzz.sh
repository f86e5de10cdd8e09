#!/usr/bin/env bash
# Feeds hostile input to each reader, under address and undefined-behaviour sanitizers: scripts/fuzz.sh SECONDS [TARGET...],
# all targets unless some are named, SECONDS shared by them. What has been found stays in build/fuzz/corpus, and each run
# goes on from there. Exit code 1: an input did harm; it is named. VITRINE_FUZZ_SEED: a number by which inputs follow one
# another in the same way each time.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
  --help | -h) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;;
  '' | *[!0-9]* | 0) echo "fuzz.sh: SECONDS is '${1:-}'; it must be a whole number above 0" >&2; exit 1 ;;
esac
seconds=$1
shift
targets=("$@")
if [ ${#targets[@]} = 0 ]; then targets=(gltf packed animation image environment relief object command); fi
for target in "${targets[@]}"; do
  if [ ! -f "tests/fuzz/fuzz_$target.c" ]; then
    echo "fuzz.sh: '$target' is no target; there is none such in tests/fuzz" >&2
    exit 1
  fi
done
nothing='#include <stddef.h>
int LLVMFuzzerTestOneInput(const unsigned char* bytes, size_t size) { return bytes == NULL && size > 0; }'
if ! echo "$nothing" | clang -x c - -fsanitize=fuzzer,address -o /dev/null 2>/dev/null || ! command -v node >/dev/null; then
  echo "== hostile input: left out, clang with its libFuzzer (libclang-rt-dev) or node is not installed"
  exit 0
fi

echo "== hostile input, $seconds s"
cmake -G Ninja -S . -B build/fuzz -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DVT_SANITIZE=ON -DVT_FUZZ=ON \
  -DBUILD_TESTING=ON >/dev/null
cmake --build build/fuzz --target "${targets[@]/#/fuzz_}"
node tests/fuzz/seeds.mjs build/fuzz/seeds

each=$(((seconds + ${#targets[@]} - 1) / ${#targets[@]}))
failed=0
mkdir -p build/fuzz/crashes
for target in "${targets[@]}"; do
  corpus=build/fuzz/corpus/$target dictionary=build/fuzz/seeds/$target.dict log=build/fuzz/$target.log
  mkdir -p "$corpus"
  options=(-max_total_time="$each" -max_len=16384 -timeout=20 -rss_limit_mb=2048 -close_fd_mask=3 -print_final_stats=1 -seed="${VITRINE_FUZZ_SEED:-0}"
    -artifact_prefix="build/fuzz/crashes/$target-")
  if [ -f "$dictionary" ]; then options+=(-dict="$dictionary"); fi
  if "build/fuzz/tests/fuzz_$target" "${options[@]}" "$corpus" "build/fuzz/seeds/$target" >"$log" 2>&1; then
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs"
  else
    failed=1
    grep -E 'ERROR|SUMMARY|runtime error|Test unit written' "$log" | sed "s/^/$target: /" >&2 ||
      tail -3 "$log" | sed "s/^/$target: /" >&2
  fi
done
exit $failed
