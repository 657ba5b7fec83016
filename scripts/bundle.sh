#!/usr/bin/env bash
# Builds a relocatable bundle that runs on any Linux with a glibc at least as new as this system's:
# out/quadrille-VERSION-linux-x86_64.tar.xz, with all libraries except glibc's. Also makes a wheel for Python,
# out/quadrille-*.whl. Needs patchelf.
#
#   scripts/bundle.sh               without pictures (--picture), which need the system's OpenGL and X11
#   scripts/bundle.sh --pictures    with pictures: the system's OpenGL driver and Xvfb are then needed to draw
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

pictures=false
if [[ "${1:-}" == --pictures ]]; then pictures=true; fi
if ! command -v patchelf >/dev/null; then
  echo "error: patchelf is missing; install Debian's package patchelf" >&2
  exit 1
fi
build=build-bundle
log=$(mktemp)
stage=$(mktemp -d)
trap 'rm -rf "$log" "$stage"' EXIT
echo "Building in $build/"
# The install prefix must not exist: modules are found relative to the command, and nowhere else.
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/nonexistent -DCMAKE_INSTALL_LIBDIR=lib \
  -DQUADRILLE_PYTHON_FOLDER=python -DCMAKE_SKIP_INSTALL_RPATH=ON -DQUADRILLE_TESTS=OFF -DQUADRILLE_BENCH=OFF >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }
cmake --build "$build"

version=$(sed -n 's/^project(quadrille VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=quadrille-$version-linux-$(uname -m)
root=$stage/$name
for component in command library python addon; do
  cmake --install "$build" --prefix "$root" --component "$component" --strip >"$log"
done
"$pictures" || rm "$root/lib/quadrille/libquadrille_picture.so"
cp LICENSE docs/bundle.txt "$root/"

# The system provides glibc, since the loader that starts a program belongs to it.
is_of_glibc() { [[ "$1" =~ ^(ld-linux.*|lib(c|m|mvec|dl|pthread|rt|util|resolv|anl|nsl|BrokenLocale))\.so ]]; }
binaries() { find "$root" -type f \( -perm -u+x -o -name '*.so*' \) -exec sh -c 'head -c4 "$1" | grep -q ELF' _ {} \; -print; }
while read -r binary; do
  missing=$(ldd "$binary" | grep 'not found' | grep -v libquadrille || true)
  if [[ -n "$missing" ]]; then echo "error: $binary: $missing" >&2; exit 1; fi
  ldd "$binary" | awk '$2 == "=>" && $3 ~ /^\// { print $1, $3 }'
done < <(binaries) | sort -u | while read -r soname path; do
  if is_of_glibc "$soname" || [[ "$soname" == libquadrille* ]]; then continue; fi
  install -m 644 "$(readlink -f "$path")" "$root/lib/$soname"
  strip --strip-unneeded "$root/lib/$soname"
done
while read -r binary; do
  from=$(dirname "${binary#"$root/"}")
  patchelf --set-rpath "\$ORIGIN/$(realpath -m --relative-to="/$from" /lib)" "$binary"
done < <(binaries)

if grep -rqF "$PWD" "$root" --include='*.so*' --include=quadrille; then
  echo "error: the bundle names the build tree: $(grep -rlF "$PWD" "$root" | tr '\n' ' ')" >&2
  exit 1
fi
mkdir -p out
date=$(git log -1 --format=%cI 2>/dev/null || date -Iseconds)
tar -C "$stage" --sort=name --owner=0 --group=0 --numeric-owner --mtime="$date" -c "$name" | xz -T0 -6 >"out/$name.tar.xz"
/usr/bin/python3 scripts/make_wheel.py "$root" "$version" out
(cd out && sha256sum "$name.tar.xz" quadrille-"$version"-*.whl | tee "$name.sha256")
ls -l "out/$name.tar.xz" out/quadrille-"$version"-*.whl
