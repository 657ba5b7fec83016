#!/usr/bin/env python3
"""Attacks the command as a hostile user and a sick machine do, and counts how it ends.

attack.py --quadrille build/quadrille [--seconds 600 | --runs 15] [--seed 1] [--models FOLDER...] [--only CLASS/NUMBER]

Good ends: exit code 0 and a valid mesh; or 1, 2 or 130, one sentence on stderr and no file. Counted are meshes, told
errors, told crashes (of the CAD library), and what must not be: ends untold (a signal, silence, more than one line),
late ones (a refusal after more than 5 s of CPU or 2 GB, a run that does not end), invalid meshes (also one whose bytes
depend on threads or locale), and files left over. The exit code is 1 if there is one of these; each is listed with the
command that repeats it. What run NUMBER of a class does follows from the seed alone.
"""
import argparse
import concurrent.futures
import itertools
import json
import math
import os
import random
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

import mutate

LATE_SECONDS, LATE_BYTES = 5.0, 2 << 30  # of CPU and of memory, for a refusal
PATIENCE = 600  # seconds of wall time, for busy machines
TIME_LIMIT = 20
GIGABYTE = 1 << 30
#: Users that nobody is. Each run under a limit on processes has one of its own, since the limit counts a user's.
NOBODIES = itertools.cycle(range(20000 + os.getpid() % 20000, 60000))
#: What users add to sizes.
WAYS = [["--imprint"], ["--proximity", 2], ["--gradation", "space"], ["--keep-features"],
        ["--aspect", 1], ["--rings", 2], ["--chord-error", "3%"], ["--strict"]]
COLUMNS = ["meshes", "reported errors", "reported crashes", "UNREPORTED", "late", "invalid", "left over"]


