#!/usr/bin/env bash
# Makes the Debian packages quadrille, libquadrille0.1, libquadrille-dev, python3-quadrille and freecad-quadrille in
# out/packages, for the release of Debian that it runs on (12 or 13). Run it on each release that needs packages.
#
#   scripts/package.sh            build and package
#   scripts/package.sh --check    also run lintian on the packages
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "Building in build-packages/"
cmake -S . -B build-packages -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DQUADRILLE_PACKAGES=ON \
  -DQUADRILLE_TESTS=OFF -DQUADRILLE_BENCH=OFF >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build build-packages
mkdir -p out/packages
(cd build-packages && cpack -B ../out/packages >"$log" 2>&1) || { cat "$log" >&2; exit 1; }
rm -rf out/packages/_CPack_Packages
release=$(. /etc/os-release && echo "$VERSION_ID")
ls -l out/packages/*"deb${release}"*.deb
if [[ "${1:-}" == --check ]]; then
  lintian --no-tag-display-limit out/packages/*"deb${release}"*.deb
fi
