#!/usr/bin/env bash
# Installs the large Debian packages that read Quadrille's files in tests/io/consumers_test.py, about 2 GB.
# scripts/install_dependencies.sh installs the small ones.
#
#   scripts/install_consumers.sh           install those that this release of Debian has
#   scripts/install_consumers.sh --list    print the packages and stop
set -euo pipefail

# deal.II in Debian 13 links with mold.
packages=(python3-dolfinx python3-gmsh libdeal.ii-dev mold libmfem-dev python3-sfepy python3-getfem++)

if [[ "${1:-}" == --list ]]; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi
if ! command -v apt-get >/dev/null; then
  echo "error: this system has no apt-get; install the contents of these Debian packages: ${packages[*]}" >&2
  exit 1
fi
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "error: run this as root, or install sudo; packages: ${packages[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -q
found=()
for package in "${packages[@]}"; do
  if apt-cache policy "$package" | grep 'Candidate: [^(]' >/dev/null; then
    found+=("$package")
  else
    echo "$package is not in this release of Debian: left out"
  fi
done
if [[ ${#found[@]} -eq 0 ]]; then exit 0; fi
echo "Installing with apt-get these Debian packages, and what they depend on: ${found[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends -o Dpkg::Use-Pty=0 "${found[@]}"
