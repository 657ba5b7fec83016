#!/usr/bin/env python3
"""Tries the program for Windows under wine beside the one for Linux, and prints a table. The exit code is 1 if a row fails.

    tests/windows/run.py quadrille.exe [--linux build/quadrille] [--parts FOLDER...] [--most N]

Meshes must have the same elements on both systems; where floating point differs, the table tells in how many parts and by how
much. `scripts/windows.sh test` calls it.
"""

import argparse
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SAMPLE = ROOT / "examples" / "models"
ENVIRONMENT = {**os.environ, "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml=",
               "LC_ALL": "C.UTF-8"}  # wine takes arguments in the encoding of the locale


def at_windows(path):
    """The path of a file of this machine inside wine."""
    return "Z:" + str(Path(path).absolute()).replace("/", "\\")


class Table:
    def __init__(self):
        self.failed = 0

    def row(self, what, good, told):
        """`good` is None where it was not tried."""
        self.failed += good is not None and not good
        print(f"| {what} | {'not tried' if good is None else 'yes' if good else '**no**'} | {told} |", flush=True)


class Program:
    """One of the two programs: arguments that are paths are given in its own way."""

    def __init__(self, words, windows):
        self.words, self.windows = words, windows

    def arguments(self, arguments):
        return [*self.words, *(at_windows(a) if self.windows and isinstance(a, Path) else str(a) for a in arguments)]

    def start(self, arguments, **options):
        return subprocess.Popen(self.arguments(arguments), env=ENVIRONMENT, stdin=options.pop("stdin", subprocess.DEVNULL),
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def run(self, *arguments, timeout=600, cwd=None):
        """The exit code, what was printed, the last line of stderr, seconds of CPU."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = self.start(arguments, cwd=cwd)
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return -1, "", "hangs", 0.0
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        lines = err.decode(errors="replace").strip().splitlines()
        return (process.returncode, out.decode(errors="replace"), lines[-1] if lines else "",
                after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def parts_of(inp):
    """The coordinates in an .inp file, and all its other lines."""
    nodes, rest, reading = [], [], False
    for line in Path(inp).read_text(encoding="utf-8").splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            reading = line.upper().startswith("*NODE") and "PRINT" not in line.upper() and "FILE" not in line.upper()
        if reading and not line.startswith("*"):
            nodes.append([float(word) for word in line.split(",")[1:4]])
        else:
            rest.append(line)
    return nodes, rest


def compare(one, other):
    """Whether two meshes have the same elements and groups, the largest distance of nodes, numbers of lines that differ."""
    (a, b), (c, d) = parts_of(one), parts_of(other)
    apart = max((sum((p - q) ** 2 for p, q in zip(x, y)) ** 0.5 for x, y in zip(a, c)), default=0.0) if len(a) == len(c) else -1
    return b == d and len(a) == len(c), apart, (len(a), len(c))


def size_of(path):
    nodes, _ = parts_of(path)
    return max(max(p[i] for p in nodes) - min(p[i] for p in nodes) for i in range(3)) if nodes else 1.0


def corpus(table, linux, windows, folder, most, scratch):
    files = sorted(p for p in folder.rglob("*") if p.suffix.lower() in (".step", ".stp", ".brep", ".iges", ".igs"))[:most]
    same, told, cpu, lost = 0, [], [0.0, 0.0], []
    for file in files:
        outputs, codes = [], []
        for i, program in enumerate((linux, windows)):
            out = scratch / f"{i}.inp"
            out.unlink(missing_ok=True)
            code, _, line, seconds = program.run("mesh", file, "-o", out, "--elements-per-diagonal", 60, "--time-limit", 300)
            cpu[i] += seconds
            codes.append(code)
            outputs.append((out, line))
        if codes[0] != codes[1]:
            lost.append(f"{file.name}: {codes[0]} and {codes[1]} ({outputs[1][1]})")
        elif codes[0] != 0:
            same += 1
        else:
            equal, apart, counts = compare(outputs[0][0], outputs[1][0])
            same += equal
            if not equal:
                told.append((abs(counts[0] - counts[1]) / max(counts), file.name, counts))
    worst = max(told, default=(0, "", ()))
    table.row(f"`{folder.name}`, {len(files)} parts at a sixtieth", not lost,
              f"{same} with the same elements" + (f"; others differ by up to {100 * worst[0]:.2g} % of the nodes" if told else "")
              + ("; ends differ: " + "; ".join(lost) if lost else ""))
    ratio = cpu[1] / max(cpu[0], 1e-9)
    table.row("CPU time beside Linux", ratio <= 2, f"{cpu[1]:.0f} s for {cpu[0]:.0f} s, {ratio:.2f} times")


def bad_inputs(scratch):
    """Arguments that must end with one sentence."""
    box = SAMPLE / "bracket.step"
    text = scratch / "text.step"
    text.write_text("this is no CAD file")
    empty = scratch / "empty.step"
    empty.touch()
    out = scratch / "bad.inp"
    return [
        [], ["mesh"], ["nothing"], ["mesh", "none.step", "-o", out], ["mesh", text, "-o", out], ["mesh", empty, "-o", out],
        ["mesh", scratch, "-o", out], ["mesh", box], ["mesh", box, "-o", scratch / "bad.xyz"],
        ["mesh", box, "-o", scratch / "nowhere" / "bad.inp"], ["mesh", box, "-o", box],
        ["mesh", box, "-o", out, "--size-max", -1], ["mesh", box, "-o", out, "--size-max", "nan"],
        ["mesh", box, "-o", out, "--size-max", 1e-9], ["mesh", box, "-o", out, "--size-max", "a"],
        ["mesh", box, "-o", out, "--segments", "Edge99=4"], ["mesh", box, "-o", out, "--segments", "Edge1"],
        ["mesh", box, "-o", out, "--order", 3], ["mesh", box, "-o", out, "--threads", -2],
        ["mesh", box, "-o", out, "--size-field", "none.vdb"], ["mesh", box, "-o", out, "--size-field", text],
        ["mesh", box, "-o", scratch / "bad.med"], ["mesh", box, "-o", scratch / "bad.vtu"],
        ["mesh", box, "-o", out, "--picture", scratch / "bad.png"], ["quality", text], ["info", scratch / "none.brep"],
    ]


def errors(table, windows, scratch):
    cases, wrong = bad_inputs(scratch), []
    for case in cases:
        code, _, line, _ = windows.run(*case, timeout=60)
        if code not in (1, 2) or not line.startswith("quadrille: ") or (scratch / "bad.inp").exists():
            wrong.append(f"{' '.join(map(str, case))[-60:]}: {code} {line}")
    table.row(f"{len(cases)} bad inputs end with an error message", not wrong, "; ".join(wrong) or "exit codes 1 and 2, nothing written")
    whole = (SAMPLE / "bracket.step").read_bytes()
    wrong, drawn = [], random.Random(1)
    for i in range(20):
        damaged = bytearray(whole)
        for _ in range(1 + 5 * i):
            damaged[drawn.randrange(len(damaged))] = drawn.randrange(256)
        file = scratch / "damaged.step"
        file.write_bytes(bytes(damaged[:len(damaged) * (20 - i % 5) // 20]))
        code, _, line, _ = windows.run("mesh", file, "-o", scratch / "damaged.inp", "--time-limit", 60, timeout=90)
        if code not in (0, 1, 2) or (code != 0 and not line.startswith("quadrille: ")):
            wrong.append(f"{i}: {code} {line}")
    table.row("20 damaged files", not wrong, "; ".join(wrong) or "a mesh or an error message")


def large(scratch, out):
    return ["mesh", SAMPLE / "bracket.step", "-o", scratch / out, "--elements-per-diagonal", 900]


def ends(table, windows, scratch):
    start = time.time()
    windows.run("--version")
    starting = time.time() - start  # of wine and of the program, before it looks at the clock
    start = time.time()
    code, _, line, _ = windows.run(*large(scratch, "limit.inp"), "--time-limit", 2)
    seconds = time.time() - start - starting
    table.row("a time limit of 2 s", code == 1 and "time limit" in line and seconds < 5 and not (scratch / "limit.inp").exists(),
              f"{line} ({seconds:.1f} s, and {starting:.1f} s to start under wine)")

    process = windows.start([*large(scratch, "input.inp"), "--end-with-input"], stdin=subprocess.PIPE)
    time.sleep(3)
    process.stdin.close()
    start = time.time()
    process.wait(30)
    table.row("the end of its input", time.time() - start < 4 and not (scratch / "input.inp").exists(),
              f"ended after {time.time() - start:.1f} s with exit code {process.returncode}")

    process = windows.start(large(scratch, "interrupt.inp"), start_new_session=True)
    time.sleep(3)
    start = time.time()
    process.send_signal(signal.SIGINT)
    try:
        process.wait(30)
    except subprocess.TimeoutExpired:
        process.kill()
    table.row("Ctrl-C", time.time() - start < 4 and not (scratch / "interrupt.inp").exists(),
              f"ended after {time.time() - start:.1f} s with exit code {process.returncode}")

    folder = scratch / "killed"
    folder.mkdir()
    target, work = folder / "killed.inp", ["mesh", SAMPLE / "bracket.step", "--elements-per-diagonal", 300, "-o"]
    start = time.time()
    windows.run(*work, target)
    seconds, whole, wrong = time.time() - start, target.read_bytes(), []
    for part in (0.3, 0.6, 0.9, 0.97):
        target.write_text("as before")
        process = windows.start([*work, target])
        time.sleep(part * seconds)
        process.kill()
        process.wait()
        time.sleep(1)
        wrong += [name for name in os.listdir(folder) if name != "killed.inp"]
        if target.read_bytes() not in (b"as before", whole):
            wrong.append("half a file")
    table.row("killed at four moments", not wrong, "; ".join(wrong) or "the older or the whole new file, no other")


def places(table, windows, scratch):
    wrong = []
    long = scratch
    while len(str(long)) < 290:
        long = long / ("folder with spaces %d" % len(str(long)))
    for folder in (scratch / "with spaces", scratch / "Größe Übermaß ñ 网格", long):
        folder.mkdir(parents=True)
        part, out = folder / "Gehäuse 1.step", folder / "Netz ä.inp"
        shutil.copy(SAMPLE / "bracket.step", part)
        code, _, line, _ = windows.run("mesh", part, "-o", out, "--report", folder / "report.json")
        if code != 0 or not out.exists() or "Gehäuse" not in (folder / "report.json").read_text(encoding="utf-8"):
            wrong.append(f"{folder.name[:20]} ({len(str(out))} letters): {code} {line}")
    table.row("paths with spaces, umlauts and Chinese, of 300 letters", not wrong, "; ".join(wrong) or "read and written")

    crlf = scratch / "crlf.step"
    crlf.write_bytes((SAMPLE / "bracket.step").read_bytes().replace(b"\r\n", b"\n").replace(b"\n", b"\r\n"))
    codes = [windows.run("mesh", file, "-o", scratch / f"{name}.msh")[0]
             for file, name in ((crlf, "crlf"), (SAMPLE / "bracket.step", "lf"))]
    good = codes == [0, 0]
    if good:
        text = (scratch / "lf.msh").read_bytes()
        good = b"\r" not in text
        (scratch / "back.msh").write_bytes(text.replace(b"\n", b"\r\n"))
        code, printed, line, _ = windows.run("quality", scratch / "back.msh")
        good = good and code == 0 and "quad" in printed
    table.row("files with CRLF: STEP, .msh", good, "read; written with LF as on Linux" if good else f"{codes} {line if codes == [0, 0] else ''}")

    sizes = scratch / "sizes.vdb"
    first = windows.run("mesh", SAMPLE / "bracket.step", "-o", scratch / "a.inp", "--size-on", "Face1=0.5", "--write-size-field",
                        sizes)
    second = windows.run("mesh", SAMPLE / "bracket.step", "-o", scratch / "b.inp", "--size-field", sizes)
    table.row("sizes written as .vdb and read again, in a child process", first[0] == second[0] == 0, first[2] or second[2] or "both")

    readonly = scratch / "readonly"
    readonly.mkdir()
    readonly.chmod(0o555)
    if os.geteuid() == 0:
        table.row("a folder that cannot be written to", None, "root may write everywhere")
    else:
        code, _, line, _ = windows.run("mesh", SAMPLE / "bracket.step", "-o", readonly / "x.inp")
        table.row("a folder that cannot be written to", code in (1, 2) and line.startswith("quadrille: "), line)
    readonly.chmod(0o755)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--linux", type=Path, default=ROOT / "build" / "quadrille")
    parser.add_argument("--parts", type=Path, nargs="*", default=[ROOT.parent / "shared" / name for name in ("corpus", "corpus_parts")])
    parser.add_argument("--most", type=int, default=1000, help="parts of each folder")
    given = parser.parse_args()
    table = Table()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        ENVIRONMENT.setdefault("WINEPREFIX", str(scratch / "wine"))
        windows, linux = Program([shutil.which("wine64") or "/usr/lib/wine/wine64", str(given.program)], True), \
            Program([str(given.linux)], False)
        print("| what | passed | output |\n| --- | --- | --- |")
        code, out, line, _ = windows.run("--version")
        table.row("`--version`", code == 0, out.strip() or line)
        code, _, line, _ = windows.run("mesh", SAMPLE / "bracket.step", "-o", scratch / "a.inp", "-o", scratch / "a.msh",
                                       "--report", scratch / "a.json")
        told = json.loads((scratch / "a.json").read_text()) if code == 0 else {}
        table.row("the sample", code == 0, line or f"{told['counts']['quads']} quads")
        errors(table, windows, scratch)
        ends(table, windows, scratch)
        places(table, windows, scratch)
        for folder in given.parts:
            if folder.is_dir() and given.linux.exists():
                corpus(table, linux, windows, folder, given.most, scratch)
            else:
                print(f"NOT RUN: {folder} beside {given.linux}", file=sys.stderr)
        subprocess.run([shutil.which("wineserver") or "/usr/lib/wine/wineserver64", "-k"], env=ENVIRONMENT, check=False)
    sys.exit(1 if table.failed else 0)


if __name__ == "__main__":
    main()
