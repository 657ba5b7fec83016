# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves a mesh's analysis with CalculiX and shows the stresses. FreeCAD writes the input and reads the results; CalculiX runs in a
process of its own. FreeCAD's own command blocks the window until CalculiX has ended, and its panel until the results are read."""

import os
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Callable, Dict, Set, Tuple

import FreeCAD
import FreeCADGui
from PySide import QtCore

from ..core.errors import Error
from ..document.groups import analysis_of
from ..solvers import results
from . import progress_bar, translate

#: Milliseconds between two looks at what runs; seconds after which the window lives again while results are read.
_INTERVAL, _SECONDS = 30, 0.1
#: FreeCAD 1.1.3 crashes on closing a view if its destructor frees the Python object of its viewer, which the panel for results makes:
#: these are kept.
_viewers: Set[Any] = set()


def solve(mesh) -> None:
    """Solves, behind a bar. The analysis keeps its older results until there are new ones. Raises Error."""
    from femtools import ccxtools

    analysis = analysis_of(mesh)
    solvers = results.solvers_of(analysis)  # FreeCAD writes the same input for each of its kinds
    if len(solvers) != 1:
        raise Error(translate("Quadrille", "{}: needs an analysis with one CalculiX solver").format(mesh.Label), "usage", mesh.Name)
    tools = ccxtools.FemToolsCcx(analysis, solvers[0])
    tools.update_objects()
    tools.setup_working_dir()
    with suppress(FileNotFoundError):  # of FreeCAD 1.1; older ones tell it in a box
        tools.setup_ccx()
    missing = tools.check_prerequisites()
    if missing or not tools.ccx_binary_present:
        raise Error(missing.strip() or translate("Quadrille", "CalculiX is not installed"), "usage", mesh.Name)
    with progress_bar(translate("Quadrille", "Solving {}").format(mesh.Label), busy=True) as lives:
        def live() -> None:
            if not lives("", 0):
                raise Error(translate("Quadrille", "the work was cancelled"), "cancelled")

        tools.write_inp_file()
        _run(tools, live)
        with _alive(Path(tools.inp_file_name).with_suffix(".frd"), live):
            tools.reset_mesh_purge_results_checked()
            tools.load_results()
    if not _results(mesh):
        raise Error(translate("Quadrille", "{}: CalculiX gave no results: see the report view").format(mesh.Label), "failure", mesh.Name)


def _results(mesh) -> list:
    return [obj for obj in analysis_of(mesh).Group if obj.isDerivedFrom("Fem::FemResultObject")]


def _run(tools, live: Callable[[], None]) -> None:
    """Runs CalculiX; kills it if live() raises."""
    process = QtCore.QProcess()
    environment = QtCore.QProcessEnvironment.systemEnvironment()
    threads = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/Ccx").GetInt("AnalysisNumCPUs", 1)  # FreeCAD takes 1 for all
    environment.insert("OMP_NUM_THREADS", str(threads if threads > 1 else os.cpu_count() or 1))
    process.setProcessEnvironment(environment)
    process.setProcessChannelMode(QtCore.QProcess.MergedChannels)
    model = Path(tools.inp_file_name)
    process.setWorkingDirectory(str(model.parent))
    process.start(tools.ccx_binary, ["-i", model.stem])
    try:
        process.waitForStarted()
        while process.state() != QtCore.QProcess.NotRunning:
            process.waitForFinished(_INTERVAL)
            live()
    except BaseException:
        process.kill()
        process.waitForFinished()
        raise
    told = bytes(process.readAll()).decode(errors="replace")
    if process.exitStatus() != QtCore.QProcess.NormalExit or process.exitCode() or "*ERROR" in told:
        FreeCAD.Console.PrintError(told)
        reason = next((line.strip() for line in told.splitlines() if "*ERROR" in line), "")
        raise Error(translate("Quadrille", "CalculiX failed; the report view has what it said. {}").format(reason), "failure")


@contextmanager
def _alive(path: Path, live: Callable[[], None]):
    """FreeCAD's reader of results, with a window that lives: the file is read in a thread, before anything changes; the functions that
    the reader then calls, some for each node, let the window live from time to time."""
    import ObjectsFem
    from feminout import importCcxFrdResults, importToolsFem
    from femresult import resulttools

    with ThreadPoolExecutor(1) as thread:
        reading = thread.submit(importCcxFrdResults.read_frd_result, str(path))
        while not reading.done():
            QtCore.QThread.msleep(_INTERVAL)
            live()
    last = time.monotonic()

    def living(function: Callable) -> Callable:
        def call(*arguments):
            nonlocal last
            if time.monotonic() - last > _SECONDS:
                QtCore.QCoreApplication.processEvents()
                last = time.monotonic()
            return function(*arguments)
        return call

    own: Dict[Tuple[Any, str], Callable] = {(module, name): living(getattr(module, name)) for module, names in (
        (importToolsFem, ("make_femmesh", "fill_femresult_mechanical")), (ObjectsFem, ("makeMeshResult", "makeResultMechanical")),
        (resulttools, ("compact_result", "add_disp_apps", "calculate_von_mises", "calculate_principal_stress_std",
                       "fill_femresult_stats"))) for name in names if hasattr(module, name)}
    own[importCcxFrdResults, "read_frd_result"] = lambda _path: reading.result()
    theirs = {place: getattr(*place) for place in own}
    try:
        for place, function in own.items():
            setattr(*place, function)
        yield
    finally:
        for place, function in theirs.items():
            setattr(*place, function)


def show(mesh) -> None:
    """Shows the latest stresses alone, in FreeCAD's panel for results."""
    for obj in mesh.Document.Objects:
        if any(map(obj.isDerivedFrom, ("Part::Feature", "Fem::FemMeshObject", "Fem::FemPostObject"))):
            obj.ViewObject.hide()
    FreeCAD.FEM_dialog = {"results_type": "Sabs", "show_disp": False, "disp_factor": 0.0, "disp_factor_max": 100.0}  # von Mises
    document = FreeCADGui.getDocument(mesh.Document.Name)
    _viewers.update(view.getViewer() for view in document.mdiViewsOfType("Gui::View3DInventor"))
    document.setEdit(_results(mesh)[-1].Name)
