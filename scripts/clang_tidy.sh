#!/usr/bin/env bash
# Looks for common mistakes in the C++ sources with clang-tidy (configured in .clang-tidy), two sources at a time. The last
# line gives the number of sources and findings; it fails if there are any findings.
#
#   scripts/clang_tidy.sh              sources that differ from where this branch left main; on main, from the commit before.
#                                      For a header: the source or the test of its name, otherwise one that includes it
#   scripts/clang_tidy.sh --most N     the same, but if there are more than N, none, with a message
#   scripts/clang_tidy.sh --all        all sources; those that the build joins are read together, since most of the time goes into
#                                      headers. The static analyzer looks at the others only. Joined sources count as one
#   scripts/clang_tidy.sh FILE...      these
#
# Without clang-tidy, or without a repository to find changes, nothing is checked, with a message.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

skip() {
  echo "SKIPPED, NOT CHECKED: clang-tidy $1" >&2
  echo "clang-tidy: 0 sources, 0 findings"
  exit 0
}
command -v clang-tidy >/dev/null || skip "is not installed (Debian: apt-get install clang-tidy)"

most=1000000
all=false
given=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --all) all=true ;;
    --most) shift; most="$1" ;;
    -*) sed -n '2,/^set/{/^#/s/^# \?//p}' "$0" >&2; exit 2 ;;
    *) given+=("$1") ;;
  esac
  shift
done

# Without precompiled headers, which are those of GCC.
log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
build=build-plain joined=OFF options=()
if $all; then
  build=build-joined joined=ON
  options=(--checks=-bugprone-suspicious-include '--header-filter=(geometry|mesher|workbench|tests|bench)/.*\.[ch]pp$')
fi
cmake --preset plain -B $build -DQUADRILLE_FAST_BUILD=$joined -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >"$log/cmake" 2>&1 ||
  { cat "$log/cmake" >&2; exit 1; }
sed -n "s|^  \"file\": \"$PWD/\(.*\)\",\?$|\1|p" $build/compile_commands.json |
  grep -E '/Unity/|^(geometry|mesher|workbench|tests|bench)/' | sort -u >"$log/known"

changed() {
  local before
  before=$(git merge-base HEAD main 2>/dev/null || git merge-base HEAD origin/main 2>/dev/null || true)
  if [[ -z "$before" || "$before" == "$(git rev-parse HEAD)" ]]; then before=$(git rev-parse --verify --quiet HEAD~1 || echo HEAD); fi
  { git diff --name-only --diff-filter=d "$before" -- '*.cpp' '*.hpp'; git ls-files --others --exclude-standard -- '*.cpp' '*.hpp'; } | sort -u
}

sources_of() {
  while read -r file; do
    if [[ "$file" != *.hpp ]]; then echo "$file"; continue; fi
    local name=${file##*/}
    name=${name%.hpp}
    { grep -x "${file%.hpp}.cpp" "$log/known" || grep "/${name}_test.cpp$" "$log/known" ||
      tr '\n' '\0' <"$log/known" | xargs -0 grep -lF "#include \"$file\"" || true; } | head -n 1
  done | sort -u | { grep -xFf "$log/known" || true; }
}

if $all; then
  cp "$log/known" "$log/sources"
elif [[ ${#given[@]} -gt 0 ]]; then
  printf '%s\n' "${given[@]}" | sources_of >"$log/sources"
else
  git rev-parse HEAD >/dev/null 2>&1 || skip "checks what has changed, and there is no repository here"
  changed | sources_of >"$log/sources"
fi
count=$(wc -l <"$log/sources")
((count <= most)) || skip "would take long: $count sources have changed, more than $most; run scripts/clang_tidy.sh by itself"

status=0
# -Wno-...: options of GCC's that clang does not know.
tr '\n' '\0' <"$log/sources" | xargs -0 -r -P 2 -n 1 sh -c \
  'log=$1 build=$2; shift 2
   nice clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option "$@" >"$log/$$.out" 2>"$log/$$.err" ||
   { grep -v "warnings\? .*generated" "$log/$$.err" >&2; exit 1; }' clang-tidy "$log" $build "${options[@]}" || status=1
# A finding in a header shows with each source that includes it.
find "$log" -name '*.out' -exec cat {} + | awk '/: (warning|error): /{shown = !seen[$0]++} shown' | tee "$log/findings"
findings=$(grep -cE '^/.*: (warning|error): ' "$log/findings" || true)
echo "clang-tidy: $count sources, $findings findings"
((status == 0 && findings == 0))