@dataclass
class Run:
    """One start of the command in a folder of its own, and how it ended."""

    arguments: list
    folder: Path
    expected: tuple = ()  # files that a good run leaves beside those that were there
    limits: dict = field(default_factory=dict)  # resource.RLIMIT_x -> (soft, hard)
    environment: dict = field(default_factory=dict)
    kill_after: float = None  # seconds until kill_signal
    kill_signal: int = signal.SIGKILL
    closed: tuple = ()  # descriptors that are closed at the start
    as_nobody: bool = False
    prefix: tuple = ()
    user: int = field(default_factory=lambda: next(NOBODIES))
    code: int = 0
    message: str = ""
    cpu: float = 0
    peak: int = 0
    hangs: bool = False

    def start(self, quadrille):
        before = set(os.listdir(self.folder))
        # A pipe: limits on the size of files do not hold for it.
        process = subprocess.Popen(
            [*self._as_user(), *self.prefix, quadrille, *map(str, self.arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env={**os.environ, **self.environment},
            start_new_session=True, preexec_fn=self._prepare)
        said = []
        reader = threading.Thread(target=lambda: said.append(process.stderr.read()), daemon=True)
        reader.start()
        self._wait(process)
        reader.join(10)
        self.message = b"".join(said).decode(errors="replace")
        process.stderr.close()
        self.left = sorted(set(os.listdir(self.folder)) - before)
        return self

    def _prepare(self):
        for limit, values in self.limits.items():
            resource.setrlimit(limit, values)
        for descriptor in self.closed:
            os.close(descriptor)

    def _as_user(self):
        """Limits on processes do not hold for root, who becomes another user that may read what root may."""
        if not self.as_nobody or os.geteuid() != 0:
            return []
        kept = "-all,+dac_override"
        return ["setpriv", f"--reuid={self.user}", f"--regid={self.user}", "--clear-groups", f"--inh-caps={kept}",
                f"--ambient-caps={kept}"]

    def _wait(self, process):
        start, sent = time.monotonic(), False
        while True:
            identity, status, usage = os.wait4(process.pid, os.WNOHANG)
            if identity:
                break
            passed = time.monotonic() - start
            if self.kill_after is not None and passed > self.kill_after and not sent:
                os.kill(process.pid, self.kill_signal)
                sent = True
            if passed > PATIENCE:
                self.hangs = True
                os.kill(process.pid, signal.SIGKILL)
            time.sleep(0.002 if passed < 0.2 else 0.02)
        process.returncode = self.code = os.waitstatus_to_exitcode(status)
        self.cpu, self.peak = usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024

    def killed_by_us(self):
        return self.kill_after is not None and self.code == -self.kill_signal

    def end(self):
        """The column that the end counts for, and what is wrong with it."""
        if self.hangs:
            return "late", f"has not ended after {PATIENCE} s"
        if self.killed_by_us():
            return self._with_files("reported errors")
        lines = self.message.splitlines()
        if self.code == 0:
            return self._mesh_end()
        if self.code not in (1, 2, 130):
            by_loader = self.code == 127 and "error while loading shared libraries" in self.message
            if not by_loader:
                return "UNREPORTED", f"exit code {self.code}: {self.message[:200]}"
        elif 2 not in self.closed and (len(lines) != 1 or not lines[0].startswith("quadrille: ")):
            return "UNREPORTED", f"exit code {self.code}, not one sentence: {self.message[:200]!r}"
        elif "without a description" in self.message:
            return "UNREPORTED", self.message
        elif self.cpu > LATE_SECONDS and "time limit" not in self.message and not self.limits and self.kill_after is None:
            return "late", f"{self.cpu:.1f} s of CPU until: {self.message[:200]}"
        elif self.peak > LATE_BYTES and not self.limits:  # with limits, --force may take what they leave
            return "late", f"{self.peak / GIGABYTE:.1f} GB until: {self.message[:200]}"
        return self._with_files("reported crashes" if "crashed" in self.message else "reported errors")

    def _with_files(self, column):
        # Whole files stay where what comes after them fails.
        extra = [name for name in self.left if name not in self.expected or problem_of_file(self.folder / name)]
        return (column, "") if not extra else ("left over", f"leaves {extra} after: {self.message[:200]}")

    def _mesh_end(self):
        if sorted(self.expected) != self.left:
            return ("left over" if set(self.expected) < set(self.left) else "invalid",
                    f"leaves {self.left}, not {sorted(self.expected)}")
        for name in self.expected:
            problem = problem_of_file(self.folder / name)
            if problem:
                return "invalid", f"{name}: {problem}"
        return "meshes", ""


def problem_of_file(path):
    if path.stat().st_size == 0:
        return "is empty"
    if path.suffix == ".msh":
        return problem_of_mesh(path)
    if path.suffix == ".json":
        report = json.loads(path.read_text())
        if report["counts"]["triangles"] or report["quality"]["inverted"]:
            return f"{report['counts']['triangles']} triangles, {report['quality']['inverted']} inverted quads"
    elif path.suffix in (".inp", ".bdf") and b"\n*INCLUDE" in path.read_bytes().upper():
        return "holds a card of its input's name"
    return ""


def problem_of_mesh(path):
    """What is wrong with the elements of a .msh 2.2 file: in a face, each side comes once in each direction, no two
    nodes lie on one place (bodies may touch), and no side is shorter than 1e-9 of the mesh's largest extent."""
    lines = iter(path.read_text().splitlines())
    points, sides, node_at, quads = {}, set(), {}, 0
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                number, *place = next(lines).split()
                points[number] = tuple(map(float, place))
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                _, kind, tags, face, *rest = next(lines).split()
                if kind in ("2", "9"):
                    return "holds a triangle"
                if kind not in ("3", "16"):
                    continue
                quads += 1
                corners = rest[int(tags) - 1 :][:4]
                if len(set(corners)) < 4:
                    return f"a quad with one node twice: {corners}"
                if any(node_at.setdefault((face, points[node]), node) != node for node in corners):
                    return f"two nodes of face {face} on one place"
                for side in zip(corners, corners[1:] + corners[:1]):
                    if (face, side) in sides:
                        return f"the side {side} twice on face {face}"
                    sides.add((face, side))
    least = 1e-9 * largest_extent(points.values()) if points else 0
    for face, (a, b) in sides:
        if math.dist(points[a], points[b]) < least:
            return f"the side {a} {b} of face {face} has no length"
    if quads == 0:
        return "holds no quad"
    finite = all(abs(x) < 1e300 for place in points.values() for x in place)
    return "" if finite else "a node without a finite place"


def triangles_of_mesh(path, disorder, rng):
    """The places of a .msh 2.2 file, and its quads cut in two; a share of the triangles is turned over or missing."""
    lines = iter(path.read_text().splitlines())
    points, number_of, triangles = [], {}, []
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                name, *place = next(lines).split()
                number_of[name] = len(points)
                points.append(tuple(map(float, place)))
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                _, kind, tags, *rest = next(lines).split()
                if kind == "3":
                    a, b, c, d = (number_of[node] for node in rest[int(tags) :])
                    triangles += [(a, b, c), (a, c, d)]
    kept = []
    for triangle in triangles:
        kind = rng.random() < disorder and rng.randrange(3)
        if kind is False or kind < 2:
            kept.append(triangle[::-1] if kind else triangle)
    return points, kept


def largest_extent(points):
    return max(max(p[axis] for p in points) - min(p[axis] for p in points) for axis in range(3))


def stl_of(points, triangles):
    corners = "".join("outer loop\n" + "".join("vertex %.9g %.9g %.9g\n" % points[node] for node in triangle) +
                      "endloop\n" for triangle in triangles)
    return ("solid a\n" + corners.replace("outer", "facet normal 0 0 0\nouter").replace("endloop", "endloop\nendfacet") +
            "endsolid a\n").encode()


def obj_of(points, triangles):
    return ("".join("v %.9g %.9g %.9g\n" % point for point in points) +
            "".join("f %d %d %d\n" % tuple(node + 1 for node in triangle) for triangle in triangles)).encode()


def ply_of(points, triangles):
    return (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n" +
            "".join("%.9g %.9g %.9g\n" % point for point in points) +
            "".join("3 %d %d %d\n" % triangle for triangle in triangles)).encode()


SURFACES = {"stl": stl_of, "obj": obj_of, "ply": ply_of}


class Attack:
    """Makes run NUMBER of each class. A class is a method that gives the ends of its runs."""

    def __init__(self, quadrille, own_models, parts, locales):
        self.quadrille, self.own, self.parts, self.locales = quadrille, own_models, parts, locales
        self.small_disk = can_mount()

    def mesh(self, folder, model, *options, **more):
        run = Run(["mesh", model, "-o", "a.msh", "--quiet", *options], folder, **{"expected": ("a.msh",), **more})
        return run.start(self.quadrille)

    def options(self, rng, folder):
        """Extreme options."""
        values = ["0", "-1", "nan", "inf", "", "1e-300", "1e-9", "1e-4", "0.001", "0.5", "1", "7", "1e4", "1e9", "1e300", "x"]
        names = ["--size", "--elements-per-diagonal", "--size-min", "--curvature", "--growth", "--merge-tiny", "--sew",
                 "--order", "--threads", "--msh-version"]
        chosen = rng.sample(names, rng.choice([1, 1, 2, 3]))
        arguments = [text for name in chosen for text in (name, rng.choice(values))]
        if rng.random() < 0.4:
            kind, number = rng.choice(["Face", "Edge", "Vertex"]), rng.choice([0, 1, 1, 1, 2, 3, 99])
            arguments += ["--size-on", f"{kind}{number}={rng.choice(values)}"]
        if rng.random() < 0.1:
            arguments += ["--faces", rng.choice(["Face1", "Face0", "Face1,Face1", "Face99999999999", "", "Edge1"])]
        arguments += rng.sample(["--force", "--partial"], rng.choice([0, 0, 0, 1]))
        limits = {resource.RLIMIT_AS: (4 * GIGABYTE, 4 * GIGABYTE)} if "--force" in arguments else {}
        yield self.mesh(folder, rng.choice(self.own), "--time-limit", TIME_LIMIT, *arguments, limits=limits).end()

    def sizes(self, rng, folder):
        """Random sizes in various ways, and the same bytes from one thread and from three."""
        options = ["--elements-per-diagonal", f"{10 ** rng.uniform(0.5, 1.85):.4g}", "--order", rng.choice([1, 1, 2]),
                   "--strategy", rng.choice(["subdivide", "subdivide", "direct"]), "--time-limit", 3 * TIME_LIMIT]
        if rng.random() < 0.3:
            options += ["--growth", f"{10 ** rng.uniform(-1.5, 0.5):.3g}"]
        if rng.random() < 0.3:
            options += ["--curvature", f"{rng.choice([0, 6, 20, 40])}"]
        for way in rng.sample(WAYS, rng.choice([0, 1, 2])):
            options += way
        model = rng.choice(self.parts)
        run = self.mesh(folder, model, *options, "--threads", 1, "--report", "r.json", expected=("a.msh", "r.json"))
        column, problem = run.end()
        # The files are sound.
        yield ("UNREPORTED", run.message) if column == "reported crashes" else (column, problem)
        if run.code == 0 and rng.random() < 0.25:
            first = (folder / "a.msh").read_bytes()
            os.unlink(folder / "a.msh")
            again = self.mesh(folder, model, *options, "--threads", 3)
            column, problem = again.end()
            if column == "meshes" and (folder / "a.msh").read_bytes() != first:
                column, problem = "invalid", "other bytes from three threads"
            yield column, problem

    def mutations(self, rng, folder):
        """Damaged CAD files, and damaged meshes."""
        small = [model for model in self.own + self.parts if model.stat().st_size < 400000]
        model = rng.choice(small)
        mutation = rng.choice(mutate.MUTATIONS)
        if rng.random() < 0.2:
            self.mesh(folder, model, "--elements-per-diagonal", 8, "--time-limit", TIME_LIMIT)
            if not (folder / "a.msh").exists():
                return
            damaged = folder / "damaged.msh"
            damaged.write_bytes(mutation((folder / "a.msh").read_bytes(), rng))
            os.unlink(folder / "a.msh")
            run = Run(["quality", damaged], folder).start(self.quadrille)
            yield run.end() if run.code else ("meshes", "")
            return
        damaged = folder / ("damaged" + model.suffix)
        damaged.write_bytes(mutation(model.read_bytes(), rng))
        yield self.mesh(folder, damaged, "--elements-per-diagonal", 15, "--time-limit", TIME_LIMIT).end()

    def surfaces(self, rng, folder):
        """Meshes of triangles and quads, some with damage, meshed anew or paired."""
        model = rng.choice(self.own + self.parts[:1])
        self.mesh(folder, model, "--elements-per-diagonal", rng.choice([6, 12, 30]), "--time-limit", TIME_LIMIT)
        if not (folder / "a.msh").exists():
            return
        triangles = triangles_of_mesh(folder / "a.msh", rng.random() < 0.3 and rng.choice([0.01, 0.1, 0.5]) or 0, rng)
        os.unlink(folder / "a.msh")
        ending = rng.choice(["stl", "obj", "ply"])
        surface = folder / f"surface.{ending}"
        surface.write_bytes(SURFACES[ending](*triangles))
        if rng.random() < 0.4:
            surface.write_bytes(rng.choice(mutate.MUTATIONS)(surface.read_bytes(), rng))
        options = ["--feature-angle", rng.choice([0, 5, 40, 90, 180])] if rng.random() < 0.4 else []
        if rng.random() < 0.2:
            options += ["--merge", f"{10 ** rng.uniform(-9, 3):.3g}"]
        if rng.random() < 0.3:
            run = Run(["recombine", surface, "-o", "a.vtu", "--quiet", *options], folder, expected=("a.vtu",))
        else:
            size = f"{largest_extent(triangles[0]) / 10 ** rng.uniform(-1, 2.2):.4g}"
            options += ["--size", rng.choice([size] * 9 + ["1e-9", "1e300"]), "--time-limit", TIME_LIMIT]
            run = Run(["remesh", surface, "-o", "a.msh", "--quiet", *options], folder, expected=("a.msh",))
        yield run.start(self.quadrille).end()

    def limits(self, rng, folder):
        """Little memory, short files, few threads, files and seconds."""
        many = ["--elements-per-diagonal", rng.choice([10, 60, 150])]
        outputs = rng.choice([[], [], ["-o", "b.med"], ["--picture", "p.png"], ["--write-size-field", "s.vdb"]])
        expected = ("a.msh", *outputs[1:])
        kind = rng.choice(["memory", "file", "threads", "files", "stack", "time", "cpu"])
        model = rng.choice(self.own)
        limits, nobody = {}, False
        if kind == "memory":
            bytes_allowed = int(GIGABYTE * 10 ** rng.uniform(-1.3, 0.3))
            limits[resource.RLIMIT_AS] = (bytes_allowed, bytes_allowed)
        elif kind == "file":
            length = rng.choice([0, 512, 10000, 100000])
            limits[resource.RLIMIT_FSIZE] = (length, length)
        elif kind == "threads":
            limits[resource.RLIMIT_NPROC] = (rng.choice([1, 2, 5, 40]),) * 2
            many += ["--threads", rng.choice([2, 8, 64])]
            nobody = True
            os.chmod(folder, 0o777)
        elif kind == "files":
            limits[resource.RLIMIT_NOFILE] = (rng.choice([4, 6, 10, 20]),) * 2
        elif kind == "stack":
            limits[resource.RLIMIT_STACK] = (rng.choice([256 << 10, 1 << 20]),) * 2
        elif kind == "cpu":
            limits[resource.RLIMIT_CPU] = (1, 3)
            many = ["--elements-per-diagonal", 1500]
        else:
            many += ["--time-limit", f"{10 ** rng.uniform(-6, 0):.3g}"]
        run = self.mesh(folder, model, *many, *outputs, limits=limits, as_nobody=nobody, expected=expected)
        column, problem = run.end()
        yield column, problem and f"limit of {kind} {list(limits.values())}: {problem}"

    def faults(self, rng, folder):
        """Full disks, read-only folders, links, odd names, closed streams, kills."""
        kinds = ["full device", "link to input", "circle", "dangling", "odd name", "long name", "closed", "kill", "kill", "kill",
                 "kept", *(["full disk", "read only"] if self.small_disk else [])]
        kind = rng.choice(kinds)
        column, problem = getattr(self, "_" + kind.replace(" ", "_"))(rng, folder, rng.choice(self.own))
        yield column, problem and f"{kind}: {problem}"

    def _full_device(self, rng, folder, model):
        name = rng.choice(["a.msh", "r.json", "s.vdb", "p.png"])
        os.symlink("/dev/full", folder / name)
        more = {"r.json": ["--report", name], "s.vdb": ["--write-size-field", name], "p.png": ["--picture", name]}
        run = self.mesh(folder, model, *more.get(name, []), "--elements-per-diagonal", 12)
        return run.end() if run.code else ("UNREPORTED", f"{name} on a full device ends with 0")

    def _link_to_input(self, rng, folder, model):
        own = folder / ("in" + model.suffix)
        shutil.copy(model, own)
        rng.choice([os.symlink, os.link])(own, folder / "a.msh")
        run = self.mesh(folder, own, "--elements-per-diagonal", 10)
        if run.code != 2 or own.read_bytes() != model.read_bytes():
            return "UNREPORTED", f"an output that is the input ends with {run.code}"
        return run.end()

    def _circle(self, rng, folder, model):
        os.symlink("b.msh", folder / "a.msh")
        os.symlink("a.msh", folder / "b.msh")
        run = self.mesh(folder, model, "--elements-per-diagonal", 10)
        return run.end() if run.code else ("UNREPORTED", "a circle of links ends with 0")

    def _dangling(self, rng, folder, model):
        os.symlink("b.msh", folder / "a.msh")
        run = self.mesh(folder, model, "--elements-per-diagonal", 10, expected=("b.msh",))
        if run.code == 0 and not (folder / "a.msh").is_symlink():
            return "left over", "the link was replaced"
        return run.end()

    def _odd_name(self, rng, folder, model):
        odd = rng.choice(["a\n*INCLUDE, INPUT=x\nb", "\x1b[2J", "a b", "-o", "ä\udcff", "%s%n", "$(x)", "*INCLUDE"])
        own = folder / (odd + model.suffix)
        shutil.copy(model, own)
        out = f"{rng.choice(['a', odd])}.{rng.choice(['inp', 'bdf', 'med', 'unv', 'vtu', 'vtk', 'msh', 'xdmf', 'su2'])}"
        run = Run(["mesh", f"./{own.name}", "-o", f"./{out}", "--quiet", "--elements-per-diagonal", "10"], folder, expected=(out,))
        return run.start(self.quadrille).end()

    def _long_name(self, rng, folder, model):
        name = "x" * rng.choice([240, 251, 252, 1000]) + ".msh"
        run = Run(["mesh", model, "-o", name, "--quiet", "--elements-per-diagonal", "10"], folder, expected=(name,))
        return run.start(self.quadrille).end()

    def _closed(self, rng, folder, model):
        closed = rng.choice([(0,), (1,), (2,), (0, 1, 2), (1, 2)])
        run = Run(["mesh", model, "-o", "a.msh", "--elements-per-diagonal", "60"], folder, closed=closed, expected=("a.msh",))
        run.start(self.quadrille)
        return ("reported errors", "") if run.code == 1 and 1 in closed and run.left == ["a.msh"] else run.end()

    def _kill(self, rng, folder, model):
        """Nothing left over but whole files; what was there before stays whole."""
        old = b"an older file" if rng.random() < 0.5 else None
        if old:
            (folder / "a.msh").write_bytes(old)
        number = rng.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        run = self.mesh(folder, model, "--elements-per-diagonal", 150, expected=() if old else ("a.msh",),
                        kill_after=rng.uniform(0, 0.6), kill_signal=number)
        now = (folder / "a.msh").read_bytes() if (folder / "a.msh").exists() else None
        if now not in (old, None):
            problem = problem_of_mesh(folder / "a.msh")
            if problem:
                return "left over", f"half a file: {problem}"
        return run.end()

    def _kept(self, rng, folder, model):
        """An older file stays as it was where the mesh fails."""
        (folder / "a.msh").write_bytes(b"an older file")
        run = self.mesh(folder, model, "--size", "1e-6", expected=())
        if (folder / "a.msh").read_bytes() != b"an older file":
            return "left over", "the older file is gone"
        return run.end()

    def _on_small_disk(self, folder, model, prepare, *options):
        unshare = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-rm"]
        script = f"mount -t tmpfs -o size=80k none {folder} && cd {folder} && {prepare} && \"$@\"; code=$?; ls -A >&2; exit $code"
        arguments = ["mesh", model, "-o", "a.msh", "--quiet", *options]
        run = Run(arguments, folder, prefix=(*unshare, "sh", "-c", script, "sh")).start(self.quadrille)
        first, _, rest = run.message.partition("\n")
        run.message, run.left = first, [name for name in rest.splitlines() if name != "filling"]
        return run.end() if run.code else ("UNREPORTED", "ends with 0")

    def _full_disk(self, rng, folder, model):
        options = rng.choice([[], ["--write-size-field", "s.vdb"], ["-o", "b.med"], ["-o", "b.vtu"]])
        return self._on_small_disk(folder, model, "head -c 78k /dev/zero >filling", "--elements-per-diagonal", 60, *options)

    def _read_only(self, rng, folder, model):
        return self._on_small_disk(folder, model, "mount -o remount,ro .", "--elements-per-diagonal", 20)

    def languages(self, rng, folder):
        """The same bytes under locales with decimal commas; not of .med, in which HDF5 stores the time."""
        if not self.locales:
            return
        model, ending = rng.choice(self.own), rng.choice(["msh", "inp", "bdf", "unv", "vtk", "vtu", "xdmf", "su2"])
        files = []
        for name, locale in (("a", {"LC_ALL": "C"}), ("b", rng.choice(self.locales))):
            place = folder / name
            place.mkdir()
            out = f"a.{ending}"
            run = Run(["mesh", model, "-o", out, "--quiet", "--elements-per-diagonal", "12.5", "--growth", "0.25"], place,
                      environment=locale, expected=(out,)).start(self.quadrille)
            column, problem = run.end()
            yield column, problem
            if column != "meshes":
                return
            files.append((place / out).read_bytes())
        if files[0] != files[1]:
            yield "invalid", f"other bytes of .{ending} in another locale"


CLASSES = {"options": 0.2, "sizes": 0.25, "mutations": 0.2, "surfaces": 0.05, "limits": 0.12, "faults": 0.13, "languages": 0.05}


def can_mount():
    unshare = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-rm"]
    return subprocess.run([*unshare, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0


def comma_locales(folder):
    """Environments of locales with decimal commas: the system's, else made in the folder; none without localedef."""
    known = subprocess.run(["locale", "-a"], capture_output=True, text=True).stdout.split()
    found = [{"LC_ALL": name} for name in known if name.lower().startswith(("de_", "fr_", "ru_")) and "utf8" in name.lower()]
    if found or not shutil.which("localedef"):
        return found
    path = Path(folder) / "de_DE.UTF-8"
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", path], capture_output=True)
    return [{"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(folder)}] if made.returncode == 0 else []


def one_run(attack, name, number, seed):
    """The ends of run NUMBER of the class."""
    rng = random.Random(f"{seed}/{name}/{number}")
    with tempfile.TemporaryDirectory(prefix="quadrille-attack-") as folder:
        return list(getattr(attack, name)(rng, Path(folder)))


def run_class(attack, name, arguments, numbers, ends_at):
    """Counts the runs of a class, on all cores."""
    counts, lock = dict.fromkeys(COLUMNS, 0), threading.Lock()
    numbers = iter(numbers)

    def work():
        while time.monotonic() < ends_at:
            with lock:
                number = next(numbers, None)
            if number is None:
                return
            ends = one_run(attack, name, number, arguments.seed)
            with lock:
                for column, problem in ends:
                    counts[column] += 1
                    if problem or "/" in (arguments.only or ""):
                        print(f"{name}/{number}: {column}: {problem}", file=sys.stderr, flush=True)

    with concurrent.futures.ThreadPoolExecutor() as pool:
        for worker in [pool.submit(work) for _ in range(os.cpu_count())]:
            worker.result()
    return counts


def models_in(*folders):
    endings = {".brep", ".step", ".stp", ".igs"}
    return sorted(path.resolve() for folder in folders for path in Path(folder).iterdir() if path.suffix.lower() in endings)


def print_table(table):
    print("| class | runs | " + " | ".join(COLUMNS) + " |\n| --- |" + " --- |" * (len(COLUMNS) + 1))
    for name, counts in table.items():
        print(f"| {name} | {sum(counts.values())} | " + " | ".join(str(counts[column]) for column in COLUMNS) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadrille", required=True)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--runs", type=int, help="so many runs of each class, however long they take")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--models", nargs="+", required=True, help="folders of small models")
    parser.add_argument("--parts", help="folder of real parts, for sizes and mutations")
    parser.add_argument("--only", help="one class, or one run of it: sizes/17")
    arguments = parser.parse_args()
    only, _, number = (arguments.only or "").partition("/")
    own = models_in(*arguments.models)
    parts = models_in(arguments.parts) if arguments.parts else own
    with tempfile.TemporaryDirectory() as folder:
        attack = Attack(os.path.abspath(arguments.quadrille), own, parts, comma_locales(folder))
        if not attack.small_disk:
            print("NOT RUN: small disks: no file system can be mounted here", file=sys.stderr)
        if not attack.locales:
            print("NOT RUN: languages: there is no locale with a decimal comma", file=sys.stderr)
        table = {}
        for name, share in CLASSES.items():
            if only not in ("", name):
                continue
            numbers = [int(number)] if number else range(arguments.runs) if arguments.runs else itertools.count()
            seconds = float("inf") if arguments.runs or number else arguments.seconds * (1 if only else share)
            table[name] = run_class(attack, name, arguments, numbers, time.monotonic() + seconds)
    print_table(table)
    repeat = shlex.join([sys.executable, *sys.argv, "--only"])
    bad = sum(counts[column] for counts in table.values() for column in COLUMNS[3:])
    if bad:
        print(f"{bad} ends that must not be; repeat one with: {repeat} CLASS/NUMBER", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
