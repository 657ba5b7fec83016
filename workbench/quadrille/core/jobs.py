# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a Part shape in a child process. The shape goes to the `quadrille` command as a BREP file, and the mesh comes back
as a UNV file with its groups. Runs inside FreeCAD."""

import os
import time
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple, Union

import FreeCAD
import Fem

from . import command as child
from .command import MeshJob, Progress, check_version, find_command, scratch_folder
from .errors import Error, translate
from .setting_table import MeshSettings, in_words_of_panel, subject_of

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Quadrille"


def find_mesher(command: Optional[str] = None) -> str:
    """The path of the `quadrille` command. Checks that its version fits this addon."""
    preference = FreeCAD.ParamGet(PREFERENCES).GetString("Command", "")
    path = find_command(command, preference or None)
    check_version(path)
    return path


def stand_by() -> None:
    """Starts a standby mesher for the next meshing, if the command is found; dismiss() of command.py ends it."""
    try:
        child.stand_by(find_mesher())
    except Error:
        pass


class FemJob:
    """A run of the command whose mesh FreeCAD reads. Call start(), then wait(), or poll() from a timer until it has ended.
    result() returns the mesh."""

    def __init__(self, command: str, folder, output: str, job: MeshJob) -> None:
        """folder: the job's scratch folder, removed when the job has ended; output: the .unv file in it."""
        self._command, self._folder, self._output, self._job = command, folder, output, job
        self.started = 0.0  #: when start() was called, by time.monotonic()
        self._report: Optional[Dict] = None
        self._result: Optional[Tuple["Fem.FemMesh", Dict]] = None

    def start(self):
        """Starts the child process."""
        self.started = time.monotonic()
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

    @property
    def messages(self) -> Sequence[str]:
        """What the mesher has written to stderr besides its progress."""
        return [in_own_words(message) for message in self._job.messages]

    def poll(self) -> Sequence[Tuple[str, float]]:
        """The progress since the last call, as (stage, fraction) pairs; never waits."""
        return self._job.poll()

    def cancel(self) -> None:
        """Ends the child process; result() then raises an Error of kind "cancelled"."""
        self._job.cancel()

    def wait(self, progress: Optional[Progress] = None) -> None:
        """Waits for the end and passes progress on."""
        try:
            self._report = self._job.wait(progress)
        except Error as error:
            self._folder.cleanup()
            raise error_in_own_words(error) from error
        except BaseException:
            self._folder.cleanup()
            raise

    def result(self) -> Tuple["Fem.FemMesh", Dict]:
        """The mesh and the mesher's report, once the child has ended. Raises Error if it failed."""
        if self._result is None:
            self._result = self._read_result()
        return self._result

    def _read_result(self) -> Tuple["Fem.FemMesh", Dict]:
        try:
            report = self._report if self._report is not None else self._job.result()
            fem_mesh = read_mesh(self._output)
        except Error as error:
            raise error_in_own_words(error) from error
        finally:
            self._folder.cleanup()
        # FreeCAD's reader returns an empty mesh if it does not understand a file.
        wanted = report.get("counts", {}).get("quads", 0)
        if fem_mesh.FaceCount != wanted or not wanted:
            raise Error(translate("Quadrille", "FreeCAD read {} of the {} quads that {} wrote").format(
                fem_mesh.FaceCount, wanted, self._command), "failure", self._command)
        if "imprinted" in report:
            _with_names_of_the_part(fem_mesh, report["imprinted"])
        return fem_mesh, report

    def wait_for_result(self, progress: Optional[Progress] = None) -> Tuple["Fem.FemMesh", Dict]:
        """wait(), then result()."""
        self.wait(progress)
        return self.result()


class ShapeJob(FemJob):
    """The meshing of a shape in a child process."""

    def __init__(
        self,
        shape,
        settings: MeshSettings,
        command: Optional[str] = None,
        outputs: Sequence[Union[str, Path]] = (),
        picture: Optional[Union[str, Path]] = None,
        brep: Optional[bytes] = None,
    ) -> None:
        if shape.isNull() or not shape.Faces:
            raise Error(translate("Quadrille", "the shape has no faces to mesh"), "usage")
        command = find_mesher(command)
        folder = scratch_folder()
        model, output = (os.path.join(folder.name, name) for name in ("shape.brep", "mesh.unv"))
        if brep is None:
            shape.exportBrep(model)
            brep = Path(model).read_bytes()
        else:
            Path(model).write_bytes(brep)
        self.brep = brep  #: the shape that the mesher gets
        self.made_of: Tuple[List[float], str] = ([], "")  #: fingerprint of the part, and settings, when the job was started
        self.kept: List[str] = []  #: faces and edges that the analysis refers to
        self.found: Dict[Tuple[str, str, str], str] = {}  #: current names of faces, edges, vertices, see links.py
        super().__init__(command, folder, output, MeshJob(model, [output, *outputs], settings, command, picture))


def read_mesh(path: Union[str, Path]) -> "Fem.FemMesh":
    """Reads a mesh file as a FEM mesh. Equivalent to Fem.read(), but faster.

    A mesh made by Fem.read() keeps a log of each command that built it, which nobody reads. The log takes a quarter of the
    time to read a mesh, and half of the time to copy one after more than one was made. A copied mesh, even a copy of an
    empty one, keeps no log.
    """
    fem_mesh = Fem.FemMesh(Fem.FemMesh())
    fem_mesh.read(str(path))
    return fem_mesh


def in_own_words(sentence: str) -> str:
    """A sentence of the command with the panel's words, in the language of the panel, instead of options."""
    if not FreeCAD.GuiUp:
        return in_words_of_panel(sentence)
    return in_words_of_panel(sentence, lambda label: translate("QuadrilleSettings", label))


def error_in_own_words(error: Error) -> Error:
    """The same error, with its sentence in the panel's words, and the property concerned as its subject."""
    return Error(in_own_words(str(error)), error.kind, error.subject or subject_of(str(error)))


def _with_names_of_the_part(fem_mesh: "Fem.FemMesh", pieces: Dict[str, List[str]]) -> None:
    """Gives the groups of an imprinted part's faces, edges and vertices the names that these have in FreeCAD.

    Args:
        pieces: by the name in FreeCAD, the names of what it became. Where sewing has renumbered edges, none are known: such
            groups are left out, and FreeCAD finds the nodes by their places.
    """
    kinds = {"Face": "Face", "Edge": "Edge", "Vertex": "Node"}
    members: Dict[str, Tuple[int, ...]] = {}
    for number in fem_mesh.Groups:
        name = fem_mesh.getGroupName(number)
        kind = name.rstrip("0123456789")
        if kind != name and kinds.get(kind) == fem_mesh.getGroupElementType(number):
            members[name] = fem_mesh.getGroupElements(number)
            fem_mesh.removeGroup(number)
    for name, own in pieces.items():
        ids = sorted({element for piece in own for element in members.get(piece, ())})
        if ids:
            fem_mesh.addGroupElements(fem_mesh.addGroup(name, kinds[name.rstrip("0123456789")]), ids)
