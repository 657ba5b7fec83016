# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the `quadrille` command as a child process: options, progress, cancelling, errors.

Independent of FreeCAD; needs only the standard library.
"""

import contextlib
import json
import os
import queue
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import uuid
from pathlib import Path
from typing import IO, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union

from .errors import QT_TRANSLATE_NOOP, Error, translate
from .setting_table import MeshSettings

#: Called with a stage name and the fraction of all the work done, in [0, 1]; returning False cancels the work.
Progress = Callable[[str, float], Optional[bool]]

_PROGRESS_LINE = re.compile(r"progress: (\S+) (\d+) %")
#: How long a cancelled child may take to end before it is killed.
KILL_AFTER_SECONDS = 2.0

_KINDS = {2: "usage", 130: "cancelled", -signal.SIGINT: "cancelled", -signal.SIGTERM: "cancelled"}


#: This file exists inside a Flatpak sandbox, and nowhere else.
FLATPAK_INFO = Path("/.flatpak-info")
#: Runs a program outside the sandbox, and ends it when the process inside ends.
_OUT_OF_FLATPAK = ("flatpak-spawn", "--host", "--watch-bus")


def on_host(arguments: Sequence[str]) -> List[str]:
    """The arguments that run a program of the system: unchanged, or inside Flatpak with flatpak-spawn in front."""
    return [*_OUT_OF_FLATPAK, *arguments] if FLATPAK_INFO.exists() else list(arguments)


#: Waits until its input closes, which happens when the process at the other end ends. Then removes all paths that begin with
#: $1. It does so more than once, since a mesher that is ending at the same time may still create a file.
_REMOVE_AT_END = 'cat; for i in 1 2 3; do rm -rf -- "$1"*; sleep 1; done'
#: By process id and parent folder: the prefix of scratch folders, and the shell that removes them when this process ends.
_scratch: Dict[Tuple[int, str], Tuple[str, subprocess.Popen]] = {}
_scratch_lock = threading.Lock()  # a second shell for a folder would end the first, which removes what is in use


def _scratch_prefix(place: str) -> str:
    """How the names of this process's temporary folders in a folder begin; they are removed when it ends, even if it is killed."""
    key = (os.getpid(), place)
    with _scratch_lock:
        if key not in _scratch:
            prefix = f"quadrille-{os.getpid()}-{uuid.uuid4().hex[:8]}-"
            shell = subprocess.Popen(["/bin/sh", "-c", _REMOVE_AT_END, "sh", os.path.join(place, prefix)],
                                     stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                     env=child_environment(), start_new_session=True)
            _scratch[key] = (prefix, shell)
        return _scratch[key][0]


def scratch_folder() -> "tempfile.TemporaryDirectory":
    """A temporary folder that the command can see too. It is removed when this process ends, even if it is killed."""
    place = translate("Quadrille", "the folder for temporary files")
    try:
        place = tempfile.gettempdir()
        if FLATPAK_INFO.exists():
            # The sandbox has a /tmp of its own; its cache folder has the same path outside.
            place = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
            os.makedirs(place, exist_ok=True)
        return tempfile.TemporaryDirectory(prefix=_scratch_prefix(place), dir=place)
    except OSError as error:
        raise Error(translate("Quadrille", "{}: no temporary folder can be made there ({}); set the environment variable TMPDIR to a "
                              "folder that can be written").format(place, error.strerror), "failure", place) from error


