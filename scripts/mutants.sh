#!/usr/bin/env bash
# Do the unit tests see faults? Puts each fault of tests/mutants.txt, one at a time, into a copy of the tree
# (build/mutants), builds that, and tells which test fails. Exit code 0: each fault is caught.
#   scripts/mutants.sh            every fault of the list
#   scripts/mutants.sh NAME...    these
#   scripts/mutants.sh --list     their names, and what each breaks
# The test that the list names is built and run first; all unit tests are, where it does not fail. A test counts
# only if it passes without a fault. A fault that does not compile, or whose text is not found exactly once, is an error.
set -eu
cd "$(dirname "$0")/.."
list=tests/mutants.txt
copy=build/mutants
build=$copy/build/release
log=$copy/log.txt

declare -a names=()
declare -A breaks file test old new passed
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
  --help | -h) sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
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
  tests/CMakeLists.txt tests/cases tests/directions tests/lsan.supp tests/unit -type f)
for source in "${sources[@]}"; do
  if ! cmp -s "$source" "$copy/$source"; then
    mkdir -p "$copy/${source%/*}"
    cp "$source" "$copy/$source"
  fi
done
(cd "$copy" && find native scripts shaders_es3 src tests -type f) | sort |
  comm -13 <(printf '%s\n' "${sources[@]}" | sort) - | sed "s|^|$copy/|" | xargs -r -d '\n' rm --
(cd "$copy" && cmake --preset release -DBUILD_TESTING=ON -DVT_DATA=none) >"$log"

# Builds what is named, or everything; then runs the tests of that name, or all unit tests until one fails.
builds() {
  cmake --build "$build" -j "$(nproc)" ${1:+--target "$1"} >"$log" 2>&1
}
passes() {
  ctest --test-dir "$build" -j "$(nproc)" --stop-on-failure --output-on-failure --timeout 900 \
    -L unit ${1:+-R "^$1\$"} --no-tests=error >"$log" 2>&1
}

# Without a fault.
mustPass() {
  [ -z "${passed[${1:-all}]+set}" ] || return 0
  if ! builds "$1" || ! passes "$1"; then
    tail -n 20 "$log"
    echo "mutants.sh: ${1:-a unit test} fails without any fault; see $log" >&2
    exit 2
  fi
  passed[${1:-all}]=yes
}

put() { # a text into a file of the copy: file, old text, new text
  local content
  content=$(<"$copy/$1")
  printf '%s\n' "${content/"$2"/"$3"}" >"$copy/$1"
}

# Its test, and the case in it, from the log.
failure() {
  local program case
  program=$(sed -n 's/^.* Test *#[0-9]*: \([a-z_]*\) .*\(Failed\|Timeout\|Exception\|Subprocess\).*$/\1/p' "$log" | head -n 1)
  case=$(sed -n 's/^\[  FAILED  \] \([A-Za-z0-9_]*\)$/\1/p' "$log" | head -n 1)
  echo "${program:-?}${case:+, $case}"
}

try() { # a fault: prints its line; false where it is not caught
  mustPass "${test[$1]}"
  put "${file[$1]}" "${old[$1]}" "${new[$1]}"
  local result=0
  if ! builds "${test[$1]}"; then
    result=2
  elif passes "${test[$1]}"; then
    # Somewhere else, perhaps.
    cp "${file[$1]}" "$copy/${file[$1]}"
    mustPass ""
    put "${file[$1]}" "${old[$1]}" "${new[$1]}"
    builds "" || result=2
    [ $result -ne 0 ] || ! passes "" || result=1
  fi
  cp "${file[$1]}" "$copy/${file[$1]}"
  if [ $result -eq 2 ] || grep -q "GL: .* does not \(compile\|link\)" "$log"; then
    tail -n 20 "$log"
    echo "mutants.sh: '$1' does not compile; correct it in $list" >&2
    exit 2
  fi
  if [ $result -eq 1 ]; then
    printf '%-28s NOT CAUGHT (%s)\n' "$1" "${breaks[$1]}"
  else
    printf '%-28s caught by %s\n' "$1" "$(failure)"
  fi
  return $result
}

missed=0
for name in "${names[@]}"; do
  try "$name" || missed=$((missed + 1))
done
echo "${#names[@]} faults, $((${#names[@]} - missed)) caught, $missed not caught; $((SECONDS / 60)) min $((SECONDS % 60)) s"
[ $missed -eq 0 ]
