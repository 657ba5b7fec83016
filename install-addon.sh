#!/usr/bin/env bash
# Installs the Quadrille workbench where FreeCAD 0.20, 1.0 and 1.1 look for addons of the user, or removes it.
#
#   ./install-addon.sh                 for every FreeCAD of this user (distribution, AppImage; Flatpak if it is there)
#   ./install-addon.sh --link          a symbolic link instead of a copy, for work on the addon
#   ./install-addon.sh --to FOLDER     into FOLDER/Quadrille (a Mod folder of FreeCAD)
#   ./install-addon.sh --uninstall     with --to as above
#
# The quadrille command stays where it is: if build/quadrille exists, its path is stored in the addon, which uses
# it if there is none on PATH.
set -euo pipefail

here=$(dirname "$(readlink -f "$0")")
mode=install
link=false
targets=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --uninstall) mode=uninstall ;;
    --link) link=true ;;
    --to)
      if [[ $# -lt 2 ]]; then echo "error: --to needs a folder" >&2; exit 2; fi
      targets+=("$2")
      shift
      ;;
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "error: unknown option $1; see --help" >&2; exit 2 ;;
  esac
  shift
done

if [[ ${#targets[@]} -eq 0 ]]; then
  if [[ -n "${FREECAD_USER_HOME:-}" ]]; then
    targets=("$FREECAD_USER_HOME/Mod")
  else
    folders=("${XDG_DATA_HOME:-$HOME/.local/share}/FreeCAD")
    if [[ -d "$HOME/.var/app/org.freecad.FreeCAD" ]]; then
      folders+=("$HOME/.var/app/org.freecad.FreeCAD/data/FreeCAD")
    fi
    for folder in "${folders[@]}"; do
      targets+=("$folder/Mod")
      # From 1.1 on, each version has its own folder if no older FreeCAD has run before.
      for version in "$folder"/v[0-9]*; do
        if [[ -d "$version" ]]; then targets+=("$version/Mod"); fi
      done
    done
  fi
fi

remove() {
  if [[ -L "$1" ]]; then
    rm "$1"
  elif [[ -d "$1" ]]; then
    # Only our own files: another addon of this name would have another package.xml.
    if ! grep -q '<name>Quadrille</name>' "$1/package.xml" 2>/dev/null; then
      echo "error: $1 is not the Quadrille addon: left alone" >&2
      exit 1
    fi
    rm -r "$1"
  else
    return 1
  fi
}

for target in "${targets[@]}"; do
  addon="$target/Quadrille"
  if [[ $mode == uninstall ]]; then
    if remove "$addon"; then echo "Removed $addon"; else echo "Not there: $addon"; fi
    continue
  fi
  mkdir -p "$target"
  if remove "$addon"; then :; fi
  if $link; then
    ln -s "$here/workbench" "$addon"
  else
    mkdir "$addon"
    cp -r "$here/workbench/"{package.xml,Init.py,InitGui.py,quadrille_commands.py,icons,translations,quadrille} "$addon/"
    find "$addon" -name __pycache__ -type d -prune -exec rm -r {} +
    cp "$here/LICENSE" "$addon/"
    if [[ -x "$here/build/quadrille" ]]; then
      echo "$here/build/quadrille" >"$addon/quadrille/command_path"
    fi
  fi
  echo "Installed $addon"
done
if [[ $mode == install && ! -x "$here/build/quadrille" ]] && ! command -v quadrille >/dev/null; then
  echo "The quadrille command is not built yet: ./run.sh builds it" >&2
fi
