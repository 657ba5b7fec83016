#!/usr/bin/env bash
# Installs the Debian packages needed to build and run Quadrille (Debian 12, 13 and unstable, and derivatives). Lists them
# before installing. Safe to run again: does nothing if all are installed.
#
#   scripts/install_dependencies.sh           install what is missing for the command, the Python module and FreeCAD
#   scripts/install_dependencies.sh --tests   and for the tests, benchmarks, packages and the manual
#   scripts/install_dependencies.sh [--tests] --list    print the packages and stop
set -euo pipefail

packages=(
  # build
  ca-certificates git build-essential cmake ninja-build ccache pkg-config
  # CAD: OpenCASCADE
  libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev libocct-data-exchange-dev
  libocct-ocaf-dev
  # sizing field, triangulation, threads, small libraries
  libopenvdb-dev libboost-iostreams-dev libcgal-dev libtbb-dev libeigen3-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev
  # mesh files and pictures; Xvfb gives VTK a display on machines without a screen
  libmed-dev libmedc-dev libhdf5-dev libvtk9-dev libx11-dev xvfb xauth fonts-dejavu-core
  # Python module
  pybind11-dev python3 python3-dev python3-numpy
  # the program that uses the meshes
  freecad python3-matplotlib
)
test_packages=(
  libgtest-dev gmsh libxtst6
  # translations of the FreeCAD workbench: lrelease, pylupdate5
  qttools5-dev-tools pyqt5-dev-tools
  # read written files back in the tests; scripts/install_consumers.sh installs the large ones
  python3-meshio python3-h5py python3-vtk9 libmed-tools
  # packages, bundles and the manual
  patchelf dpkg-dev lintian doxygen mkdocs flake8 mypy
)
# Skipped if a release of Debian does not have them (Debian 13 has no CalculiX). bench/paper computes the optimal pairing
# with LEMON; `quadrille.batch --scheduler` and its test need python3-distributed.
optional=(calculix-ccx)
test_optional=(calculix-cgx liblemon-dev python3-distributed)

list=false
for argument in "$@"; do
  case "$argument" in
    --list) list=true ;;
    --tests)
      packages+=("${test_packages[@]}")
      optional+=("${test_optional[@]}")
      ;;
    *)
      echo "usage: scripts/install_dependencies.sh [--tests] [--list]" >&2
      exit 2
      ;;
  esac
done
if $list; then
  printf '%s\n' "${packages[@]}" "${optional[@]}"
  exit 0
fi

is_installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" == installed ]]; }
is_available() { apt-cache policy "$1" 2>/dev/null | grep 'Candidate: [^(]' >/dev/null; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
wanted=()
for package in "${optional[@]}"; do
  is_installed "$package" || wanted+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  found=()
  for package in "${wanted[@]}"; do
    if is_available "$package"; then found+=("$package"); fi
  done
  wanted=("${found[@]}")
  if [[ ${#wanted[@]} -eq 0 ]]; then
    echo "All Debian packages that Quadrille needs are installed."
    exit 0
  fi
fi

if ! command -v apt-get >/dev/null; then
  echo "error: this system has no apt-get; install the contents of these Debian packages: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "error: run this as root, or install sudo; missing packages: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing with apt-get these Debian packages, and what they depend on:"
printf '  %s\n' "${missing[@]}" "${wanted[@]}"
"${as_root[@]}" apt-get update -q
for package in "${wanted[@]}"; do
  if is_available "$package"; then
    missing+=("$package")
  else
    echo "$package is not in this release of Debian: left out"
  fi
done
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends -o Dpkg::Use-Pty=0 "${missing[@]}"
