#!/usr/bin/env bash
# Do the tests see faults? Puts each fault of tests/mutants.txt, one at a time, into a copy of the tree (build/mutants),
# builds that, and runs the test that the list names for it, a unit test or `cases`, which must fail. Without a fault it
# must pass. Exit code 0: each fault is caught, 1: some are not, 2: the list is wrong.
#   scripts/mutants.sh            every fault of the list
#   scripts/mutants.sh NAME...    these
#   scripts/mutants.sh --list     their names, and what each breaks
set -eu
cd "$(dirname "$0")/.."
list=tests/mutants.txt
copy=build/mutants
build=$copy/build/release
log=$copy/log.txt

declare -a names=()
declare -A breaks file test old new sound
name=
while IFS= read -r line; do
  value=${line#*: }
  case $line in
    '' | '#'*) ;;
    '  breaks: '*) breaks[$name]=$value ;;
    '  file: '*) file[$name]=$value ;;
    '  test: '*) test[$name]=$value ;;
    '  old: '*) old[$name]=$value ;;
    '  new: '*) new[$name]=$value ;;
    '  '*) echo "$list: '$line' is no breaks:, file:, test:, old: or new: with a value" >&2; exit 2 ;;
    *)
      name=$line
      if [ -n "${file[$name]+set}" ]; then
        echo "$list: '$name' stands there twice; rename one" >&2
        exit 2
      fi
      names+=("$name") ;;
  esac
done <"$list"

check() { # a fault has all its parts, and its text stands once in its file
  local part content rest
  for part in breaks file test old new; do
    local -n parts=$part
    if [ -z "${parts[$1]+set}" ]; then
      echo "$list: '$1' has no $part:" >&2
      exit 2
    fi
  done
  content=$(<"${file[$1]}")
  rest=${content#*"${old[$1]}"}
  if [ "$rest" = "$content" ] || [ "${rest#*"${old[$1]}"}" != "$rest" ]; then
    echo "$list: the old: text of '$1' does not stand exactly once in ${file[$1]}; correct it" >&2
    exit 2
  fi
}

case ${1:-} in
  --help | -h) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
  --list)
    for name in "${names[@]}"; do
      printf '%-28s %s\n' "$name" "${breaks[$name]}"
    done
    exit 0 ;;
  -*) echo "mutants.sh: unknown option '$1'; it takes --list and names" >&2; exit 2 ;;
esac
for name in "${names[@]}"; do
  check "$name"
done
for name in "$@"; do
  if [ -z "${file[$name]+set}" ]; then
    echo "mutants.sh: there is no fault '$name' in $list; --list shows them" >&2
    exit 2
  fi
done
[ $# -eq 0 ] || names=("$@")

# What differs is copied and gets a new time, so that the build sees what a stopped run has left there.
mkdir -p "$copy"
mapfile -t sources < <(find CMakeLists.txt CMakePresets.json LICENSE cmake docs/embed.c native scripts shaders_es3 src \
  tests/CMakeLists.txt tests/*.mjs tests/cases tests/directions tests/lsan.supp tests/unit -type f)
for source in "${sources[@]}"; do
  if ! cmp -s "$source" "$copy/$source"; then
    cp --parents "$source" "$copy"
  fi
done
(cd "$copy" && find native scripts shaders_es3 src tests -type f) | sort |
  comm -13 <(printf '%s\n' "${sources[@]}" | sort) - | sed "s|^|$copy/|" | xargs -r -d '\n' rm --
ln -sfn "$PWD/tests/node_modules" "$copy/tests/node_modules"
(cd "$copy" && cmake --preset release -DBUILD_TESTING=ON -DVT_DATA=none) >"$log"

run() { # a test: 0: it passes, 1: it fails, 2: it does not compile, or a shader does not
  local target=$1
  [ "$1" != cases ] || target=vitrine
  cmake --build "$build" -j "$(nproc)" --target "$target" >"$log" 2>&1 || return 2
  ctest --test-dir "$build" -R "^$1\$" --output-on-failure --timeout 900 --no-tests=error >"$log" 2>&1 && return 0
  ! grep -q 'GL: .* does not \(compile\|link\)' "$log" || return 2
  return 1
}

try() { # a fault: prints its line; false where it is not caught
  local source=$copy/${file[$1]} by=${test[$1]} content result case
  if [ -z "${sound[$by]+set}" ]; then
    if ! run "$by"; then
      tail -n 20 "$log"
      echo "mutants.sh: $by fails without a fault; see $log" >&2
      exit 2
    fi
    sound[$by]=yes
  fi
  content=$(<"$source")
  printf '%s\n' "${content/"${old[$1]}"/"${new[$1]}"}" >"$source"
  run "$by" && result=0 || result=$?
  printf '%s\n' "$content" >"$source"
  case=$(sed -n 's/^\[  FAILED  \] \([A-Za-z0-9_]*\)$/\1/p' "$log" | head -n 1)
  case $result in
    0) printf '%-28s NOT CAUGHT by %s\n' "$1" "$by"; return 1 ;;
    1) printf '%-28s caught by %s%s\n' "$1" "$by" "${case:+, $case}" ;;
    2) printf '%-28s DOES NOT COMPILE: %s\n' "$1" "$(grep -m 1 'error' "$log")"; return 1 ;;
  esac
}

missed=0
for name in "${names[@]}"; do
  try "$name" || missed=$((missed + 1))
done
echo "${#names[@]} faults, $((${#names[@]} - missed)) caught, $missed not caught; $((SECONDS / 60)) min $((SECONDS % 60)) s"
[ $missed -eq 0 ]
