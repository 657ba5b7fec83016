# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes all CAD files of a folder, on all cores or on a cluster.

    python3 -m quadrille.batch FOLDER -o OUT [--workers 4] [--size 2 ...]

Each part is meshed by its own run of the `quadrille` command, so a failure or crash affects no other part. Threads of this
process start these runs, or Dask does on other machines. OUT gets each part's mesh, picture and record. A later run with the
same options meshes only parts that are new or have changed, or whose run was not finished. OUT/report.csv and OUT/report.html
list all parts.
"""

if __name__ == "__main__":
    from .core import entry

    entry.begin("quadrille.batch: stopped; the same command continues from here")

import argparse
import contextlib
import csv
import errno
import hashlib
import html
import io
import itertools
import json
import logging
import os
import stat
import sys
import time
import urllib.parse
from concurrent.futures import Executor, ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, NamedTuple, NoReturn, Optional

from .core.command import VERSION, MeshJob, check_version, find_command
from .core.errors import Error, printable
from .core.setting_table import SETTINGS, TABLES

ENDINGS = (".step", ".stp", ".iges", ".igs", ".brep")
FORMATS = tuple(row["ending"][1:] for row in TABLES["formats"] if row["written"])
#: Settings of `quadrille mesh` that hold unless others are given: time limits in seconds; each worker uses one core.
DEFAULTS = {"time_limit": 300, "read_time_limit": 300, "threads": 1}
#: The columns of the report, of which these are numbers.
COLUMNS = ("part", "status", "quads", "q_mean", "q_min", "outside_percent", "seconds", "reason")
NUMBERS = COLUMNS[2:7]
#: Longer file names (in bytes) are shortened, so that endings can be added.
_LONGEST_NAME = 200
#: How many bytes of a part count as its content, and of a record.
_MOST_CONTENT, _MOST_RECORD = 1 << 30, 1 << 20


class Task(NamedTuple):
    """One part to mesh."""

    part: str  #: path relative to the input folder
    model: str
    mesh: str
    picture: Optional[str]
    record: str
    key: str  #: identifies the file's content and the options
    arguments: List[str]  #: options of `quadrille mesh`


def mesh_part(task: Task, command: Optional[str]) -> Dict[str, Any]:
    """Meshes a part in a child process. Writes and returns its record, whether meshing succeeds or fails; raises what says
    nothing about the part, such as a full disk."""
    start = time.monotonic()
    for path in filter(None, (task.mesh, task.picture)):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
    job = MeshJob(task.model, [task.mesh], None, command, task.picture, ("mesh", *task.arguments)).start()
    try:
        record = _record(task, "meshed", **_measures(job.wait()))
    except Error as error:
        if error.kind == "cancelled":
            raise
        record = _record(task, "failed", str(error))
    record["seconds"] = round(time.monotonic() - start, 3)
    write_whole(Path(task.record), json.dumps(record, indent=1) + "\n")
    return record


def _record(task: Task, status: str, reason: str = "", **numbers: Any) -> Dict[str, Any]:
    files = {"mesh": task.mesh, "picture": task.picture} if status == "meshed" else {}
    return {"part": task.part, "key": task.key, "status": status, "reason": reason, **files, **numbers}


def _measures(report: Dict[str, Any]) -> Dict[str, Any]:
    quality = report["quality"]
    return {"quads": report["counts"]["quads"], "q_mean": quality["q_mean"], "q_min": quality["q_min"],
            "outside_percent": report["criteria"]["outside_percent"]}


def write_whole(target: Path, text: str) -> None:
    """Writes a file completely or not at all."""
    target.parent.mkdir(parents=True, exist_ok=True)
    scratch = target.with_name(target.name + ".part")
    scratch.unlink(missing_ok=True)
    with scratch.open("xb") as file:  # through no link or pipe that lies there
        file.write(text.encode())
    scratch.replace(target)


def _content(path: str, most: int) -> Iterator[bytes]:
    """So many bytes of a file, in chunks. Pipes and devices, which may never end, are an error."""
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | getattr(os, "O_NONBLOCK", 0))) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(errno.EINVAL, "is not a file", path)
        chunk = 1 << 20
        yield from itertools.islice(iter(lambda: file.read(chunk), b""), most // chunk)


def _state_of(model: str) -> str:
    """Identifies what is in a file. Of what cannot be read, its own run says why."""
    digest = hashlib.sha256()
    with contextlib.suppress(OSError):
        for chunk in _content(model, _MOST_CONTENT):
            digest.update(chunk)
        state = os.stat(model)
        if state.st_size > _MOST_CONTENT:
            digest.update(f"{state.st_size} {state.st_mtime_ns}".encode())
    return digest.hexdigest()


def parts_of(folder: Path, closed: Dict[str, str]) -> List[Path]:
    """The CAD files in a folder and its subfolders, sorted by path. Adds to `closed` why folders cannot be read."""
    if not folder.is_dir():
        raise Error(f"{folder}: is not a folder", "usage", str(folder))
    found, places = [], [str(folder)]
    while places:
        place = places.pop()
        try:
            with os.scandir(place) as items:
                for item in items:
                    if item.is_dir(follow_symlinks=False):
                        places.append(item.path)
                    elif item.name.lower().endswith(ENDINGS):
                        if item.is_file(follow_symlinks=False) or os.path.isfile(item.path):
                            found.append(Path(item.path))
        except OSError as error:
            closed[place] = f"{place}: {error.strerror}"
    if not found and not closed:
        raise Error(f"{folder}: holds no CAD files ({', '.join(ENDINGS)})", "usage", str(folder))
    return sorted(found)


def _short(part: Path) -> str:
    """The part's path with a file name to which endings can be added. A hash tells shortened names apart; no part has such a
    name, for it has no ending."""
    name = os.fsencode(part.name)
    if len(name) <= _LONGEST_NAME:
        return str(part)
    start = name[:_LONGEST_NAME - 20].decode("utf-8", "ignore")
    return str(part.with_name(f"{start}~{hashlib.sha256(name).hexdigest()[:16]}"))


def tasks_of(options: argparse.Namespace, closed: Dict[str, str]) -> List[Task]:
    """The parts to mesh. Files whose names differ only in their endings get separate meshes."""
    folder, out = (Path(os.path.realpath(path)) for path in (options.folder, options.output))
    arguments = setting_arguments(options)
    tasks = []
    for model in parts_of(folder, closed):
        part = model.relative_to(folder)
        name = _short(part)
        kind = json.dumps([VERSION, _state_of(str(model)), arguments, options.format, not options.no_pictures])
        picture = None if options.no_pictures else str(out / "pictures" / f"{name}.png")
        tasks.append(Task(str(part), str(model), str(out / "meshes" / f"{name}.{options.format}"), picture,
                          str(out / "records" / f"{name}.json"), hashlib.sha256(kind.encode()).hexdigest(), arguments))
    return tasks


def setting_arguments(options: argparse.Namespace) -> List[str]:
    """The options of `quadrille mesh` that were given, and the defaults of a batch for others."""
    arguments: List[str] = []
    for setting in SETTINGS:
        value = getattr(options, setting["name"], None)
        if value is True:
            arguments.append(setting["option"])
        elif value:
            for text in value if isinstance(value, list) else [value]:
                arguments += [setting["option"], text]
    for name, default in DEFAULTS.items():
        if getattr(options, name, None) is None:
            arguments += ["--" + name.replace("_", "-"), str(default)]
    return arguments


def done_before(task: Task) -> Optional[Dict[str, Any]]:
    """The record of an earlier run with the same content and options, if its outputs are still there. From the file, which
    may be damaged, only what a record should hold is taken."""
    try:
        found = json.loads(b"".join(_content(task.record, _MOST_RECORD)))
        status, reason = found["status"], found["reason"]
        numbers = {name: found[name] for name in (NUMBERS if status == "meshed" else ("seconds",))}
        sound = (found["key"] == task.key and status in ("meshed", "failed") and isinstance(reason, str)
                 and all(type(value) in (int, float) and abs(value) < 1e12 for value in numbers.values()))
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return None
    if not sound or (status == "meshed" and not all(Path(path).is_file() for path in (task.mesh, task.picture) if path)):
        return None
    return _record(task, status, reason, **numbers)


@contextlib.contextmanager
def _executor(options: argparse.Namespace) -> Iterator[Executor]:
    """Threads of this process, or the workers of the given Dask scheduler."""
    address = options.scheduler
    if not address:
        with ThreadPoolExecutor(options.workers) as threads:
            yield threads
        return
    files = {"--tls-ca": options.tls_ca, "--tls-cert": options.tls_cert, "--tls-key": options.tls_key}
    if not address.startswith("tls://"):
        raise Error(f"{address}: without TLS, anyone who reaches a scheduler runs programs on its workers as their user; start "
                    "it with certificates and name it as tls://HOST:8786", "usage", address)
    for option, path in files.items():
        if not os.path.isfile(path or ""):
            raise Error(f"{option}: names no file, and --scheduler needs the files of the authority's certificate, of a "
                        "certificate and of its key", "usage", option)
    try:
        import distributed
    except ImportError as error:
        raise Error("Dask is not installed: apt install python3-distributed", "failure", "distributed") from error
    logging.disable(logging.ERROR)  # Dask logs lost connections under many names; the records tell of them
    try:
        security = distributed.Security(tls_ca_file=options.tls_ca, tls_client_cert=options.tls_cert,
                                        tls_client_key=options.tls_key, require_encryption=True)
        client = distributed.Client(address, security=security, timeout=options.scheduler_timeout)
    except (OSError, TimeoutError, ValueError, TypeError) as error:
        raise Error(f"{address}: no Dask scheduler answers there, or it does not accept the certificate", "failure",
                    address) from error
    with client, client.get_executor(pure=False) as machines:
        yield machines


class _Bar:
    """Progress on stderr: on a terminal one line that is redrawn, elsewhere a line for each tenth."""

    def __init__(self, count: int, quiet: bool) -> None:
        self._count, self._quiet, self._start = count, quiet, time.monotonic()
        self._done = self._failed = 0
        self._terminal = sys.stderr.isatty()
        self._tenth = -1

    def step(self, record: Dict[str, Any]) -> None:
        """Counts one more finished part."""
        self._done += 1
        self._failed += record["status"] != "meshed"
        tenth = 10 * self._done // self._count
        if self._quiet or (not self._terminal and tenth == self._tenth):
            return
        self._tenth = tenth
        left = (time.monotonic() - self._start) / self._done * (self._count - self._done)
        text = f"{self._done} of {self._count} parts, {self._failed} failed, {left:.0f} s left"
        if self._terminal:
            width = 30 * self._done // self._count
            end = "\n" if self._done == self._count else ""
            print(f"\r[{'#' * width}{'.' * (30 - width)}] {text}   ", end=end, file=sys.stderr, flush=True)
        else:
            print(f"progress: {text}", file=sys.stderr, flush=True)


def run_tasks(tasks: List[Task], options: argparse.Namespace, executor: Executor) -> List[Dict[str, Any]]:
    """Meshes the parts that have no valid record yet. Returns the records of all parts, in the order of the tasks."""
    records = {task.part: done_before(task) for task in tasks}
    left = [task for task in tasks if records[task.part] is None]
    if left:
        command = None
        if not options.scheduler:  # with a scheduler, each machine finds its own command
            command = find_command(options.command)
            check_version(command)
        records.update(_collect(executor, left, command, _Bar(len(left), options.quiet)))
    return [record for record in (records[task.part] for task in tasks) if record is not None]


def _collect(executor: Executor, tasks: List[Task], command: Optional[str], bar: _Bar) -> Dict[str, Dict[str, Any]]:
    futures = {executor.submit(mesh_part, task, command): task for task in tasks}
    records = {}
    try:
        for future in as_completed(futures):
            task = futures[future]
            try:
                record = future.result()
            except Exception as error:  # without a record on disk, the next run tries again
                record = _record(task, "failed", sentence_of(error))
            records[task.part] = record
            bar.step(record)
    finally:
        for future in futures:
            future.cancel()
    return records


def sentence_of(error: Exception) -> str:
    """What the user is told of an error."""
    if isinstance(error, OSError):
        return f"{error.filename or 'output'}: {error.strerror or error}"
    return str(error) if isinstance(error, Error) else f"the run was lost ({error!r})"


def write_csv(path: Path, records: Iterable[Dict[str, Any]]) -> None:
    """Writes a table with one line per part. Spreadsheets take no text in it for a formula."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(COLUMNS)
    for record in records:
        cells = [_shown(record.get(column)) for column in COLUMNS]
        writer.writerow("'" + cell if cell.startswith(("=", "+", "-", "@")) and column not in NUMBERS else cell
                        for column, cell in zip(COLUMNS, cells))
    write_whole(path, text.getvalue())


