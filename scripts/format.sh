#!/usr/bin/env bash
# Formats all C and C++ of the project; --check only tells what is not formatted.
set -eu
cd "$(dirname "$0")/.."
format=$(command -v clang-format-14 || command -v clang-format)
if ! "$format" --version | grep -q 'version 14\.'; then
  echo "format: skipped, $("$format" --version) is not version 14"
  exit 0
fi
files=$(git ls-files '*.c' '*.h' '*.cpp' 2>/dev/null || find src native web tests docs -name '*.[ch]' -o -name '*.cpp')
files=$(echo "$files" | grep -v '^shaders_es3/')
if [ "${1:-}" = --check ]; then
  # shellcheck disable=SC2086
  exec "$format" --dry-run --Werror $files
fi
# shellcheck disable=SC2086
"$format" -i $files
