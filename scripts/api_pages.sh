#!/usr/bin/env bash
# Makes the pages of the C++ library's public headers with Doxygen. A warning, such as for an undocumented function, is an
# error.
#
#   scripts/api_pages.sh FOLDER      writes FOLDER/html/index.html
set -euo pipefail
if [[ $# -ne 1 ]]; then
  echo "usage: scripts/api_pages.sh FOLDER" >&2
  exit 2
fi
folder=$(realpath -m "$1")
cd "$(dirname "$(readlink -f "$0")")/.."
if ! command -v doxygen >/dev/null; then
  echo "error: doxygen is missing; install Debian's package doxygen" >&2
  exit 1
fi
mkdir -p "$folder"
# Documents exactly the headers that are installed.
headers=$(sed -n '/^set(PUBLIC_HEADERS/,/)/p' cmake/public_headers.cmake | grep -o '[a-z_0-9/]*\.hpp')
(
  cat docs/Doxyfile
  echo "INPUT = docs/api.md" $headers
  echo "USE_MDFILE_AS_MAINPAGE = docs/api.md"
  echo "OUTPUT_DIRECTORY = $folder"
) | doxygen -
