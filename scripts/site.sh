#!/usr/bin/env bash
# Makes the manual as a web site with mkdocs: docs/, the command's reference from its own help, and the changelog. Adds the
# pages of the C++ library if Doxygen is installed. A broken link is an error.
#
#   scripts/site.sh FOLDER [QUADRILLE]      QUADRILLE: the command (default: build/quadrille)
set -euo pipefail
if [[ $# -lt 1 ]]; then
  echo "usage: scripts/site.sh FOLDER [QUADRILLE]" >&2
  exit 2
fi
folder=$(realpath -m "$1")
cd "$(dirname "$(readlink -f "$0")")/.."
command=$(realpath "${2:-build/quadrille}")
if ! command -v mkdocs >/dev/null; then
  echo "error: mkdocs is missing; install Debian's package mkdocs" >&2
  exit 1
fi
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
cp -r docs "$stage/docs"
rm -f "$stage/docs/Doxyfile" "$stage/docs/bundle.txt"
cp CHANGELOG.md "$stage/docs/changelog.md"
cp mkdocs.yml "$stage/"
/usr/bin/python3 scripts/make_manual.py "$command" "$stage/docs/command.md"
# Files outside docs/ are not part of the site: replace links to them by text.
sed -i -E 's#\[([^]]*)\]\(\.\./([^)]*)\)#\1 (`\2` in the sources)#g' "$stage"/docs/*.md
(cd "$stage" && mkdocs build --quiet --strict --site-dir "$folder")
if command -v doxygen >/dev/null; then
  scripts/api_pages.sh "$stage/api"
  cp -r "$stage/api/html" "$folder/api"
fi
