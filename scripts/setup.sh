#!/usr/bin/env bash
# Installs the Debian packages that a part of the project needs and that are missing. Asks dpkg first, so that it is
# silent, instant and offline when everything is there.
#
#   scripts/setup.sh GROUP...     groups: build, test, bench, ci
set -euo pipefail
cd "$(dirname "$0")/.."

build_packages=(g++ cmake ninja-build nlohmann-json3-dev libcli11-dev libfmt-dev libtinygltf-dev libfast-float-dev
                libassimp-dev zlib1g-dev libtbb-dev) # assimp's CMake package names zlib, its Debian package forgets it
test_packages=(libgtest-dev libqhull-dev)
bench_packages=(libbenchmark-dev)
ci_packages=(clang-format emscripten)

packages=()
node_tools=no       # no, wanted (where a Node is there), needed
for group in "$@"; do
  case "$group" in
    build) packages+=("${build_packages[@]}") ;;
    test)  packages+=("${test_packages[@]}"); [ "$node_tools" = needed ] || node_tools=wanted ;;
    bench) packages+=("${bench_packages[@]}") ;;
    ci)    packages+=("${ci_packages[@]}"); node_tools=needed ;;
    *)     echo "setup: no group '$group' (build, test, bench, ci)" >&2; exit 2 ;;
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

# The judges (tests/judges) are npm packages. `make test` uses them where there is a Node; CI must.
judges=tests/judges
if [ "$node_tools" != no ] && [ -f $judges/package-lock.json ]; then
  if command -v node >/dev/null && command -v npm >/dev/null; then
    if ! cmp -s $judges/package-lock.json $judges/node_modules/.installed; then
      echo "setup: installing the npm packages of $judges"
      if (cd $judges && npm ci --no-audit --no-fund --loglevel=error); then
        cp $judges/package-lock.json $judges/node_modules/.installed
      elif [ "$node_tools" = needed ]; then
        echo "setup: npm ci failed in $judges" >&2
        exit 1
      else
        echo "setup: npm ci failed in $judges; its tests will be skipped" >&2
      fi
    fi
  else
    echo "setup: no Node here; the tests against gltf-validator and three.js will be skipped"
  fi
fi
