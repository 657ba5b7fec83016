"""A folder of parts: what fails or crashes stops nothing, what is done is not done again, and no file, record or neighbor harms it."""

import contextlib
import csv
import html.parser
import io
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import quadrille
from quadrille import batch
from quadrille.core.command import find_command

try:
    import distributed
except ImportError:
    distributed = None

MODELS = Path(os.environ["QUADRILLE_MODELS"])
PACKAGE = Path(quadrille.__file__).parent
# A mesher that crashes on parts of one name, ends without a word on others, removes a part, waits until its input closes, and
# passes on the rest.
WRAPPER = """#!/bin/sh
case "$*" in
  *--version*) ;; *crash*) kill -SEGV $$ ;; *silent*) exit 1 ;; *remover*) rm -f '{folder}/boxes/vanishing.brep' ;;
  *slow*) echo $$ > '{folder}/slow.tmp'; mv '{folder}/slow.tmp' '{folder}/slow.pid'; exec cat >/dev/null ;;
esac
exec '{command}' "$@"
"""


def processes():
    """The parent of each process, by its id."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has ended
            found[int(status.parent.name)] = int(status.read_text().rpartition(")")[2].split()[1])
    return found


def family_of(pid):
    """A process and its descendants."""
    parents, family = processes(), {pid}
    while new := {child for child, parent in parents.items() if parent in family} - family:
        family |= new
    return family


def listening_of(pids, tables=("tcp", "tcp6")):
    """The sockets with which these processes wait for connections, as lines of the kernel's tables."""
    inodes = {}
    for table in tables:
        state, listens, inode = (3, "00010000", 6) if table == "unix" else (3, "0A", 9)
        for line in Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            words = line.split()
            if words[state] == listens:
                inodes[f"socket:[{words[inode]}]"] = f"{table} {line}"
    found = set()
    for pid in pids:
        with contextlib.suppress(OSError):
            for link in Path(f"/proc/{pid}/fd").iterdir():
                with contextlib.suppress(OSError):
                    found.add(os.readlink(link))
    return [inodes[link] for link in found if link in inodes]