def _shown(value: Any) -> str:
    return "" if value is None else printable(str(value))


_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ font: 14px sans-serif; margin: 2em; }} table {{ border-collapse: collapse; }}
td, th {{ border-bottom: 1px solid #ccc; padding: 4px 10px; text-align: right; vertical-align: middle; }}
td:first-child, td:nth-child(2), td:last-child, th {{ text-align: left; }} th {{ cursor: pointer; position: sticky; top: 0;
background: #eee; }} img {{ width: 160px; display: block; }} .failed {{ background: #fdd; }}
</style></head><body><h1>{title}</h1><p>{summary}</p><table><thead><tr>{head}</tr></thead><tbody>
{rows}
</tbody></table><script>
document.querySelectorAll("th").forEach((th, column) => th.onclick = () => {{
  const body = document.querySelector("tbody"), sign = th.dataset.sign = -(th.dataset.sign || -1);
  const value = row => {{ const text = row.cells[column].dataset.value, number = parseFloat(text);
    return text !== "" && !isNaN(text) ? number : text; }};
  [...body.rows].sort((a, b) => {{ const x = value(a), y = value(b);
    return sign * (typeof x === typeof y ? (x < y ? -1 : x > y) : typeof x === "number" ? -1 : 1); }})
    .forEach(row => body.appendChild(row));
}});
</script></body></html>
"""


def write_page(path: Path, records: List[Dict[str, Any]], title: str) -> None:
    """Writes an HTML table with pictures. A click on a column's name sorts by that column."""
    rows = []
    for record in records:
        picture = record.get("picture")
        cells = []
        for column in COLUMNS:
            value = record.get(column)
            shown = html.escape(f"{value:.3g}" if isinstance(value, float) else _shown(value))
            if column == "part" and picture:
                link = urllib.parse.quote(os.fsencode(os.path.relpath(picture, path.parent).replace(os.sep, "/")))
                shown = f'<a href="{link}"><img src="{link}" loading="lazy" alt=""></a>{shown}'
            cells.append(f'<td data-value="{html.escape(_shown(value))}">{shown}</td>')
        rows.append(f'<tr class="{record["status"]}">{"".join(cells)}</tr>')
    page = _PAGE.format(title=html.escape(printable(title)), summary=html.escape(summary_of(records)), rows="\n".join(rows),
                        head="".join(f"<th>{column.replace('_', ' ')}</th>" for column in COLUMNS))
    write_whole(path, page)


def summary_of(records: List[Dict[str, Any]]) -> str:
    """One sentence about all parts."""
    meshed = [record for record in records if record["status"] == "meshed"]
    seconds = sum(record.get("seconds") or 0 for record in records)
    return (f"{len(meshed)} of {len(records)} parts meshed, {sum(record['quads'] for record in meshed)} quads, "
            f"{seconds:.1f} s of work.")


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        super().error(printable(message))


def parser() -> argparse.ArgumentParser:
    """The parser for this module's options, and for those of `quadrille mesh` from the table of settings."""
    result = _Parser(prog="python3 -m quadrille.batch", description=__doc__.split("\n", 1)[0], allow_abbrev=False)
    result.add_argument("folder", metavar="FOLDER", help="folder of CAD files; its subfolders are searched too")
    result.add_argument("-o", "--output", metavar="OUT", required=True, help="folder for meshes, pictures and the report")
    result.add_argument("--format", choices=FORMATS, default="msh", help="file format of the meshes (default msh)")
    result.add_argument("--workers", type=_positive, default=os.cpu_count(), help="parts at a time (default: one per core)")
    result.add_argument("--scheduler", metavar="ADDRESS", help="Dask scheduler to use, as tls://host:8786; its workers must "
                        "see the same folders, and import quadrille")
    for name, what in (("ca", "certificate of the authority that signed those of"), ("cert", "own certificate for"),
                       ("key", "key of the own certificate for")):
        result.add_argument(f"--tls-{name}", metavar="FILE", help=f"{what} the scheduler")
    result.add_argument("--scheduler-timeout", type=float, default=10, help="seconds to wait for it (default 10)")
    result.add_argument("--no-pictures", action="store_true", help="draw no pictures")
    result.add_argument("--command", metavar="PATH", help="the quadrille command")
    result.add_argument("--quiet", action="store_true", help="print no progress")
    group = result.add_argument_group("options of quadrille mesh")
    for setting in SETTINGS:
        kind: Dict[str, Any] = {"action": "store_true"} if setting["kind"] == "flag" else {}
        if setting["kind"] == "entries":
            kind = {"action": "append"}
        group.add_argument(setting["option"], dest=setting["name"], default=None,
                           help=setting["help"].replace("%", "%%"), **kind)
    return result


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"must be 1 or more, not {number}")
    return number


def run(arguments: Optional[List[str]] = None) -> int:
    """Runs the command. Returns its exit code: 0 all parts meshed, 1 some or none, 2 wrong usage."""
    options = parser().parse_args(arguments)
    folder, out = (Path(os.path.realpath(path)) for path in (options.folder, options.output))
    closed: Dict[str, str] = {}
    try:
        with _executor(options) as executor:
            tasks = tasks_of(options, closed)
            out.mkdir(parents=True, exist_ok=True)
            records = run_tasks(tasks, options, executor)
        records += [{"part": os.path.relpath(place, folder), "status": "failed", "reason": reason}
                    for place, reason in closed.items()]
        write_csv(out / "report.csv", records)
        write_page(out / "report.html", records, f"Quadrille: {folder.name}")
    except (Error, OSError) as error:
        print(printable(f"quadrille.batch: {sentence_of(error)}"), file=sys.stderr)
        return 2 if isinstance(error, Error) and error.kind == "usage" else 1
    if not options.quiet:
        print(summary_of(records))
    return 0 if all(record["status"] == "meshed" for record in records) else 1


if __name__ == "__main__":
    # Import it by its module name, under which the workers find it.
    from quadrille import batch

    sys.exit(batch.run())
