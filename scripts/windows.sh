#!/usr/bin/env bash
# Builds the command for Windows (x86_64) on Debian 12 and packs out/quadrille-VERSION-windows-x86_64.zip: the FreeCAD addon
# with the program and its libraries in its folder bin/. Installs the cross compiler and builds OpenCASCADE, oneTBB, fmt,
# OpenVDB and what they need from Debian's sources, once, in a cache.
#
#   scripts/windows.sh         the program and the zip
#   scripts/windows.sh test    tries the program under wine: tests/windows/run.py
#
# The cache is the folder QUADRILLE_WINDOWS_CACHE, by default ~/.cache/quadrille-windows.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

cache=${QUADRILLE_WINDOWS_CACHE:-$HOME/.cache/quadrille-windows}
prefix=$cache/prefix
target=x86_64-w64-mingw32
mkdir -p "$cache/src" "$cache/lists/partial" "$prefix/include"
exec 9>"$cache/lock"
flock -n 9 || { echo "error: another windows.sh is using $cache" >&2; exit 1; }

began=$SECONDS
# step WHAT COMMAND...: prints what is being done and how long it took; the output goes to a log, shown if it fails.
step() {
  local what=$1 start=$SECONDS
  shift
  printf '%s ...' "$what"
  "$@" >"$cache/log" 2>&1 &  # beside this shell, where the first error ends it
  wait $! || { echo " failed:"; tail -n 40 "$cache/log"; exit 1; }
  printf ' %d s\n' $((SECONDS - start))
}

install_tools() {
  local packages=(g++-mingw-w64-x86-64-posix libz-mingw-w64-dev cmake ninja-build ca-certificates zip libboost-dev
    libcgal-dev libeigen3-dev libcli11-dev nlohmann-json3-dev)
  [[ "${1:-}" == test ]] && packages+=(wine wine64 python3)
  dpkg -s "${packages[@]}" && return
  local root=()
  [[ $EUID == 0 ]] || root=(sudo)
  "${root[@]}" apt-get update
  "${root[@]}" apt-get install -y --no-install-recommends "${packages[@]}"
}

# Debian's list of sources, separate from the system's own.
fetch() {
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" \
    >"$cache/sources.list"
  local options=(-o "Dir::Etc::sourcelist=$cache/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$cache/lists"
    -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache=)
  apt-get "${options[@]}" update
  cd "$cache/src"
  # The original sources alone: Debian's changes are for Debian.
  apt-get "${options[@]}" source --download-only --only-source opencascade onetbb openvdb fmtlib lz4 libzstd c-blosc || true
  local archive
  for archive in opencascade onetbb openvdb fmtlib lz4 libzstd c-blosc; do tar -xf "$archive"_*.orig.tar.*z; done
  touch fetched
}

toolchain() {
  cat >"$cache/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER $target-gcc-posix)
set(CMAKE_CXX_COMPILER $target-g++-posix)
set(CMAKE_RC_COMPILER $target-windres)
set(CMAKE_FIND_ROOT_PATH /usr/$target $prefix)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
END
  # Header-only libraries are the same on all systems.
  local headers
  for headers in boost CGAL CLI nlohmann eigen3; do ln -sfn "/usr/include/$headers" "$prefix/include/$headers"; done
  # Copies of their descriptions, which look for the headers near themselves: /usr/include itself is Linux's.
  mkdir -p "$prefix/share/cmake"
  cp -r /usr/share/cmake/CLI11 /usr/share/cmake/nlohmann_json "$prefix/share/cmake/"
  cp -r /usr/share/eigen3 "$prefix/share/"
}

configure() {
  local source=$1 build=$2
  shift 2
  local launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache)
  cmake -Wno-dev -G Ninja -S "$source" -B "$build" -DCMAKE_TOOLCHAIN_FILE="$cache/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_PREFIX_PATH="$prefix" "${launcher[@]}" "$@"
}

# build NAME SOURCE OPTIONS...: configures, builds and installs a library, unless it is there already.
build() {
  local name=$1 source=$2
  shift 2
  [[ -f "$cache/built-$name" ]] && return
  # shellcheck disable=SC2086 # the folder's name holds a version
  configure $cache/src/$source "$cache/build-$name" "$@"
  ninja -C "$cache/build-$name" install
  touch "$cache/built-$name"
}

# OpenCASCADE has 3800 sources: those of a package are compiled together where possible.
build_opencascade() {
  [[ -f "$cache/built-occt" ]] && return
  local toolkit
  cp cmake/windows/opencascade.cmake "$cache/"
  for toolkit in "$cache"/src/occt-*/src/TK*; do
    grep -q join_packages "$toolkit/CMakeLists.txt" ||
      printf 'include(%s)\njoin_packages(%s)\n' "$cache/opencascade.cmake" "${toolkit##*/}" >>"$toolkit/CMakeLists.txt"
  done
  local off=() module
  for module in FoundationClasses ModelingData ModelingAlgorithms Visualization ApplicationFramework DataExchange Draw; do
    off+=("-DBUILD_MODULE_$module=OFF")
  done
  build occt 'occt-*' "${off[@]}" "-DBUILD_ADDITIONAL_TOOLKITS=TKSTEP;TKIGES;TKMesh;TKBO" -DUSE_FREETYPE=OFF -DUSE_TK=OFF \
    -DUSE_TBB=OFF -DBUILD_DOC_Overview=OFF -DINSTALL_DIR_LAYOUT=Unix -DINSTALL_DIR_BIN=bin -DINSTALL_DIR_LIB=lib \
    -DINSTALL_DIR_CMAKE=lib/cmake/opencascade
}