def which(path: str) -> Optional[str]:
    """The path of a program, as from shutil.which(); inside Flatpak, the path of a program on the host system."""
    path = os.path.expanduser(path)
    if not FLATPAK_INFO.exists():
        return shutil.which(path)
    try:
        answer = subprocess.run(on_host(["sh", "-c", 'command -v "$1"', "sh", path]), stdin=subprocess.DEVNULL,
                                capture_output=True, text=True, errors="replace", timeout=30, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Error(translate("Quadrille", "flatpak-spawn: cannot run programs outside of Flatpak ({}); allow it with 'flatpak override "
                              "--user --talk-name=org.freedesktop.Flatpak org.freecad.FreeCAD'").format(error), "failure",
                    "flatpak-spawn") from error
    return answer.stdout.strip() or None if answer.returncode == 0 else None


def _own(here: Path) -> Optional[str]:
    """The command that came with this package: inside the package (wheel), or in bin/ of the bundle's folder."""
    folders = [here]
    if here.parts[-4:-1] == ("freecad", "Mod", "Quadrille"):  # BUNDLE/share/freecad/Mod/Quadrille/quadrille
        folders.append(here.parents[4] / "bin")
    elif here.parent.name == "python":
        folders.append(here.parents[1] / "bin")
    for path in (folder / "quadrille" for folder in folders):
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    return None


def find_command(command: Optional[str] = None, preference: Optional[str] = None) -> str:
    """The path of the `quadrille` command; if FreeCAD runs inside Flatpak, a path on the host system.

    Search order: the argument, the environment variable QUADRILLE_COMMAND, the preference, the command that came with this
    package (wheel, bundle), PATH, the path recorded by install-addon.sh, the source tree and its build folder. If one of the
    first three names a path that cannot be run, that is an error: nothing else is tried.
    """
    for path, origin in (
        (command, translate("Quadrille", "the argument 'command'")),
        (os.environ.get("QUADRILLE_COMMAND"), translate("Quadrille", "the environment variable QUADRILLE_COMMAND")),
        (preference, translate("Quadrille", "the preference 'Command'")),
    ):
        if path:
            found = which(path)
            if not found:
                raise Error(translate("Quadrille", "{}: cannot be run, though {} names it as the mesher").format(path, origin), "usage", path)
            return found
    here = Path(__file__).absolute().parent.parent  # the package
    found = _own(here) or which("quadrille")
    if found:
        return found
    recorded = here / "command_path"  # written by install-addon.sh
    if recorded.is_file():
        found = which(recorded.read_text(encoding="utf-8").strip())
        if found:
            return found
    source = Path(__file__).resolve().parent.parent  # where the addon is a link to the source
    for folder in (here.parent.parent, here.parent.parent / "build", source.parent.parent / "build"):
        found = which(str(folder / "quadrille"))
        if found:
            return found
    raise Error(translate("Quadrille", "the command 'quadrille' is not on PATH; install it, or name its path in the environment variable "
                          "QUADRILLE_COMMAND or in the preference Mod/Quadrille/Command"), "failure", "quadrille")


#: The version of this package; the command must have the same major and minor version.
VERSION = "0.1.0"
_checked: Dict[str, float] = {}


def check_version(path: str) -> None:
    """Raises Error if this package does not work with the command's version. Asks each file once."""
    modified = os.path.getmtime(path) if os.path.exists(path) else 0.0  # 0: a path outside the Flatpak sandbox
    if _checked.get(path) == modified:
        return
    try:
        answer = subprocess.run(on_host([path, "--version"]), stdin=subprocess.DEVNULL, capture_output=True,
                                encoding="utf-8", errors="replace", timeout=30, env=child_environment(), check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Error(translate("Quadrille", "{}: does not print its version ({}); install Quadrille {}").format(path, error, VERSION),
                    "failure", path) from error
    match = re.search(r"(\d+)\.(\d+)\.(\d+)", answer.stdout)
    if answer.returncode != 0 or not match:
        raise Error(translate("Quadrille", "{}: is not the quadrille command; install Quadrille {}, or correct the preference "
                              "Mod/Quadrille/Command").format(path, VERSION), "failure", path)
    if match.group(1, 2) != tuple(VERSION.split(".")[:2]):
        raise Error(translate("Quadrille", "{}: is of version {}, and this addon needs {}; install the two from one release").format(
            path, match.group(), VERSION), "failure", path)
    _checked[path] = modified


class _Child(subprocess.Popen):
    """A child process that gets its work, or nothing, as input, and tells its progress."""

    stdin: IO[str]  # both are pipes, see below
    stderr: IO[str]

    def __init__(self, arguments: Sequence[str]) -> None:
        super().__init__(
            on_host(arguments),
            stdin=subprocess.PIPE,  # closes when this process ends for any reason; the child then ends too
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            env=child_environment(),
        )


#: What is fixed when a child process starts: command, current folder, environment.
_Start = Tuple[str, str, Dict[str, str]]
#: The child process that stands by, and how it was started.
_standby: Optional[Tuple[_Start, _Child]] = None


def _start_of(command: str) -> _Start:
    return command, os.getcwd(), child_environment()


def stand_by(command: str) -> None:
    """Starts a child process that loads its libraries and waits for the next MeshJob of this command. Failure to start it is
    ignored."""
    global _standby
    try:
        start = _start_of(command)
        if _standby is not None and _standby[0] == start and _standby[1].poll() is None:
            return
        dismiss()
        _standby = (start, _Child([command, "standby"]))
    except OSError:
        pass


def dismiss() -> None:
    """Ends the standby child process, if there is one."""
    global _standby
    if _standby is None:
        return
    _, process = _standby
    _standby = None
    process.kill()
    process.wait()
    with contextlib.suppress(OSError):  # closing flushes what the child did not read
        process.stdin.close()
    process.stderr.close()


def _given_to_standby(arguments: Sequence[str]) -> Optional[_Child]:
    """Gives the work to the standby child process and returns that process. None if no process stands by that was started with
    the same command, folder and environment, or if it cannot take the work."""
    global _standby
    if _standby is None or _standby[0] != _start_of(arguments[0]):
        return None
    _, process = _standby
    if process.poll() is not None:
        dismiss()
        return None
    try:
        "".join(arguments).encode()  # paths may contain bytes that are not valid text
    except UnicodeEncodeError:
        return None
    try:
        process.stdin.write(json.dumps(list(arguments[1:])) + "\n")
        process.stdin.flush()
    except OSError:  # it has just ended
        dismiss()
        return None
    _standby = None
    return process


class CommandJob:
    """One run of a subcommand that writes a report. Call start(), then either wait() or, from a timer, poll()."""

    _cancelled_sentence = QT_TRANSLATE_NOOP("Quadrille", "the work was cancelled")
    _report_option = "--report"  #: the option that takes the file of the report
    _stands_by = False  #: whether the standby process may do such jobs

    def __init__(self, arguments: Sequence[str], command: Optional[str] = None) -> None:
        """arguments: the name of the subcommand and its options, without --report."""
        self._folder = scratch_folder()
        self._report = Path(self._folder.name) / "report.json"
        self._arguments = [command or find_command(), *arguments, self._report_option, str(self._report),
                           "--end-with-input"]
        self._lines: "queue.Queue[str]" = queue.Queue()
        self._process: Optional[_Child] = None
        self._reader: Optional[threading.Thread] = None
        self._cancelled = False
        self._last_progress = ("start", 0.0)
        self.messages: List[str] = []  #: what the command wrote to stderr, without the progress

    def start(self) -> "CommandJob":
        """Starts a child process, or gives the work to the standby process."""
        try:
            self._process = self._stands_by and _given_to_standby(self._arguments) or _Child(self._arguments)
        except OSError as error:
            raise Error(translate("Quadrille", "{}: cannot be started: {}").format(self._arguments[0], error.strerror), "failure",
                        self._arguments[0]) from error
        self._reader = threading.Thread(target=self._read, args=(self._process.stderr,), daemon=True)
        self._reader.start()
        return self

    def _started(self) -> Tuple[_Child, threading.Thread]:
        """The child process, and the thread that reads what it tells."""
        assert self._process is not None and self._reader is not None, "start() comes first"
        return self._process, self._reader

    def _read(self, told: Iterable[str]) -> None:
        for line in told:
            self._lines.put(line.rstrip("\n"))

    @property
    def running(self) -> bool:
        """True while the child process lives."""
        return self._process is not None and self._process.poll() is None

    def poll(self) -> List[Tuple[str, float]]:
        """The progress since the last call, as (stage, fraction) pairs. Never waits."""
        progress: List[Tuple[str, float]] = []
        while True:
            try:
                line = self._lines.get_nowait()
            except queue.Empty:
                return progress
            match = _PROGRESS_LINE.match(line)
            if match:
                progress.append((match.group(1), int(match.group(2)) / 100))
            elif line.strip():
                self.messages.append(line.strip())

    def cancel(self) -> None:
        """Ends the child process: asks it to end, then kills it after KILL_AFTER_SECONDS."""
        self._cancelled = True
        if self.running:
            process, _ = self._started()
            process.terminate()
            try:
                process.wait(KILL_AFTER_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def kill(self) -> None:
        """Kills the child process at once, for work that leaves no files behind. There is then no result."""
        self._cancelled = True
        if self.running:
            process, _ = self._started()
            process.kill()
            process.wait()
        self._close()

    def wait(self, progress: Optional[Progress] = None) -> Dict:
        """Waits for the end and passes progress on; then returns or raises as result() does."""
        try:
            while self.running and not self._cancelled:
                self._call(progress)
                time.sleep(0.02)
            self._call(progress)
        except BaseException:
            self.cancel()
            self._close()
            raise
        return self.result()

    def _call(self, progress: Optional[Progress]) -> None:
        steps = self.poll()
        if progress is None:
            return
        # Call it even if there is nothing new, so that cancelling does not wait for the next step.
        for step in steps or [self._last_progress]:
            self._last_progress = step
            if progress(*step) is False:
                self.cancel()
                return

    def result(self) -> Dict:
        """The report of a job that has ended. Raises Error with the command's own sentence if it failed."""
        process, reader = self._started()
        code = process.wait()
        reader.join(1.0)
        self.poll()
        try:
            if self._cancelled:
                raise Error(translate("Quadrille", self._cancelled_sentence), "cancelled")
            if code != 0:
                raise self._error(code)
            with open(self._report, encoding="utf-8") as file:
                return json.load(file)
        finally:
            self._close()

    def _close(self) -> None:
        process, reader = self._started()
        reader.join(1.0)
        process.stdin.close()
        if not reader.is_alive():  # a grandchild process may hold the pipe open
            process.stderr.close()
        self._folder.cleanup()

    def _error(self, code: int) -> Error:
        if code < 0:
            return Error(translate("Quadrille", "the mesher was killed by signal {}").format(-code), _KINDS.get(code, "failure"),
                         self._arguments[0])
        return Error(sentence_of(self.messages, code), _KINDS.get(code, "failure"))


class MeshJob(CommandJob):
    """One run of `quadrille mesh`, or of another command that makes a mesh."""

    _cancelled_sentence = QT_TRANSLATE_NOOP("Quadrille", "the meshing was cancelled")
    _stands_by = True

    def __init__(
        self,
        model: Union[str, Path],
        outputs: Sequence[Union[str, Path]],
        settings: Optional[MeshSettings] = None,
        command: Optional[str] = None,
        picture: Optional[Union[str, Path]] = None,
        work: Sequence[str] = ("mesh",),
    ) -> None:
        """work: the subcommand, with options that `settings` does not give."""
        arguments = [*work, str(model)]
        for output in outputs:
            arguments += ["-o", str(output)]
        arguments += (settings or MeshSettings()).arguments()
        if picture:
            arguments += ["--picture", str(picture)]
        super().__init__(arguments, command)


def sentence_of(lines: List[str], code: int) -> str:
    """The last line that the command wrote to stderr, without its name; if there is none, a sentence with the exit code."""
    prefix = "quadrille: "
    sentence = lines[-1] if lines else translate("Quadrille", "the mesher ended with exit code {}").format(code)
    return sentence[len(prefix):] if sentence.startswith(prefix) else sentence


def child_environment() -> Dict[str, str]:
    """The environment for child processes. If FreeCAD is an AppImage, its libraries would break programs outside it.

    Library paths inside the AppImage (APPDIR; PYTHONHOME if it was unpacked) and Python's variables are removed. The user's
    own library paths stay.
    """
    environment = dict(os.environ)
    bundles = [environment[name].rstrip("/") for name in ("APPDIR", "PYTHONHOME") if environment.get(name)]
    if not bundles:
        return environment
    for name in ("LD_LIBRARY_PATH", "LD_PRELOAD"):
        kept = [path for path in re.split("[: ]" if name == "LD_PRELOAD" else ":", environment.pop(name, ""))
                if path and not any(path == bundle or path.startswith(bundle + "/") for bundle in bundles)]
        if kept:
            environment[name] = ":".join(kept)
    for name in ("PYTHONHOME", "PYTHONPATH"):
        environment.pop(name, None)
    return environment
