#!/usr/bin/env python3
"""Fails each allocation and each system call of the command in turn, in the manner of SQLite's and curl's tests.

torture.py --quadrille build/quadrille --failing-calls LIBRARY [--only JOB/KIND...] [--most 40] [--seed 1] [--memcheck]

For one small job of each command it counts the calls of each kind, in the process and in those that it forks. Then it runs
the job again for each call, or for so many of them, spread evenly, and makes that call fail: it alone, and it and all that
follow. Good ends: exit code 0 and the same files and output as without failures; or 1, 2 or 130 and one sentence on stderr,
an older output as it was, or the whole new one, and no other file in the folder or in TMPDIR. The exit code is 1 if there
is a run that ends otherwise; each is listed with what repeats it (--only mesh/allocate/own/1234/once). --memcheck runs
each job once by valgrind instead.
"""
import argparse
import os
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

KINDS = ["allocate", "write", "read", "open", "rename", "fsync", "close", "mkdir", "mmap"]
PROCESSES = ["own", "forked"]
PATIENCE = 60  # seconds, for busy machines
#: OpenVDB gives each file an identity of its own.
IDENTITY = re.compile(rb"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")
OLDER = b"an older file\n"
COLUMNS = ["good", "errors", "WRONG"]
MODELS = Path(__file__).resolve().parents[2] / "examples" / "models"


@dataclass
class Job:
    """A command, with its input files as Path and the files that it writes."""

    arguments: list
    outputs: list = field(default_factory=list)


def jobs_with(inputs):
    """The jobs by name; `inputs` holds meshes made by prepare()."""
    box, disc, patch, bracket = (MODELS / name for name in ("box.brep", "disc.brep", "bezier_patch.brep", "bracket.step"))
    few = ["--quiet", "--elements-per-diagonal", "6"]
    return {
        "mesh": Job(["mesh", patch, "-o", "out.msh", "--threads", "1", *few], ["out.msh"]),
        "threads": Job(["mesh", box, "-o", "out.inp", "--threads", "2", *few], ["out.inp"]),
        "step": Job(["mesh", bracket, "-o", "out.unv", "--threads", "1", *few], ["out.unv"]),
        "recombine": Job(["recombine", inputs / "quads.msh", "-o", "out.msh", "--threads", "1", "--quiet"], ["out.msh"]),
        "remesh": Job(["remesh", inputs / "quads.msh", "-o", "out.bdf", "--size", "20", "--threads", "1", "--quiet"],
                      ["out.bdf"]),
        "quality": Job(["quality", inputs / "quads.msh"]),
        "info": Job(["info", disc]),
        "midsurface": Job(["midsurface", bracket, "-o", "out.brep", "--quiet"], ["out.brep"]),
        "adapt": Job(["adapt", inputs / "plate.inp", inputs / "plate.frd", "-o", "out.vdb"], ["out.vdb"]),
        "sizes": Job(["sizes", disc, "--write-size-field", "out.vdb", "--threads", "1", *few], ["out.vdb"]),
    }