class Page(html.parser.HTMLParser):
    """The tags of a page and the targets of its links."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.links = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.links += [value for name, value in attrs if name in ("href", "src")]


class BatchTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder, self.out = Path(scratch.name) / "parts", Path(scratch.name) / "out"
        (self.folder / "deep").mkdir(parents=True)
        for name, target in (("box", "box"), ("cylinder", "deep/b <&> c"), ("box", "crash"), ("box", "silent")):
            shutil.copy(MODELS / f"{name}.brep", self.folder / f"{target}.brep")
        (self.folder / "bad.step").write_text("nonsense")
        (self.folder / "readme.txt").write_text("no CAD")
        self.command = Path(scratch.name) / "mesher"
        self.package = PACKAGE.parent
        self.write_command(find_command())

    def write_command(self, command):
        """Writes a mesher that passes parts on to this one."""
        self.command.write_text(WRAPPER.format(command=command, folder=self.folder.parent))
        self.command.chmod(self.command.stat().st_mode | stat.S_IXUSR)

    def run_batch(self, *arguments, folder=None):
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = batch.run([str(folder or self.folder), "-o", str(self.out), "--workers", "2", "--command",
                              str(self.command), "--elements-per-diagonal", "12", *arguments])
        return code, out.getvalue(), err.getvalue()

    def program(self, *arguments, module="quadrille.batch", before=(), cwd=None, path=(), **variables):
        """A program of the package, as a process of its own."""
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join([*map(str, path), str(self.package)]),
                           QUADRILLE_COMMAND=str(self.command), **variables)
        return subprocess.Popen([*before, sys.executable, "-m", module, *map(str, arguments)], env=environment, text=True,
                                cwd=cwd or self.folder.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                errors="surrogateescape", start_new_session=True,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))

    def make_reachable(self, before):
        """Copies the package and the command where an ordinary user can read them, unless one can already."""
        if not subprocess.run([*before, "test", "-r", PACKAGE / "batch.py", "-a", "-x", find_command()], check=False).returncode:
            return
        place = self.folder.parent / "copy"
        shutil.copytree(PACKAGE, place / "quadrille")
        shutil.copy(find_command(), place / "quadrille-command")
        for module in Path(find_command()).parent.glob("libquadrille_*.so"):
            shutil.copy(module, place)
        self.write_command(place / "quadrille-command")
        self.package = place

    def batch_of(self, names):
        """The arguments for a batch of boxes with these names (bytes), whatever they contain."""
        folder = self.folder.parent / "boxes"
        folder.mkdir(exist_ok=True)
        for name in names:
            shutil.copy(os.fsencode(MODELS / "box.brep"), os.fsencode(folder) + b"/" + name)
        return [folder, "-o", self.out, "--workers", "2", "--elements-per-diagonal", "12"]

    def records(self):
        with (self.out / "report.csv").open(encoding="utf-8", newline="") as file:
            return {row["part"]: row for row in csv.DictReader(file)}

    def test_failures_and_crashes_stop_nothing_and_runs_resume(self):
        code, out, err = self.run_batch()
        self.assertEqual(code, 1)
        self.assertIn("2 of 5 parts meshed", out)
        self.assertIn("5 of 5", err)
        rows = self.records()
        self.assertEqual({part: row["status"] for part, row in rows.items()},
                         {"bad.step": "failed", "box.brep": "meshed", "crash.brep": "failed", "silent.brep": "failed",
                          "deep/b <&> c.brep": "meshed"})
        self.assertIn("signal 11", rows["crash.brep"]["reason"])
        self.assertIn("exit code 1", rows["silent.brep"]["reason"])
        self.assertIn("bad.step", rows["bad.step"]["reason"])
        self.assertGreater(int(rows["box.brep"]["quads"]), 10)
        self.assertGreater(float(rows["box.brep"]["q_mean"]), 0.9)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("<tr class="), 5)
        self.assertIn("b &lt;&amp;&gt; c.brep", page)
        self.assertNotIn("b <&> c", page)
        meshes = [self.out / "meshes" / f"{part}.msh" for part in ("box.brep", "deep/b <&> c.brep")]
        for picture in ("box.brep", "deep/b <&> c.brep"):
            self.assertTrue((self.out / "pictures" / f"{picture}.png").is_file())
        before = [path.stat().st_mtime_ns for path in meshes]

        # Nothing is done again but what has changed, even in secret, and what lost its mesh.
        changed = self.folder / "box.brep"
        state = changed.stat()
        os.utime(self.folder / "deep" / "b <&> c.brep")
        changed.write_bytes(changed.read_bytes().replace(b"\n\n", b" \n", 1))
        os.utime(changed, ns=(state.st_atime_ns, state.st_mtime_ns))
        self.assertEqual(changed.stat().st_size, state.st_size)
        code, out, err = self.run_batch()
        self.assertIn("1 of 1", err)
        after = [path.stat().st_mtime_ns for path in meshes]
        self.assertGreater(after[0], before[0])
        self.assertEqual(after[1], before[1])
        meshes[1].unlink()
        self.run_batch()
        self.assertTrue(meshes[1].is_file())
        self.assertEqual(meshes[0].stat().st_mtime_ns, after[0])
        # Other options make other meshes.
        _, _, err = self.run_batch("--order", "2", "--quiet")
        self.assertEqual(err, "")
        self.assertGreater(meshes[0].stat().st_mtime_ns, after[0])

    def test_nothing_listens(self):
        """Another user of the machine has no way in while a batch runs. (The display for pictures has a local socket.)"""

        def nothing_listens():
            self.assertEqual(listening_of(family_of(process.pid)), [])
            self.assertEqual(listening_of([process.pid], ("unix",)), [])

        process = self.program(*self.batch_of([b"slow.brep", b"box.brep"]), "--quiet")
        waited_for = (self.out / "records" / "box.brep.json", self.folder.parent / "slow.pid")
        try:
            while process.poll() is None and not all(path.exists() for path in waited_for):
                nothing_listens()
                time.sleep(0.01)
            nothing_listens()
            self.assertIn(int((self.folder.parent / "slow.pid").read_text()), family_of(process.pid))
        finally:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()

    def test_bad_use_is_one_sentence(self):
        for arguments, part, expected in (
                (("--scheduler", "tcp://127.0.0.1:1"), "without TLS", 2),
                (("--scheduler", "nonsense"), "tls://HOST:8786", 2),
                (("--scheduler", "tls://127.0.0.1:1"), "--tls-ca", 2),
                (("--scheduler", "tls://127.0.0.1:1", "--tls-ca", __file__, "--tls-cert", "missing"), "--tls-cert", 2)):
            code, _, err = self.run_batch(*arguments)
            self.assertEqual(code, expected)
            self.assertIn(part, err)
            self.assertEqual(len(err.strip().splitlines()), 1, err)
            self.assertFalse(self.out.exists())
        for folder in (self.folder / "missing", self.folder / "readme.txt", self.out.parent / "empty"):
            (self.out.parent / "empty").mkdir(exist_ok=True)
            code, _, err = self.run_batch(folder=folder)
            self.assertEqual(code, 2)
            self.assertEqual(len(err.strip().splitlines()), 1, err)

    @unittest.skipIf(distributed is None, "Dask is not installed: apt install python3-distributed")
    @unittest.skipIf(shutil.which("openssl") is None, "openssl is not installed")
    def test_a_cluster_behind_tls(self):
        def certificate(name):
            files = [str(self.folder.parent / f"{name}.{ending}") for ending in ("crt", "key")]
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                            "-days", "2", "-subj", f"/CN={name}", "-out", files[0], "-keyout", files[1]], check=True,
                           capture_output=True)
            return [files[0], *files]

        ours, strangers = certificate("ours"), certificate("strangers")
        options = ("--tls-ca", "--tls-cert", "--tls-key")
        names = ("tls_ca_file", "tls_scheduler_cert", "tls_scheduler_key", "tls_worker_cert", "tls_worker_key",
                 "tls_client_cert", "tls_client_key")
        security = distributed.Security(require_encryption=True, **dict(zip(names, [*ours, *ours[1:], *ours[1:]])))
        os.environ["QUADRILLE_COMMAND"], before = str(self.command), os.environ.get("QUADRILLE_COMMAND")
        self.addCleanup(lambda: os.environ.update(QUADRILLE_COMMAND=before) if before else
                        os.environ.pop("QUADRILLE_COMMAND"))
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=False, host="127.0.0.1", protocol="tls://",
                                      security=security, dashboard_address=None, worker_dashboard_address=None,
                                      scheduler_kwargs={"dashboard_address": "127.0.0.1:0"}) as cluster:
            address = cluster.scheduler_address
            self.assertTrue(address.startswith("tls://"), address)
            stranger = [word for pair in zip(options, strangers) for word in pair]
            code, _, err = self.run_batch("--scheduler", address, "--scheduler-timeout", "2", *stranger)
            self.assertEqual(code, 1)
            self.assertIn("does not accept the certificate", err)
            code, out, err = self.run_batch("--scheduler", address, *(word for pair in zip(options, ours) for word in pair))
        self.assertEqual(code, 1)
        self.assertIn("2 of 5 parts meshed", out)
        self.assertIn("signal 11", self.records()["crash.brep"]["reason"])

    def test_nothing_comes_from_the_current_folder(self):
        """Programs run beside CAD files from elsewhere. What Python imports before a program begins is not tried."""
        arguments = self.batch_of([b"box.brep"])
        here = arguments[0]
        for name in ("argparse", "csv", "distributed", "hashlib", "html", "json", "logging", "numpy", "queue", "signal",
                     "subprocess", "tempfile", "urllib", "uuid"):
            (here / f"{name}.py").write_text(f"open('ran_{name}', 'w').close()\n")
        programs = {".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts).replace(".__main__", "")
                    for file in PACKAGE.rglob("*.py") if "if __name__ ==" in file.read_text(encoding="utf-8")}
        self.assertEqual(programs, {"quadrille", "quadrille.batch"})
        for module, words in (("quadrille", ["--version"]), ("quadrille.batch", arguments),
                              ("quadrille.batch", [*arguments, "--scheduler", "tls://127.0.0.1:1", "--scheduler-timeout", "1",
                                                   "--tls-ca", __file__, "--tls-cert", __file__, "--tls-key", __file__])):
            for path in ((), ("",), (here,)):
                process = self.program(*words, module=module, cwd=here, path=path)
                _, err = process.communicate(timeout=60)
                self.assertEqual(sorted(file.name for file in here.glob("ran_*")), [], err)
                self.assertEqual(process.returncode, 1 if "--scheduler" in words else 0, err)

    def test_attack_of_names(self):
        """Names of any bytes, closed files and folders, pipes and devices, in the run of an ordinary user and in any locale."""
        long = b"n" * 250 + b".brep"
        names = [b"a\xff.brep", long, b"m" + long[1:], b"new\nline\x1b[31m.brep", b'=HYPERLINK("x").brep', b"-1.brep", b"@x.brep",
                 b"\tx.brep", b"<script>alert(1)<script>.brep", b"\"a' #?%41&amp;.brep", b"closed.brep", "\u202e\xfc.brep".encode()]
        arguments = self.batch_of(names)
        folder = arguments[0]
        (folder / "nowhere.brep").symlink_to("nothing")
        (folder / "zero.step").symlink_to("/dev/zero")
        os.mkfifo(folder / "pipe.step")
        (folder / "dark").mkdir()
        (folder / "listed").mkdir()
        shutil.copy(MODELS / "box.brep", folder / "listed")
        before = []
        if os.geteuid() == 0:
            if shutil.which("setpriv") is None:
                self.skipTest("root reads closed files, and setpriv is not installed")
            before = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
            self.make_reachable(before)
            for place in [folder.parent, *folder.parent.rglob("*")]:
                os.chown(place, 65534, 65534, follow_symlinks=False)
        for name, mode in (("closed.brep", 0), ("dark", 0), ("listed", 0o444)):
            (folder / name).chmod(mode)
            self.addCleanup((folder / name).chmod, 0o777)
        failing = {"closed.brep", "dark", "listed/box.brep"}
        locales = ({}, {"LC_ALL": "C"}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
                   {"PYTHONIOENCODING": "ascii"})
        for count, locale in enumerate(locales):
            process = self.program(*arguments, before=before, **locale)
            out, err = process.communicate(timeout=100)
            self.assertEqual(process.returncode, 1, err)
            self.assertIn(f"{len(names) - 1} of {len(names) + 2} parts meshed", out + err)
            self.assertNotIn("Traceback", err)
            if count:  # all is known
                self.assertNotIn("progress", err)
            text = (self.out / "report.csv").read_bytes().decode()
            rows = list(csv.DictReader(io.StringIO(text, newline="")))
            self.assertEqual({row["part"] for row in rows if row["status"] != "meshed"}, failing)
            self.assertTrue(all(row["reason"] for row in rows if row["part"] in failing), rows)
            for row in rows:
                self.assertTrue(row["part"].isprintable(), row)
                self.assertNotRegex(row["part"], "^[-=+@\t\r]")
            page = (self.out / "report.html").read_bytes().decode()
            tags = Page(page)
            self.assertEqual((tags.tags.count("script"), tags.tags.count("tr")), (1, len(rows) + 1))
            pictures = {os.fsencode(self.out) + b"/" + urllib.parse.unquote_to_bytes(link) for link in tags.links}
            self.assertEqual(len(pictures), len(names) - 1)
            self.assertTrue(all(os.path.isfile(picture) for picture in pictures), pictures)
        process = self.program(*arguments, "--stray\x1b[31m\udcff")
        self.assertIn("--stray\\x1b[31m\\udcff", process.communicate(timeout=60)[1])
        process = self.program("missing\x1b[31m\udcff", "-o", self.out)
        self.assertRegex(process.communicate(timeout=60)[1], r"^quadrille.batch: \S*missing\\x1b\[31m\\udcff: is not a folder\n$")

    def test_attack_of_records(self):
        """A record is believed only where it says what this run would have written."""
        arguments = [*map(str, self.batch_of([b"box.brep", b"other.brep"])), "--no-pictures"]
        other, mesh, path = (self.out / name for name in ("meshes/other.brep.msh", "meshes/box.brep.msh",
                                                          "records/box.brep.json"))

        def run():
            out, err = io.StringIO(), io.StringIO()
            with redirect_stdout(out), redirect_stderr(err):
                self.assertEqual(batch.run(arguments), 0, err.getvalue())
            self.assertIn("2 of 2 parts meshed", out.getvalue())
            return err.getvalue()

        run()
        good = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual(run(), "")
        for attack in (b"[" * 100000, json.dumps({**good, "q_min": "<script>"}).encode()):
            path.write_bytes(attack)
            self.assertIn("1 of 1", run())
            self.assertEqual(run(), "")
        path.unlink()
        os.mkfifo(path)
        self.assertIn("1 of 1", run())
        path.write_text(json.dumps({**good, "mesh": str(other)}), encoding="utf-8")
        mesh.unlink()
        self.assertIn("1 of 1", run())
        self.assertTrue(mesh.is_file())
        attacks = [b"", b"\xff\xfe", b"[]", b"null", b'"meshed"', b"[" * 100000, b"{" + b" " * (2 << 20) + b"}", b"9" * 5000]
        for name in good:
            attacks.append(json.dumps({key: value for key, value in good.items() if key != name}).encode())
            for value in (None, [], {}, True, float("nan"), float("inf"), 10 ** 300, "<script>", ["meshed"], str(other)):
                attacks.append(json.dumps({**good, name: value}).encode())
        changes_nothing = ("part", "mesh", "picture", "reason")  # the first three are not read
        task = batch.tasks_of(batch.parser().parse_args(arguments), {})[0]
        for attack in attacks:
            path.write_bytes(attack)
            record = batch.done_before(task)
            if record is not None:
                found = json.loads(attack)
                self.assertTrue(all(found.get(name) == good[name] for name in good if name not in changes_nothing), attack)
                self.assertEqual({**record, "reason": ""}, good)

    def test_parts_that_vanish_fail_alone(self):
        arguments = self.batch_of([b"a_remover.brep", b"box.brep", b"vanishing.brep"])
        process = self.program(*arguments, "--workers", "1", "--no-pictures")
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out.split(",")[0]), (1, "2 of 3 parts meshed"), err)
        self.assertIn("vanishing.brep", self.records()["vanishing.brep"]["reason"])

    def test_folders_may_be_deep(self):
        """Deeper than Python calls itself; and what lies in OUT is not written through."""
        arguments = self.batch_of([b"box.brep"])
        self.addCleanup(subprocess.run, ["rm", "-rf", arguments[0] / "d"], check=True)
        for count in (1, 1200):
            deep = arguments[0].joinpath(*["d"] * count)
            subprocess.run(["mkdir", "-p", deep], check=True)
            shutil.copy(MODELS / "box.brep", deep)
        (self.out / "records").mkdir(parents=True)
        os.mkfifo(self.out / "records" / "box.brep.json.part")
        (self.out / "report.csv.part").symlink_to(self.command)
        before = self.command.read_text()
        process = self.program(*arguments, "--no-pictures")
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out.split(",")[0]), (1, "2 of 3 parts meshed"), err)
        self.assertEqual(self.command.read_text(), before)

    def test_endless_parts_reach_the_time_limit(self):
        """A part may have become a pipe or a device after it was listed."""
        arguments = self.batch_of([b"box.brep"])
        task = batch.tasks_of(batch.parser().parse_args([*map(str, arguments), "--read-time-limit", "1", "--no-pictures"]), {})[0]
        for name in ("zero.step", "zero.iges", "zero.brep"):
            (arguments[0] / name).symlink_to("/dev/zero")
        os.mkfifo(arguments[0] / "silent_pipe.step")
        os.mkfifo(arguments[0] / "pipe.step")

        def feed():
            with contextlib.suppress(BrokenPipeError), open(arguments[0] / "pipe.step", "wb") as pipe:
                pipe.write(b"ISO-10303-21;\nHEADER;\n")
                while True:
                    pipe.write(b"/* on and on */\n" * 4096)

        threading.Thread(target=feed, daemon=True).start()
        for name in ("zero.step", "zero.iges", "zero.brep", "pipe.step", "silent_pipe.step"):
            model = str(arguments[0] / name)
            start = time.monotonic()
            self.assertEqual(len(batch._state_of(model)), 64)
            record = batch.mesh_part(task._replace(model=model), find_command())
            self.assertEqual(record["status"], "failed")
            self.assertIn(name, record["reason"])
            self.assertLess(time.monotonic() - start, 20)

    def test_interrupts(self):
        """Ctrl-C at any time: one sentence, exit code 130, no child is left, and the next run continues."""
        arguments = self.batch_of([b"a.brep", b"slow.brep", b"z.brep"])
        early = []  # in place of the first module imported at the start, and of one imported later
        for name in ("signal", "csv"):
            early.append(self.folder.parent / f"early_{name}")
            early[-1].mkdir()
            (early[-1] / f"{name}.py").write_text("import os, time\nos.kill(os.getpid(), 2)\ntime.sleep(9)\n")
        pid_file = self.folder.parent / "slow.pid"
        for how in (*early, "process", "group"):
            process = self.program(*arguments, "--quiet", "--no-pictures", "--workers", "1", path=[how] if how in early else ())
            child = None
            if how not in early:
                deadline = time.monotonic() + 30
                while not pid_file.exists() and time.monotonic() < deadline:
                    time.sleep(0.02)
                child = int(pid_file.read_text())
                pid_file.unlink()
                (os.killpg if how == "group" else os.kill)(process.pid, signal.SIGINT)
            out, err = process.communicate(timeout=20)
            self.assertEqual((process.returncode, out), (130, ""), err)
            self.assertRegex(err, r"\Aquadrille\.batch: stopped; [^\n]*\n\Z")
            deadline = time.monotonic() + 5
            while child in processes() and time.monotonic() < deadline:
                time.sleep(0.02)
            self.assertNotIn(child, processes())
        self.assertEqual([path.name for path in (self.out / "records").iterdir()], ["a.brep.json"])
        first = (self.out / "meshes" / "a.brep.msh").stat().st_mtime_ns
        self.command.write_text(re.sub(r"  \*slow.*\n", "", self.command.read_text()))
        process = self.program(*arguments, "--no-pictures")
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out.split(",")[0]), (0, "3 of 3 parts meshed"), err)
        self.assertEqual((self.out / "meshes" / "a.brep.msh").stat().st_mtime_ns, first)

    def test_options_are_those_of_the_table(self):
        options = batch.parser().parse_args(["f", "-o", "o", "--size", "2", "--size-in", "sphere:0,0,0,1=1", "--size-in",
                                             "box:0,0,0,1,1,1=1", "--partial"])
        self.assertEqual(batch.setting_arguments(options)[:2], ["--size", "2"])
        arguments = " ".join(batch.setting_arguments(options))
        self.assertIn("--size-in sphere:0,0,0,1=1 --size-in box:0,0,0,1,1,1=1", arguments)
        self.assertIn("--partial", arguments)
        self.assertIn(" --time-limit 300 --read-time-limit 300 --threads 1", arguments)
        options = batch.parser().parse_args(["f", "-o", "o", "--read-time-limit", "9"])
        self.assertEqual(batch.setting_arguments(options), ["--read-time-limit", "9", "--time-limit", "300", "--threads", "1"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
