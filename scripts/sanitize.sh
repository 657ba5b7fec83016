#!/usr/bin/env bash
# Builds with the address and undefined-behavior sanitizers, then with the thread sanitizer. Under each it runs the tests and
# meshes the models in ../shared/corpus (skipped with a message if that folder is missing). The exit code is 1 if anything
# was found. The reports are in build-asan/found and build-tsan/found.
#
# The thread sanitizer must see how oneTBB passes work between threads. So Debian's source of oneTBB is built with the
# sanitizer as well (apt-get source, into the build folder; nothing is installed).
#
#   scripts/sanitize.sh                 both
#   scripts/sanitize.sh asan-ubsan      one: asan-ubsan or tsan
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
presets=("$@")
if [[ ${#presets[@]} -eq 0 ]]; then presets=(asan-ubsan tsan); fi
corpus="${QUADRILLE_CORPUS:-../shared/corpus}"
lists="$PWD/tests/sanitizers"
status=0

# Meshes one model. A sanitizer's finding gives exit code 99; errors of the mesher give other codes.
mesh_model() {
  local model="$1" folder="$2" code=0
  shift 2
  "$folder/quadrille" mesh "$model" -o "$folder/found/mesh.msh" --quiet "$@" 2>"$folder/found/stderr" || code=$?
  if [[ $code -eq 0 ]]; then return 0; fi
  echo "$(basename "$model"): exit code $code: $(grep -m 1 -E 'ERROR|WARNING|runtime error|quadrille:' "$folder/found/stderr")"
  cp "$folder/found/stderr" "$folder/found/$(basename "$model").log"
  status=1
}

# Builds Debian's oneTBB with the thread sanitizer into FOLDER/install.
build_onetbb() {
  local folder="$1"
  if [[ -f "$folder/install/lib/cmake/TBB/TBBConfig.cmake" ]]; then return 0; fi
  echo "Building oneTBB with the thread sanitizer into $folder"
  rm -rf "$folder"
  mkdir -p "$folder/lists/partial"
  # Use the system's mirrors for sources, without changing apt's own files.
  # shellcheck disable=SC2016
  apt-get indextargets --format \
    'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u >"$folder/sources.list"
  local apt=(apt-get -q -o "Dir::Etc::SourceList=$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$folder/lists" -o Dir::Cache::PkgCache= -o Dir::Cache::SrcPkgCache= -o APT::Sandbox::User=)
  # oneTBB must take its memory from malloc, which the sanitizer knows. It would use libtbbmalloc if that were loaded.
  {
    (cd "$folder" && "${apt[@]}" update && "${apt[@]}" source --download-only --tar-only onetbb &&
      mkdir source && tar -xf onetbb_*.orig.tar.* --strip-components=1 -C source) &&
      cmake -G Ninja -S "$folder/source" -B "$folder/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DCMAKE_INSTALL_PREFIX="$folder/install" -DCMAKE_INSTALL_LIBDIR=lib -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
        -DTBB_STRICT=OFF -DTBB_ENABLE_IPO=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
        -DCMAKE_CXX_FLAGS="-D__TBB_DYNAMIC_LOAD_ENABLED=0 -D__TBB_WEAK_SYMBOLS_PRESENT=0" &&
      cmake --build "$folder/build" && cmake --install "$folder/build"
  } >"$folder/log" 2>&1 || {
    tail -n 20 "$folder/log" >&2
    echo "error: oneTBB could not be built with the thread sanitizer: see $folder/log" >&2
    exit 1
  }
}

for preset in "${presets[@]}"; do
  folder="$PWD/build-${preset%-ubsan}"
  settings=()
  if [[ $preset == tsan ]]; then
    build_onetbb "$folder/onetbb"
    settings=(-DTBB_ROOT="$folder/onetbb/install" -DTBB_DIR="$folder/onetbb/install/lib/cmake/TBB")
  fi
  cmake --preset "$preset" "${settings[@]}" >/dev/null
  cmake --build --preset "$preset"
  rm -rf "$folder/found"
  mkdir "$folder/found"
  export ASAN_OPTIONS="exitcode=99:detect_leaks=1:check_initialization_order=1"
  export LSAN_OPTIONS="suppressions=$lists/leaks.txt:print_suppressions=0:exitcode=99"
  export UBSAN_OPTIONS="print_stacktrace=1:exitcode=99"
  export TSAN_OPTIONS="exitcode=99:suppressions=$lists/threads.txt:print_suppressions=0:die_after_fork=0"
  # Threads of VTK and of the software renderer run none of our code, and the sanitizer cannot see their synchronization.
  if [[ $preset == tsan ]]; then export VTK_SMP_BACKEND_IN_USE=Sequential LP_NUM_THREADS=0; fi
  echo "== $preset: the tests"
  ctest --test-dir "$folder" --output-on-failure --timeout 3000 >"$folder/found/ctest.log" 2>&1 || status=1
  tail -n 15 "$folder/found/ctest.log"
  if [[ ! -d "$corpus" ]]; then
    echo "== $preset: NOT RUN on the corpus: there is no $corpus"
    continue
  fi
  echo "== $preset: the corpus"
  models=0
  for model in "$corpus"/*.{brep,step,stp,igs}; do
    if [[ $preset == tsan ]]; then
      mesh_model "$model" "$folder" --elements-per-diagonal 40 --order 2 --threads 2
    else
      mesh_model "$model" "$folder" --elements-per-diagonal 60 --threads 1
    fi
    models=$((models + 1))
  done
  echo "$models models meshed"
done
exit "$status"
