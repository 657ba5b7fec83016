#!/usr/bin/env bash
# Attacks the built command with extreme options, random sizes, damaged files, limits, faults and locales. Prints one table
# at the end. The exit code is 1 if any run ended in a way that tests/attack.py does not allow. Parts for random sizes come
# from ../shared/corpus_parts (or QUADRILLE_PARTS). Without that folder, our own models are meshed.
#
#   scripts/attack.sh                            ten minutes
#   scripts/attack.sh --seconds 60 --seed 7      one minute, with different runs
#   scripts/attack.sh --only sizes/17            repeats one run of a class
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
parts="${QUADRILLE_PARTS:-../shared/corpus_parts}"
more=()
if [[ -d "$parts" ]]; then more=(--parts "$parts"); else echo "NOT RUN on parts: there is no $parts" >&2; fi
[[ -x build/quadrille && -x build/tests/write_models ]] || { echo "error: build first: scripts/build.sh" >&2; exit 1; }
models="$(mktemp -d)"
trap 'rm -rf "$models"' EXIT
build/tests/write_models "$models" >/dev/null
chmod -R a+rX "$models"
export PYTHONDONTWRITEBYTECODE=1
python3 tests/attack.py --quadrille build/quadrille --models examples/models "$models" "${more[@]}" "$@"
