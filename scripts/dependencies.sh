#!/usr/bin/env bash
# Installs what is missing to build and test: Debian/Ubuntu packages, then the tests' npm packages. Says
# plainly what cannot be installed and goes on: the build leaves out what it can do without. Quick when nothing
# is missing.
#   scripts/dependencies.sh         what ./demo.sh and ./test.sh need
#   scripts/dependencies.sh --all   what ./test.sh --all runs, too: films, schedulers, Firefox
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

# Without these nothing is built.
needed=(build-essential cmake ninja-build pkg-config libgles-dev libegl-dev libgl1-mesa-dri libtinygltf-dev
  nlohmann-json3-dev libpng-dev libjpeg-dev libwebp-dev libopenexr-dev libcmocka-dev)
# Without one of these a part is left out: its name, and what it is for.
optional=(libosmesa6-dev libglfw3-dev libembree-dev emscripten python3 xvfb xauth chromium clang clang-format libclang-rt-dev)
optional+=(libdraco-dev libmeshoptimizer-dev) # packed geometry in glTF files

if [ "${1:-}" = --all ]; then optional+=(ffmpeg parallel slurm-wlm firefox-esr clang-tidy cppcheck gcovr); fi

installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q '^install ok installed$'; }

missing=()
for package in "${needed[@]}" "${optional[@]}"; do
  installed "$package" || missing+=("$package")
done
command -v node >/dev/null || missing+=(nodejs)
command -v npm >/dev/null || missing+=(npm)

if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  if ! command -v apt-get >/dev/null; then
    echo "dependencies: no apt-get here; install by hand: ${missing[*]}"
  elif [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    echo "dependencies: neither root nor sudo; install by hand: ${missing[*]}"
  else
    echo "dependencies: installing ${missing[*]}"
    export DEBIAN_FRONTEND=noninteractive
    "${as_root[@]}" apt-get update -qq || echo "dependencies: apt-get update failed; trying with the lists at hand"
    if ! "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null; then
      # One package that does not exist here fails them all: try each.
      for package in "${missing[@]}"; do
        "${as_root[@]}" apt-get install -y -qq --no-install-recommends "$package" >/dev/null 2>&1 ||
          echo "dependencies: could not install $package"
      done
    fi
  fi
fi

for package in "${needed[@]}"; do
  if ! installed "$package"; then
    echo "dependencies: $package is needed and missing; the build cannot go on" >&2
    exit 1
  fi
done

# npm writes node_modules/.package-lock.json; as long as it is newer than the lock file nothing changed.
if command -v npm >/dev/null && [ tests/package-lock.json -nt tests/node_modules/.package-lock.json ]; then
  echo "dependencies: installing the tests' npm packages"
  # Debian 12's npm and newer ones do not always agree on a lock file; the versions in package.json are exact.
  if npm --prefix tests ci --no-audit --no-fund --loglevel=error 2>/dev/null ||
    npm --prefix tests install --no-save --no-package-lock --no-audit --no-fund --loglevel=error; then
    touch tests/node_modules/.package-lock.json
  else
    echo "dependencies: could not install the tests' npm packages; golden images and browser are not tested"
  fi
fi