def write_solution(mesh, result, side=4):
    """A plate of side x side quads, and a solver's result on them as bricks."""
    places = [(10 * column, 10 * row) for row in range(side + 1) for column in range(side + 1)]
    corners = [(a, a + 1, a + side + 2, a + side + 1) for a in range(side * (side + 1)) if a % (side + 1) < side]
    lines = ["*NODE", *(f"{k + 1}, {x}, {y}, 0" for k, (x, y) in enumerate(places)), "*ELEMENT, TYPE=S4"]
    lines += [", ".join(str(k + 1) for k in (number, *quad)) for number, quad in enumerate(corners)]
    mesh.write_text("\n".join(lines) + "\n")
    bricks = [(*places[node], z) for quad in corners for z in (-0.5, 0.5) for node in quad]
    rows = [f" -1{k + 1:10}{x:12.5E}{y:12.5E}{z:12.5E}\n" for k, (x, y, z) in enumerate(bricks)]
    moves = [f" -1{k + 1:10}{1e-5 * x ** 3:12.5E}{0:12.5E}{0:12.5E}\n" for k, (x, _, _) in enumerate(bricks)]
    elements = [f" -1{n + 1:10}{1:5}{0:5}{1:5}\n -2{''.join(f'{8 * n + k + 1:10}' for k in range(8))}\n"
                for n in range(len(corners))]
    result.write_text(f"    1C\n    2C{len(bricks):30}{1:37}\n{''.join(rows)} -3\n    3C{len(corners):30}{1:37}\n"
                      f"{''.join(elements)} -3\n  100CL  101 1.000000000{len(bricks):12}{0:22}{1:5}{1:10}{1:2}\n"
                      f" -4  DISP        4    1\n -5  D1          1    2    1    0\n{''.join(moves)} -3\n 9999\n")


def prepare(quadrille, folder):
    """Input files of the jobs that start from a mesh or a thin solid."""
    write_solution(folder / "plate.inp", folder / "plate.frd")
    subprocess.run([quadrille, "mesh", MODELS / "box.brep", "-o", folder / "quads.msh", "--elements-per-diagonal", "6",
                    "--quiet"], check=True, stdout=subprocess.DEVNULL)


@dataclass
class End:
    """How a run ended."""

    code: int
    said: bytes
    printed: bytes
    files: dict
    left_in_tmpdir: list


def run(arguments, environment, older=(), patience=PATIENCE):
    """Runs a command in a folder of its own, in which the files `older` are there already."""
    with tempfile.TemporaryDirectory(prefix="torture-") as folder:
        work, temporary = Path(folder, "work"), Path(folder, "tmp")
        work.mkdir()
        temporary.mkdir()
        for name in older:
            (work / name).write_bytes(OLDER)
        process = subprocess.Popen(list(map(str, arguments)), cwd=work, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, start_new_session=True,
                                   env={**os.environ, "TMPDIR": str(temporary), **environment})
        try:
            printed, said = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            printed, said = process.communicate()
            process.returncode = -signal.SIGKILL
        files = {path.name: IDENTITY.sub(b"", path.read_bytes()) for path in work.iterdir()}
        return End(process.returncode, said, printed, files, sorted(os.listdir(temporary)))


class Torture:
    """One job, and the library that makes its calls fail."""

    def __init__(self, quadrille, library, job):
        self.command = [quadrille, *job.arguments]
        self.job = job
        self.library = library
        self.reference = run(self.command, {})
        if self.reference.code != 0 or sorted(self.reference.files) != sorted(job.outputs):
            sys.exit(f"error: {' '.join(map(str, self.command))}: {self.reference.said.decode(errors='replace')}")

    def counts(self):
        """The number of calls by (kind, process)."""
        keys = [(kind, process) for process in PROCESSES for kind in KINDS]
        with tempfile.NamedTemporaryFile() as file:
            file.write(bytes(8 * len(keys)))
            file.flush()
            run(self.command, {"LD_PRELOAD": self.library, "QUADRILLE_CALL_COUNTS": file.name})
            numbers = struct.unpack(f"{len(keys)}q", Path(file.name).read_bytes())
        return dict(zip(keys, numbers))

    def fail(self, order):
        """Runs with a call failing: the column that the end counts for, and what is wrong with it."""
        older = self.job.outputs if int(order.split()[2]) % 2 else []
        return self.judged(run(self.command, {"LD_PRELOAD": self.library, "QUADRILLE_FAILING_CALL": order}, older), older,
                           can_say=not order.startswith("write"))

    def judged(self, end, older, can_say):
        said = end.said.decode(errors="replace")
        if end.left_in_tmpdir:
            return "WRONG", f"leaves {end.left_in_tmpdir} in TMPDIR: {said[:200]!r}"
        if end.code == 0:
            if end.printed != self.reference.printed or end.files != self.reference.files:
                return "WRONG", "exit code 0, but other files or output than without failures"
            return "good", ""
        if end.code not in (1, 2, 130):
            return "WRONG", f"exit code {end.code}: {said[:200]!r}"
        lines = said.splitlines()
        one_sentence = len(lines) == 1 and lines[0].startswith("quadrille: ") and "std::" not in said
        if not one_sentence and (can_say or lines):
            return "WRONG", f"exit code {end.code}, not one sentence: {said[:300]!r}"
        allowed = {name: {OLDER, content} if name in older else {content} for name, content in self.reference.files.items()}
        wrong = [name for name, content in end.files.items() if content not in allowed.get(name, ())]
        wrong += [name for name in older if name not in end.files]
        return ("WRONG", f"files {wrong} after: {said[:200]!r}") if wrong else ("errors", "")


