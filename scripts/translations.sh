#!/usr/bin/env bash
# Compiles the translations of the FreeCAD workbench (Qt Linguist: workbench/translations/Quadrille_LANGUAGE.ts), for those who
# change them: the .qm files are in the repository, so that every copy of the addon has them.
#
#   scripts/translations.sh                     compiles them for FreeCAD (.qm)
#   scripts/translations.sh --update [xx ...]   first updates the .ts files from the sources; xx: new languages
#
# Needs lrelease (Debian: qttools5-dev-tools); --update also needs pylupdate5 (pyqt5-dev-tools).
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../workbench"

if [[ "${1:-}" == --update ]]; then
  shift
  for language in "$@"; do
    [[ -e "translations/Quadrille_$language.ts" ]] ||
      printf '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n<TS version="2.0" language="%s"></TS>\n' "$language" \
        >"translations/Quadrille_$language.ts"
  done
  # The texts in the table of settings and the statuses are data: mark them in a file that pylupdate5 reads.
  marks=$(mktemp --suffix .py)
  trap 'rm -f "$marks"' EXIT
  PYTHONDONTWRITEBYTECODE=1 python3 - >"$marks" <<'PYTHON'
import ast, importlib.util, pathlib, sys, types
package = types.ModuleType("quadrille"); package.__path__ = ["quadrille"]; sys.modules["quadrille"] = package
from quadrille.core.setting_table import SETTINGS, property_help, property_kind, words
texts = {text for setting in SETTINGS if setting["property"] for text in (
    setting["label"], property_help(setting), setting["otherwise"],
    *(words(setting) if property_kind(setting) == "App::PropertyEnumeration" else ())) if text}
for text in sorted(texts):
    print(f"QT_TRANSLATE_NOOP({'QuadrilleSettings'!r}, {text!r})")
tree = ast.parse(pathlib.Path("quadrille/document/state.py").read_text())
values = {node.targets[0].id: node.value.value for node in tree.body if isinstance(node, ast.Assign)
          and isinstance(node.value, ast.Constant) and node.targets[0].id.isupper() and not node.targets[0].id.endswith("TYPE")}
for text in values.values():
    print(f"QT_TRANSLATE_NOOP({'QuadrilleStatus'!r}, {text!r})")
PYTHON
  sources=(InitGui.py quadrille/{core,document,solvers,features,gui}/*.py "$marks")
  for file in translations/*.ts; do pylupdate5 -noobsolete "${sources[@]}" -ts "$file"; done
  sed -i '/<location /d' translations/*.ts
fi

lrelease=$(command -v lrelease || true)
if [[ -z "$lrelease" ]]; then
  echo "error: lrelease is not on PATH; scripts/install_dependencies.sh --tests installs it" >&2
  exit 127
fi
for file in translations/*.ts; do QT_SELECT=qt5 "$lrelease" -silent "$file" -qm "${file%.ts}.qm"; done
