#!/usr/bin/env bash
# Checks the formatting (clang-format) and common mistakes (clang-tidy) of the C++ sources, each by itself
# (configured in build-plain/), and both in the Python sources (flake8, configured in .flake8).
#   scripts/check_style.sh [--fix-format]
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
git ls-files '*.py' | xargs flake8
mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
if [[ "${1:-}" == --fix-format ]]; then
  clang-format -i "${sources[@]}"
fi
clang-format --dry-run --Werror "${sources[@]}"
cmake --preset plain >/dev/null
git ls-files 'geometry/*.cpp' 'mesher/*.cpp' 'bench/*.cpp' |
  grep -v '_plugin.cpp$' | xargs -P "$(nproc)" -n 1 clang-tidy -p build-plain --quiet
