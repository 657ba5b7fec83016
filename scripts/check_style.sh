#!/usr/bin/env bash
# Checks the formatting of the C++ sources (clang-format), common mistakes in those that have changed (clang-tidy, see
# scripts/clang_tidy.sh), and both in the Python sources (flake8, configured in .flake8), with the types of the package and the
# scripts (mypy, configured in mypy.ini).
#   scripts/check_style.sh [--fix-format] [--all]     --all: clang-tidy on all sources
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
git ls-files '*.py' | xargs flake8
mypy
mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
tidy=()
for argument in "$@"; do
  case "$argument" in
    --fix-format) clang-format -i "${sources[@]}" ;;
    --all) tidy=(--all) ;;
    *) sed -n '2,/^set/{/^#/s/^# \?//p}' "$0" >&2; exit 2 ;;
  esac
done
clang-format --dry-run --Werror "${sources[@]}"
scripts/clang_tidy.sh "${tidy[@]}"
