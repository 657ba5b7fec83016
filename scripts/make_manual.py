#!/usr/bin/env python3
"""Makes man pages and bash completion from the output of `quadrille --help`.

    scripts/make_manual.py build/quadrille FOLDER     FOLDER/quadrille.1.gz, quadrille-mesh.1.gz, ..., quadrille.bash
    scripts/make_manual.py build/quadrille FILE.md    one page of the manual with all commands
"""

import gzip
import re
import subprocess
import sys
from pathlib import Path

SECTION = re.compile(r"^(\w[\w ]*):$")
ENTRY = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=True).stdout


def parse(text):
    """The text before the usage line, the usage line, and the sections: {"Options": [(term, explanation)]}."""
    head, _, rest = text.partition("Usage: ")
    usage, _, rest = rest.partition("\n")
    sections: dict[str, list[list[str]]] = {}
    entries: list[list[str]] = []
    for line in rest.splitlines():
        heading, entry = SECTION.match(line), ENTRY.match(line)
        if heading:
            entries = sections.setdefault(heading.group(1), [])
        elif entry and not line.startswith("   "):
            entries.append([entry.group(1), entry.group(2) or ""])
        elif line.strip() and entries:
            entries[-1][1] = f"{entries[-1][1]} {line.strip()}".strip()
    return head.strip(), usage.strip(), sections


def roff(text):
    """Escapes text for man: hyphens can be copied as hyphens, and no line is read as a roff request."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def term_of(entry):
    """Formats "-o,--output TEXT REQUIRED": options in bold, the kind of value in italics."""
    options, _, value = entry.partition(" ")
    value = re.sub(r"(:\S+)? ?(REQUIRED|\.\.\.)?$", "", value).strip()
    bold = ", ".join(f"\\fB{roff(option)}\\fR" for option in options.split(","))
    return f"{bold} \\fI{roff(value)}\\fR" if value else bold


def page(name, version, help_text, see):
    """A man page in section 1."""
    about, usage, sections = parse(help_text)
    command = name.replace("quadrille-", "quadrille ")
    lines = [f'.TH {name.upper()} 1 "" "Quadrille {version}" "User Commands"', ".SH NAME",
             f"{roff(name)} \\- {roff(about[0].lower() + about[1:])}", ".SH SYNOPSIS",
             f".B {roff(command)}", roff(usage.removeprefix(command).strip())]
    for heading, entries in sections.items():
        lines.append(f".SH {heading.upper()}")
        for entry, explanation in entries:
            term = f"\\fB{roff(entry)}\\fR" if heading == "Subcommands" else term_of(entry)
            lines += [".TP", term, roff(explanation)]
    lines += [".SH EXIT STATUS", "0 success, 1 failure, 2 incorrect usage, 130 cancelled.", ".SH SEE ALSO",
              ",\n".join(f".BR {roff(other)} (1)" for other in see)]
    return "\n".join(lines) + "\n"


def markdown(pages):
    """One page with all commands, in Markdown."""
    lines = ["# The command", "", "Generated from `quadrille --help`. Lengths are millimeters. Exit codes: 0 success, 1 failure, 2 incorrect",
             "usage, 130 cancelled; an error is one sentence on stderr, and leaves no half-written file."]
    for name, help_text in pages.items():
        about, usage, sections = parse(help_text)
        lines += ["", f"## {name.replace('quadrille-', 'quadrille ')}", "", about[0].upper() + about[1:] + ".", "",
                  "```", usage, "```"]
        for heading, entries in sections.items():
            lines += ["", f"| {heading.lower()} | |", "| --- | --- |"]
            lines += [f"| `{entry}` | {explanation.replace('|', chr(92) + '|')} |" for entry, explanation in entries]
    return "\n".join(lines) + "\n"


def completion(commands):
    """A bash completion script for subcommands, their options, and files."""
    cases = "\n".join(f"    {name}) options='{' '.join(options)}' ;;" for name, options in commands.items())
    return f"""# bash completion for quadrille
_quadrille() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} options=
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{' '.join(commands)} --help --version' -- "$current")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{cases}
  esac
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _quadrille quadrille
"""


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    version = run(program, "--version").split()[-1]
    whole = run(program, "--help")
    names = [entry for entry, _ in parse(whole)[2]["Subcommands"]]
    pages = {"quadrille": whole, **{f"quadrille-{name}": run(program, name, "--help") for name in names}}
    if folder.suffix == ".md":
        folder.write_text(markdown(pages), encoding="utf-8")
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages.items():
        see = [other for other in pages if other != name]
        (folder / f"{name}.1.gz").write_bytes(gzip.compress(page(name, version, text, see).encode(), 9, mtime=0))
    options = {name: sorted({option for entry, _ in parse(pages[f"quadrille-{name}"])[2]["Options"]
                             for option in entry.split(" ")[0].split(",") if option.startswith("--")}) for name in names}
    (folder / "quadrille.bash").write_text(completion(options), encoding="utf-8")


if __name__ == "__main__":
    main()