build_openvdb() {
  build lz4 'lz4-*/build/cmake' -DBUILD_SHARED_LIBS=OFF -DBUILD_STATIC_LIBS=ON -DLZ4_BUILD_CLI=OFF -DLZ4_BUILD_LEGACY_LZ4C=OFF
  build zstd 'zstd-*/build/cmake' -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_SHARED=OFF -DZSTD_MULTITHREAD_SUPPORT=OFF
  build blosc 'c-blosc-*' -DBUILD_SHARED=OFF -DBUILD_STATIC=ON -DBUILD_TESTS=OFF -DBUILD_BENCHMARKS=OFF -DBUILD_FUZZERS=OFF \
    -DDEACTIVATE_SNAPPY=ON -DCMAKE_C_FLAGS=-mxsave -DPREFER_EXTERNAL_LZ4=ON -DPREFER_EXTERNAL_ZSTD=ON -DPREFER_EXTERNAL_ZLIB=ON
  build openvdb 'openvdb-*' -DOPENVDB_BUILD_BINARIES=OFF -DOPENVDB_CORE_SHARED=OFF -DOPENVDB_CORE_STATIC=ON \
    -DOPENVDB_USE_DELAYED_LOADING=OFF -DBLOSC_USE_STATIC_LIBS=ON -DZLIB_ROOT="/usr/$target" -DUSE_CCACHE=OFF \
    -DUSE_EXPLICIT_INSTANTIATION=OFF -DOPENVDB_DISABLE_BOOST_IMPLICIT_LINKING=OFF
}

build_quadrille() {
  configure . build-windows -DQUADRILLE_TESTS=OFF -DQUADRILLE_BENCH=OFF -DQUADRILLE_PYTHON=OFF -DQUADRILLE_INSTALL=OFF \
    -DQUADRILLE_VTK=OFF -DQUADRILLE_MED=OFF
  ninja -C build-windows quadrille
}

# The libraries that a program needs and that are no part of Windows, and those that they need.
copy_libraries() {
  local folder=$1 found more=true name
  while $more; do
    more=false
    while read -r name; do
      [[ -e "$folder/$name" ]] && continue
      found=$(find "$prefix/bin" "$prefix/lib" "/usr/lib/gcc/$target/12-posix" "/usr/$target/lib" -name "$name" | head -n 1)
      [[ -z "$found" ]] && continue
      cp "$found" "$folder/$name"
      "$target-strip" "$folder/$name"
      more=true
    done < <("$target-objdump" -p "$folder"/*.exe "$folder"/*.dll | sed -n 's/.*DLL Name: //p' | sort -u)
  done
}

pack() {
  local name=$1 stage=$cache/stage addon=$cache/stage/$1/Quadrille
  rm -rf "$stage"
  mkdir -p "$addon/bin/licences"
  cp build-windows/quadrille.exe build-windows/quadrille_*.dll "$addon/bin/"
  "$target-strip" "$addon"/bin/*.exe "$addon"/bin/*.dll
  copy_libraries "$addon/bin"
  git ls-files workbench | grep -vE '[.](cpp|hpp)$' | while read -r file; do
    install -D -m 644 "$file" "$addon/${file#workbench/}"
  done
  cp package.xml README.md LICENSE "$addon/"
  cp LICENSE "$addon/bin/licences/quadrille.txt"
  local source
  for source in occt oneTBB openvdb fmtlib lz4 zstd c-blosc; do
    find "$cache"/src/"$source"-* -maxdepth 1 -iname 'LICEN[SC]E*' -type f | while read -r file; do
      cp "$file" "$addon/bin/licences/$source-${file##*/}"
    done
  done
  cp /usr/share/doc/libcgal-dev/copyright "$addon/bin/licences/CGAL.txt"
  cp /usr/share/doc/libboost-dev/copyright "$addon/bin/licences/Boost.txt"
  mkdir -p out
  rm -f "out/$name.zip"
  (cd "$stage" && zip -qr9 - "$name") >"out/$name.zip"
}

name=quadrille-$(sed -n 's/^project(quadrille VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)-windows-x86_64
step "Installing the cross compiler" install_tools "${1:-}"
[[ -f "$cache/src/fetched" ]] || step "Fetching the sources of the libraries" fetch
step "Preparing the tools" toolchain
step "oneTBB" build tbb 'oneTBB-*' -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF
step "fmt" build fmt 'fmtlib-*' -DBUILD_SHARED_LIBS=OFF -DFMT_TEST=OFF -DFMT_DOC=OFF
step "OpenVDB" build_openvdb
step "OpenCASCADE" build_opencascade
step "Quadrille" build_quadrille
step "Packing" pack "$name"
echo "out/$name.zip: $(du -h "out/$name.zip" | cut -f1), $((SECONDS - began)) s in all"
[[ "${1:-}" == test ]] && exec /usr/bin/python3 tests/windows/run.py "$cache/stage/$name/Quadrille/bin/quadrille.exe"
exit 0
