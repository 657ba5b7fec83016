#!/usr/bin/env bash
# Installs what is missing, builds, and runs a job in FreeCAD: the sample, a sheet-metal bracket, from its solid to its middle
# surface, a mesh of quads and the stresses; or the mesh of your own part.
#
#   ./run.sh                          the sample             -> out/sample.FCStd, out/sample.inp, out/sample.png
#   ./run.sh PART.step --size 2       your own part          -> out/PART.FCStd, out/PART.inp, out/PART.png
#   ./run.sh PART.step --help         all options
set -euo pipefail

part="${1:-}"
if [[ -n "$part" && "$part" != -* ]]; then
  shift
  if [[ ! -f "$part" ]]; then
    echo "error: $part: no such file" >&2
    exit 1
  fi
  part=$(readlink -f "$part")
  name=$(basename "${part%.*}")
  job=(examples/mesh_part.py "$part")
else
  part=""
  name=sample
  job=(examples/freecad/sheet_bracket.py)
fi
cd "$(dirname "$(readlink -f "$0")")"

step() { printf '[%d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*"; }
step "1 of 4: Debian packages"
scripts/install_dependencies.sh
step "2 of 4: building; the first time takes minutes"
# Everything that `cmake --install build` installs; the shared library is only linked.
scripts/build.sh release quadrille quadrille_python quadrille_library

step "3 of 4: ${part:-the sample} inside FreeCAD"
export QUADRILLE_COMMAND="$PWD/build/quadrille"
scripts/freecad_python "${job[@]}" --out "out/$name" "$@"
step "4 of 4: the quality of the mesh"
build/quadrille quality "out/$name.inp"
ls -l "out/$name.FCStd" "out/$name.inp" "out/$name.png"
step "done"
