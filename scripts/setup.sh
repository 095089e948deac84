#!/usr/bin/env bash
# Installs the Debian packages that a part of the project needs and that are missing. Asks dpkg first, so that it is
# silent, instant and offline when everything is there.
#
#   scripts/setup.sh GROUP...     groups: build, test, bench, studio, ci
set -euo pipefail
cd "$(dirname "$0")/.."

build_packages=(g++ cmake ninja-build nlohmann-json3-dev libcli11-dev libfmt-dev libtinygltf-dev libfast-float-dev
                libassimp-dev zlib1g-dev libtbb-dev libcpp-httplib-dev pkg-config) # assimp's CMake package names zlib, its Debian package forgets it
test_packages=(libgtest-dev libqhull-dev)
bench_packages=(libbenchmark-dev libogre-1.12-dev libcal3d12-dev libopenscenegraph-dev) # the last three to compare with
studio_packages=(emscripten)
ci_packages=(clang-format emscripten chromium)

packages=()
node_tools=no       # no, wanted (where a Node is there), needed
npm_folders=()      # with a package-lock.json each
for group in "$@"; do
  case "$group" in
    build) packages+=("${build_packages[@]}") ;;
    test)  packages+=("${test_packages[@]}"); npm_folders+=(tests/judges)
           [ "$node_tools" = needed ] || node_tools=wanted ;;
    bench) packages+=("${bench_packages[@]}") ;;
    studio) packages+=("${studio_packages[@]}"); npm_folders+=(apps/studio); node_tools=needed ;;
    ci)    packages+=("${ci_packages[@]}"); npm_folders+=(tests/judges tests/studio); node_tools=needed ;;
    *)     echo "setup: no group '$group' (build, test, bench, studio, ci)" >&2; exit 2 ;;
  esac
done

# A Node that does not come from Debian is as good, and Debian's npm would not go with it.
if [ "$node_tools" = needed ]; then
  command -v node >/dev/null || packages+=(nodejs)
  command -v npm >/dev/null || packages+=(npm)
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || {
      echo "setup: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2
      echo "setup: run, as root: apt-get install ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
  fi
  apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0)
  echo "setup: installing ${missing[*]}"
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  # The package lists may be absent or stale: refresh them, and try once more where a mirror stumbles.
  install() { "${apt[@]}" install --no-install-recommends "${missing[@]}" >"$log" 2>&1; }
  refresh() { "${apt[@]}" update >"$log" 2>&1; }
  refresh || { sleep 3; refresh; } || { tail -n 20 "$log" >&2; echo "setup: could not refresh the package lists" >&2; }
  install || { sleep 3; refresh || true; install; } || {
    tail -n 30 "$log" >&2
    echo "setup: apt could not install ${missing[*]}; see above" >&2
    exit 1
  }
fi

# npm packages: the judges (tests/judges), which `make test` uses where there is a Node and CI must; the studio's
# libraries and compiler; the browser's driver.
for folder in "${npm_folders[@]}"; do
  if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "setup: no Node here; the tests against gltf-validator and three.js will be skipped"
    break
  fi
  cmp -s "$folder/package-lock.json" "$folder/node_modules/.installed" && continue
  echo "setup: installing the npm packages of $folder"
  if (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error); then
    cp "$folder/package-lock.json" "$folder/node_modules/.installed"
  elif [ "$node_tools" = needed ]; then
    echo "setup: npm ci failed in $folder" >&2
    exit 1
  else
    echo "setup: npm ci failed in $folder; its tests will be skipped" >&2
  fi
done
