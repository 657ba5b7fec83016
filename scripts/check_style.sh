#!/usr/bin/env bash
# Checks formatting (clang-format) and correctness habits (clang-tidy) of the C++ sources; needs a configured build/.
#   scripts/check_style.sh [--fix-format]
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
if [[ "${1:-}" == --fix-format ]]; then
  clang-format -i "${sources[@]}"
fi
clang-format --dry-run --Werror "${sources[@]}"
git ls-files 'geometry/*.cpp' 'mesher/*.cpp' 'bench/*.cpp' |
  grep -v '_plugin.cpp$' | xargs -P "$(nproc)" -n 1 clang-tidy -p build --quiet
