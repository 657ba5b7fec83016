#!/usr/bin/env bash
# Attacks the built command: extreme options, random sizes, damaged files, limits, faults and locales, one table at the
# end, exit code 1 if anything ended as it must not (tests/attack.py says what that is). Parts for random sizes come from
# ../shared/corpus_parts (or QUADRILLE_PARTS); without that folder, our own models are meshed.
#
#   scripts/attack.sh                            ten minutes
#   scripts/attack.sh --seconds 60 --seed 7      a minute, with other runs
#   scripts/attack.sh --only sizes/17            one run of a class again
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
