#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, and runs the tests; arguments go to ctest.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"

scripts/install_dependencies.sh
scripts/build.sh ci
# The tests in FreeCAD's window have one more try: they share a machine and a toolkit with much else.
exec ctest --test-dir build --output-on-failure --parallel "$(nproc)" --repeat until-pass:2 "$@"