def orders(job, key, count, arguments):
    """Which calls to fail: all, or --most of them, one at random in each of as many equal parts; those of --only."""
    random_numbers = random.Random(f"{arguments.seed} {job} {key}")
    parts = min(count, arguments.most)
    for part in range(parts):
        number = random_numbers.randrange(part * count // parts, (part + 1) * count // parts) + 1
        for how in ("once", "always"):
            order = f"{job}/{key}/{number}/{how}"
            if not arguments.only or any(f"{order}/".startswith(f"{only}/") for only in arguments.only):
                yield order
    yield from (only for only in arguments.only if only.count("/") == 4 and only.startswith(f"{job}/{key}/"))


def memcheck(quadrille, jobs):
    """Runs each job by valgrind; whether it found nothing."""
    clean = True
    for name, job in jobs.items():
        end = run(["valgrind", "-q", "--error-exitcode=9", "--undef-value-errors=yes", quadrille, *job.arguments], {},
                  patience=1800)
        good = end.code == 0
        clean = clean and good
        print(f"{name}: {'clean' if good else end.said.decode(errors='replace')[:20000]}", flush=True)
    return clean


def torture(arguments, jobs):
    """Runs all orders; whether all ends are good."""
    total, printed_counts = Counter(), []
    for name, job in jobs.items():
        tortured = Torture(arguments.quadrille, arguments.failing_calls, job)
        for (kind, process), count in tortured.counts().items():
            ends = Counter()
            for order in orders(name, f"{kind}/{process}", count, arguments):
                column, problem = tortured.fail(order.split("/", 1)[1].replace("/", " "))
                ends[column] += 1
                if problem:
                    print(f"{order}: {problem}", flush=True)
            if ends:
                printed_counts.append([name, kind, process, count, *(ends[column] for column in COLUMNS)])
            total += ends
    print("\n| job | call | process | calls |", " | ".join(COLUMNS), "|\n|", " --- |" * (4 + len(COLUMNS)))
    for row in [*printed_counts, ["all", "", "", "", *(total[column] for column in COLUMNS)]]:
        print("|", " | ".join(map(str, row)), "|")
    return total["WRONG"] == 0 and total.total() > 0


def main():
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quadrille", type=os.path.abspath, required=True)
    parser.add_argument("--failing-calls", type=os.path.abspath, help="the library built from failing_calls.cpp")
    parser.add_argument("--only", nargs="*", default=[], help="JOB, JOB/CALL, ... or JOB/CALL/PROCESS/NUMBER/HOW")
    parser.add_argument("--most", type=int, default=40, help="calls to fail of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--memcheck", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="torture-") as folder:
        prepare(arguments.quadrille, Path(folder))
        names = {only.split("/")[0] for only in arguments.only}
        jobs = {name: job for name, job in jobs_with(Path(folder)).items() if not names or name in names}
        clean = memcheck(arguments.quadrille, jobs) if arguments.memcheck else torture(arguments, jobs)
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
