#!/usr/bin/env bash
# Configures and builds into build/.
#
#   scripts/build.sh PRESET [TARGET...]     PRESET: release, or ci (warnings are errors); no target = all
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
preset="$1"
shift
targets=()
if [[ $# -gt 0 ]]; then targets=(--target "$@"); fi

echo "Building (preset $preset) into build/"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset "$preset" "${targets[@]}"
