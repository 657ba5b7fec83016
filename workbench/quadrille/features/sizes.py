# SPDX-License-Identifier: GPL-3.0-or-later
"""The sizes that a mesh would have, shown on the surface of its part before meshing. Runs `quadrille sizes` in a child process.
Runs inside FreeCAD."""

import base64
import json
import os
import time
from typing import Dict, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ..core.command import CommandJob, scratch_folder
from ..core.errors import Error
from ..core.jobs import error_in_own_words, find_mesher
from ..core.setting_table import BY_NAME, MeshSettings
from ..document import links, state


class Source(NamedTuple):
    """A source of sizes, and the region where it requests the smallest."""

    name: str  #: the option that it comes from
    area: float  #: area of the region, mm^2
    quads: float  #: approximate number of quads in the region
    least: float  #: smallest size in the region, mm
    largest: float  #: largest size in the region, mm


class SizeMap(NamedTuple):
    """Sizes over triangles of the part's surface."""

    points: np.ndarray  #: (n, 3) float32, mm
    sizes: np.ndarray  #: (n,) mm, on bends across them
    along: np.ndarray  #: (n,) mm, on bends along them, elsewhere equal to sizes
    triangles: np.ndarray  #: (m, 3) int32, indices into points
    lines: np.ndarray  #: (k, 2) int32, along CAD edges
    quads: float  #: approximate number of quads in the mesh
    sources: Tuple[Source, ...]  #: the sources that determine the size somewhere


class Count(NamedTuple):
    """How many quads a mesh would have."""

    size: float  #: the size of elements, mm
    quads: float
    by_face: Dict[str, float]


class SizesJob:
    """One run of `quadrille sizes` on a shape. Call start(), then wait(), or poll() from a timer until it has ended."""

    def __init__(self, shape, settings: MeshSettings, command: Optional[str] = None) -> None:
        command = find_mesher(command)
        self._folder = scratch_folder()
        model = os.path.join(self._folder.name, "shape.brep")
        self._output = os.path.join(self._folder.name, "sizes.json")
        shape.exportBrep(model)
        own = MeshSettings(**{name: value for name, value in settings.items() if BY_NAME[name]["use"] != "write"})
        self._job = CommandJob(["sizes", model, *self._asks(), *own.arguments()], command)

    def _asks(self) -> Sequence[str]:
        return ("-o", self._output)

    def _understood(self, _report: Dict):
        with open(self._output, encoding="utf-8") as file:
            return _map_of(json.load(file))

    def start(self):
        """Starts the child process."""
        try:
            self._job.start()
        except Error:
            self._folder.cleanup()
            raise
        return self

    @property
    def running(self) -> bool:
        """True while the child process lives."""
        return self._job.running

    def poll(self) -> Sequence[Tuple[str, float]]:
        """The progress since the last call, as (stage, fraction) pairs; never waits."""
        return self._job.poll()

    def drop(self) -> None:
        """Kills the child process at once; the result is not wanted."""
        self._job.kill()
        self._folder.cleanup()

    def wait(self):
        """Waits for the end and returns the result."""
        try:
            while self.running:
                self.poll()
                time.sleep(0.02)
        except BaseException:
            self.drop()
            raise
        return self.result()

    def result(self):
        """The SizeMap, once the child has ended. Raises Error if it failed."""
        try:
            return self._understood(self._job.result())
        except Error as error:
            raise error_in_own_words(error) from error
        finally:
            self._folder.cleanup()


class CountJob(SizesJob):
    """The same for a Count alone, which takes far less time.

    Args:
        wanted: find the size that gives about this many quads, instead of that of the settings.
    """

    def __init__(self, shape, settings: MeshSettings, command: Optional[str] = None, wanted: int = 0) -> None:
        self._wanted = wanted
        super().__init__(shape, MeshSettings(**{**settings, "size": None}) if wanted else settings, command)

    def _asks(self) -> Sequence[str]:
        return ("--count-only", "--wanted-quads", str(self._wanted)) if self._wanted else ("--count-only",)

    def _understood(self, report: Dict) -> Count:
        return Count(report["size"], report["quads"], report["quads_by_face"])


def _map_of(told: Dict) -> SizeMap:
    sources = (Source(entry["name"], entry["area"], entry["quads"], entry["size_min"], entry["size_max"])
               for entry in told["sources"])
    points, sizes, along = (_array(told[name], np.float32) for name in ("points", "point_sizes", "point_sizes_along"))
    triangles, lines = (_array(told[name], np.int32) for name in ("triangles", "lines"))
    return SizeMap(points.reshape(-1, 3), sizes.astype(float), along.astype(float), triangles.reshape(-1, 3), lines.reshape(-1, 2),
                   told["quads"], tuple(source for source in sources if source.area > 0))


def _array(text: str, kind) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), np.dtype(kind).newbyteorder("<"))


def start(mesh, wanted: Optional[state.Wanted] = None, command: Optional[str] = None) -> SizesJob:
    """Starts a job that finds the sizes of a mesh object's mesh.

    Args:
        wanted: settings to use instead of the object's own.

    Raises:
        Error: with one sentence, if the settings or the part are invalid.
    """
    wanted = wanted or state.wanted_of(mesh)
    shape = state.shape_of(mesh.Shape)
    found = links.follow(mesh, wanted.anew)
    return SizesJob(shape, state.settings_to_use(mesh, wanted, found), command).start()


#: Colors from the smallest to the largest size, on a logarithmic scale (viridis).
_STOPS = np.array([(0.267, 0.005, 0.329), (0.229, 0.322, 0.546), (0.128, 0.567, 0.551), (0.369, 0.789, 0.383),
                   (0.993, 0.906, 0.144)])
#: Smallest ratio of the ends of a color range, so that the range is never empty.
_NARROWEST = 1.1


def range_of(sizes: np.ndarray) -> Tuple[float, float]:
    """The smallest and the largest size of the color range."""
    largest = float(sizes.max())
    return min(float(sizes.min()), largest / _NARROWEST), largest


def colors(sizes: np.ndarray, least: float, largest: float) -> np.ndarray:
    """The colors of sizes in a range, (n, 3) red, green and blue."""
    place = np.log(sizes / least) / np.log(largest / least) * (len(_STOPS) - 1)
    return np.stack([np.interp(place, np.arange(len(_STOPS)), _STOPS[:, k]) for k in range(3)], axis=1)
