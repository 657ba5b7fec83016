#!/usr/bin/env bash
# Quadrille's main job: installs what is missing, builds, and turns a CAD part into an all-quad mesh inside FreeCAD.
#
#   ./run.sh                          the sample part        -> out/sample.FCStd, out/sample.inp, out/sample.png
#   ./run.sh PART.step --size 2       a part of yours        -> out/PART.FCStd, out/PART.inp, out/PART.png
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
else
  part=""
  name=sample
fi
cd "$(dirname "$(readlink -f "$0")")"
: "${part:=$PWD/examples/models/bracket.step}"

scripts/install_dependencies.sh
scripts/build.sh release quadrille quadrille_python

echo "Meshing $part inside FreeCAD"
export QUADRILLE_COMMAND="$PWD/build/quadrille"
scripts/freecad_python examples/mesh_part.py "$part" --out "out/$name" "$@"
build/quadrille quality "out/$name.inp"
ls -l "out/$name.FCStd" "out/$name.inp" "out/$name.png"
