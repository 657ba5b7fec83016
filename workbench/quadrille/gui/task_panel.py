# SPDX-License-Identifier: GPL-3.0-or-later
"""The task panel of a mesh object: settings, refinements, estimate, Mesh and Stop, progress, result.

The mesher is a child process that a timer polls, so FreeCAD stays usable meanwhile. The panel's settings are stored in the
document with the mesh, or by OK, each as one undo step. Cancel undoes all of it.
"""

import time
from functools import partial
from typing import Any, Callable, Dict, Optional, Sequence

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..core import command, jobs
from ..core.errors import Error
from ..core.setting_table import default_size
from ..core.units import digits
from ..document import groups, links, old_documents, picks, shapes, state
from ..features import mesh_object as core
from ..features.sizes import Count
from ..solvers import element_types, results
from . import (background, do, drawn_icon, links_text, mesh_clicks, path_of, preferences, progress_bar, standard_buttons, tell,
               tell_briefly, translate)
from .counting import FAILURES, Counting
from .element_choice import ElementChoice
from .element_view import Ball
from .entry_rows import NAMES, EntryRows
from .entry_rows import PROPERTIES as ENTRIES
from .face_counts import FaceCounts
from .field_errors import FieldError, below, unknown_names
from .mesher_choice import MesherChoice, is_missing
from .quality_view import QualityWidget
from .refinement_list import RefinementList
from .scrolled import Scrolled
from .session import Session
from .setting_widgets import setting_widgets
from .size_preview import SizePreview
from .stages import words_of
from .thin_hint import thin_hint
from .wheel import calm

_POLL_MILLISECONDS = 10
#: Delay before a standby mesher is started, after opening and after meshing, which it would slow down.
_STAND_BY_MILLISECONDS = 500
#: The mesher's minimum size, where none is given, is the size divided by this (see "Minimum" in the table of settings).
_SIZE_TO_MINIMUM = 8
#: How far a count may be above the wanted one without a word, as a factor; the mesher suggests no size above a tenth of the part's
#: diagonal, here with a margin for rounding and for another measure of the diagonal.
_CLOSE, _LARGEST = 1.1, 0.095
#: The beginning of the mesher's notes on what it left out, crossed or made poor: the table of what went lists it, in the user's language.
_LISTED = "note: "
#: Properties that are always visible; the others are under "More settings".
_IN_SIGHT = ("Size", "ElementOrder", "Faces")
#: Stands for the field that an error concerns if it concerns none: it is shown below the expected number.
_NO_FIELD = ""


class MeshPanel:
    """The panel that edits and meshes one mesh object."""

    def __init__(self, mesh, made_by: str = "") -> None:
        """made_by: the undo step that has just made the mesh object, see Session."""
        self.mesh = mesh
        self._document_name, self._name = mesh.Document.Name, mesh.Name
        old_documents.mesh_regions(mesh)
        self._session = Session(mesh, made_by)
        self._job: Optional[core.ShapeJob] = None
        self._job_wanted: state.Wanted  # set with the job
        self._anew: set = set()
        self._refused: Dict[str, str] = {}  # what the mesher has said about fields that have not changed since, by property
        self._part_was_visible = mesh.Shape.ViewObject.Visibility
        self._counting = Counting(self._counted)
        # A new mesh gets a size, unless the user gives one before it is found.
        self._suggests = bool(made_by) and not mesh.Size
        self._mesh_when_suggested = False
        self._refined_here = False  # since the mesh was made
        self._build()
        self._load()
        self._timer = QtCore.QTimer()  # without the form as parent: it must outlive a form that FreeCAD deletes
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)
        self.form.destroyed.connect(self._form_gone)
        FreeCAD.addDocumentObserver(self)
        self._observing = True
        QtCore.QTimer.singleShot(_STAND_BY_MILLISECONDS, self._stand_by)
        QtCore.QTimer.singleShot(0, self._hint_at_thin)
        self._update_estimate()
        job = background.take_back(mesh)
        if job is not None:
            self._job_wanted = state.wanted_of(mesh)
            self._follow(job)

    # Widgets

    def _build(self) -> None:
        self.form = Scrolled()
        self.form.setWindowTitle(translate("Quadrille", "Quad mesh"))
        self.form.setWindowIcon(drawn_icon("quadrille_mesh"))
        self.settings = setting_widgets()
        self.suggest = _button("QuadrilleSuggest", translate("Quadrille", "Suggest"),
                               translate("Quadrille", "The size that gives about {} elements").format(preferences.suggested_quads()))
        self.take_selection = _button("QuadrilleTakeSelection", translate("Quadrille", "From selection"),
                                      translate("Quadrille", "Mesh only the faces that are selected in the 3-D view"))
        self.element = ElementChoice()
        self.surfaces = QtGui.QCheckBox(translate("Quadrille", "Stresses at the surfaces"))
        self.surfaces.setObjectName("QuadrilleSurfaces")
        self.surfaces.setToolTip(translate(
            "Quadrille", "CalculiX then gives results at the top and bottom of the shell, where bending stresses occur, not only "
            "at its middle (the solver's property Beam Shell Result Output 3D)"))
        self.estimate = QtGui.QLabel()
        self.estimate.setObjectName("QuadrilleEstimate")
        self.estimate.setWordWrap(True)
        self.estimate_error = FieldError("Estimate")
        self.by_face = FaceCounts(self.mesh)
        self.refinements = RefinementList(self._refine_selection, lambda: self._changed("Refinements"))
        self.refinements_error, self.entries_error = FieldError("Refinements"), FieldError("Entries")
        self.follows = QtGui.QCheckBox(translate("Quadrille", "Follow results"))
        self.follows.setObjectName("QuadrilleFollows")
        self.entries = EntryRows(self._divide_selection, self._place_nodes, lambda: self._changed(*ENTRIES))
        self.preview = SizePreview(self.mesh, self._wanted, self._show_count)
        self.mesh_button = _button("QuadrilleMesh", translate("Quadrille", "Mesh"), "")
        self.mesh_button.setIcon(drawn_icon("quadrille_mesh"))
        self.stop_button = _button("QuadrilleStop", translate("Quadrille", "Stop"), translate("Quadrille", "Ends the mesher"))
        self.stop_button.setEnabled(False)
        self.show_other = _button("QuadrilleShowOther", translate("Quadrille", "Show part / mesh"),
                                  translate("Quadrille", "Shows the mesh instead of the part, or the part instead of the mesh"))
        self.show_other.clicked.connect(lambda *_: mesh_clicks.toggle(self.mesh))
        self.bar = QtGui.QProgressBar()
        self.bar.setObjectName("QuadrilleProgress")
        policy = self.bar.sizePolicy()
        policy.setRetainSizeWhenHidden(True)  # the buttons above do not move when it appears
        self.bar.setSizePolicy(policy)
        self.bar.hide()
        self.log = QtGui.QPlainTextEdit()
        self.log.setObjectName("QuadrilleLog")
        self.log.setReadOnly(True)
        self.log.setMaximumHeight(80)
        self.log.hide()  # until there is something to say
        self.log.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self.quality = QualityWidget(self.mesh, self._refine_here, self._keep)
        self._lay_out()
        self.suggest.clicked.connect(self._suggest)
        self.take_selection.clicked.connect(self._take_selection)
        self.mesh_button.clicked.connect(self._start)
        self.stop_button.clicked.connect(self._stop)
        self.follows.toggled.connect(lambda *_: self._update_estimate())
        for name, setting in self.settings.items():
            setting.when_changed(partial(self._changed, name))

    def _lay_out(self) -> None:
        basic, more = _form(), _form()
        part = QtGui.QLabel(self.mesh.Shape.Label)
        part.setWordWrap(True)
        basic.addRow(translate("Quadrille", "Part"), part)
        beside = {"Size": self.suggest, "Faces": self.take_selection}
        for name, setting in self.settings.items():
            widget = _beside(setting.widget, beside[name]) if name in beside else setting.widget
            (basic if name in _IN_SIGHT else more).addRow(setting.label, below(widget, setting.error))
        if self._solvers():
            basic.addRow(self.surfaces)
        basic.addRow(translate("Quadrille", "Expected"), below(self.estimate, self.estimate_error))
        layout = QtGui.QVBoxLayout(self.form.content)
        if is_missing():
            choice = MesherChoice(lambda _command: choice.hide())
            layout.addWidget(choice)
        self._hint = QtGui.QVBoxLayout()
        layout.addLayout(self._hint)
        layout.addLayout(basic)
        layout.addWidget(_section("QuadrilleByFace", translate("Quadrille", "Expected by face"), self.by_face, False, self.by_face.open))
        layout.addWidget(self.preview)
        layout.addWidget(self.show_other)
        layout.addWidget(self.log)
        listed = QtGui.QWidget()
        rows = QtGui.QVBoxLayout(listed)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.addWidget(self.follows)
        rows.addWidget(below(self.refinements, self.refinements_error))
        rows.addWidget(below(self.entries, self.entries_error))
        refinements = _section("QuadrilleRefinements", translate("Quadrille", "Refinements"), listed,
                               any(getattr(self.mesh, name) for name in ("MeshRegionList", state.ADAPTED, *ENTRIES)))
        more.addRow(translate("Quadrille", "Elements"), self.element)
        holder = QtGui.QWidget()
        holder.setLayout(more)
        is_plain_shell = self.mesh.Element == element_types.SHELL
        changed = any(name not in _IN_SIGHT and getattr(self.mesh, name) != default
                      for name, default in core.defaults().items() if name in self.settings) or not is_plain_shell
        layout.addWidget(refinements)
        layout.addWidget(_section("QuadrilleMore", translate("Quadrille", "More settings"), holder, changed))
        layout.addWidget(self.quality)
        layout.addStretch()
        always = QtGui.QVBoxLayout(self.form.below)
        always.addWidget(_beside(self.mesh_button, self.stop_button))
        always.addWidget(self.bar)
        calm(self.form)

    def _load(self) -> None:
        wanted = state.wanted_of(self.mesh)
        for name, setting in self.settings.items():
            value = wanted.values[name]
            setting.show(links.names_in(value) if name in links.OWN else value)
        self.element.show_element(self.mesh.Element)
        self.follows.setVisible(bool(wanted.values[state.ADAPTED]))
        self.follows.setChecked(wanted.values[state.FOLLOWS])
        self.entries.show_all(wanted.values)
        self.refinements.show_all(wanted.refinements)
        self.surfaces.setChecked(all(getattr(solver, results.SURFACE_RESULTS) for solver in self._solvers()))

    def _solvers(self) -> list:
        """Those that can give stresses at the surfaces; none for elements that have no bending."""
        return results.solvers_of(groups.analysis_of(self.mesh)) if element_types.is_shell(self.mesh) else []

    # Settings

    def _wanted(self) -> state.Wanted:
        """The settings that the panel shows. Raises Error if a field cannot be read."""
        part = state.part_of(self.mesh)
        values = dict(state.wanted_of(self.mesh).values)
        anew = set(self._anew)
        for name, setting in self.settings.items():
            shown = setting.value()
            if name not in links.OWN:
                values[name] = shown
            elif shown != links.names_in(values[name]):
                unknown = unknown_names(part, shown, ("Face",))
                if unknown:
                    raise Error(unknown, "usage", name)
                values[name] = links.link(part, shown)
                anew.add(name)
        unknown = unknown_names(part, self.entries.names(), ("Face", "Edge", "Vertex"))
        if unknown:
            raise Error(unknown, "usage", NAMES)
        values.update(self.entries.values(), **{state.FOLLOWS: self.follows.isChecked()})
        return state.Wanted(values, self.refinements.refinements(), frozenset(anew))

    def _commands(self, wanted: state.Wanted) -> list:
        """The lines of Python that store the wanted settings in the document."""
        mesh, present = self.mesh, state.wanted_of(self.mesh)
        lines = []
        for name, value in wanted.values.items():
            stored = getattr(present.values[name], "Value", present.values[name])
            if name in links.OWN:
                if name in wanted.anew:
                    lines.append(f"{path_of(mesh)}.{name} = {links_text(value)}")
            elif getattr(value, "Value", value) != stored:
                lines.append(f"{path_of(mesh)}.{name} = {getattr(value, 'Value', value)!r}")
        sizes = {entry.region: entry.size for entry in present.refinements}
        kept = {entry.region for entry in wanted.refinements}
        lines += [f"App.getDocument({mesh.Document.Name!r}).removeObject({name!r})" for name in sizes if name not in kept]
        for region, references, size in wanted.refinements:
            if not region:
                lines.append(f"quadrille.freecad.refine({path_of(mesh)}, {links_text(references)}, {size!r})")
            elif size != sizes.get(region, size):  # a region that was deleted meanwhile stays deleted
                lines.append(f"{path_of(mesh.Document.getObject(region))}.CharacteristicLength = {size!r}")
        if self.element.element() != mesh.Element:
            lines.append(f"{path_of(mesh)}.Element = {self.element.element()!r}")
        surfaces = self.surfaces.isChecked()
        lines += [f"{path_of(solver)}.{results.SURFACE_RESULTS} = {surfaces!r}" for solver in self._solvers()
                  if getattr(solver, results.SURFACE_RESULTS) != surfaces]
        return lines

    def _store(self, lines: list) -> None:
        do("import quadrille.freecad")
        for line in lines:
            do(line)
        self._anew.clear()
        self._load()

    # Estimate

    def _hint_at_thin(self) -> None:
        """Called when the panel is open."""
        try:
            hint = thin_hint(state.part_of(self.mesh), self.reject) if self._observing else None
        except FAILURES:  # the estimate reports it
            return
        if hint is not None:
            self._hint.addWidget(hint)

    def _changed(self, *names: str) -> None:
        """Called when a field has changed, or one of several: what the mesher said about it no longer holds."""
        for name in (*names, _NO_FIELD):
            self._refused.pop(name, None)
        if "Size" in names:
            self._suggests = False
        self._update_estimate()

    def _show_errors(self, error: Optional[Exception] = None) -> None:
        """Shows errors below the fields concerned.

        Args:
            error: the error when all fields were used together.
        """
        sentences = dict(self._refused)
        if error is not None:
            sentences[self._field_of(error)] = str(error)
        for name, setting in self.settings.items():
            setting.error.tell(self._wrong_in(name) or sentences.get(name, ""))
        self.refinements_error.tell(sentences.get("Refinements", ""))
        self.entries_error.tell("\n".join(sentences[name] for name in ENTRIES if name in sentences))
        self.estimate_error.tell(sentences.get(_NO_FIELD, ""))

    def _point_out(self, error: Error) -> bool:
        """Scrolls to the field that an error concerns, where it stands in red; opens the section around it. False if it concerns no
        field."""
        name = self._field_of(error)
        if name == _NO_FIELD:
            return False
        if name not in _IN_SIGHT:
            self.form.findChild(QtGui.QToolButton, "QuadrilleMore" if name in self.settings else "QuadrilleRefinements").setChecked(True)
        self.form.bring(self.settings[name].error if name in self.settings else
                        self.refinements_error if name == "Refinements" else self.entries_error)
        return True

    def _wrong_in(self, name: str) -> str:
        """What is wrong with a field by itself."""
        try:
            shown = self.settings[name].value()
            if name in links.OWN and shown != links.names_in(getattr(self.mesh, name)):
                return unknown_names(state.part_of(self.mesh), shown, ("Face",)) or ""
        except FAILURES as error:
            return str(error)
        return ""

    def _field_of(self, error: Exception) -> str:
        """The property that an error concerns, if it has a field here; "Refinements" for all of these; else _NO_FIELD."""
        subject = getattr(error, "subject", "")
        regions = {entry.region for entry in state.wanted_of(self.mesh).refinements if entry.region}
        if subject in regions:
            return "Refinements"
        return subject if subject in self.settings or subject in ENTRIES or subject == "Refinements" else _NO_FIELD

    def _show_minimum(self) -> None:
        """Shows the minimum size that holds where none is given: it follows the size."""
        try:
            minimum = self._usual_size() / _SIZE_TO_MINIMUM
        except FAILURES:
            minimum = None
        self.settings["SizeMin"].widget.show_otherwise(minimum)

    def _update_estimate(self) -> None:
        self._show_errors()
        self._show_minimum()
        self.preview.follow()
        try:
            wanted = self._wanted()
            found = links.follow(self.mesh, wanted.anew)
            settings = state.settings_to_use(self.mesh, wanted, found)
            shape = state.shape_of(state.part_of(self.mesh))
            shapes.check_size(shape, (self._usual_size(), *settings.get("sizes", {}).values()))
        except FAILURES as error:
            self._counting.release()
            self._show_no_count(error)
            return
        self._show_status(wanted, found)
        self.estimate.setText(f"{self.estimate.text().rstrip('. –')} ...".lstrip())  # what follows does not jump
        self._counting.ask(shape, settings, preferences.suggested_quads() if self._suggests else 0)

    def _counted(self, count: Optional[Count], problem: Optional[Exception]) -> None:
        """Called when the quads are counted, or cannot be."""
        if count is None:
            self._suggests = False
            self._show_no_count(problem)
        else:
            missed = self._suggests and self._misses(count)
            if self._suggests:
                self._take_suggestion(count.size)
            self.by_face.show_counts(count.by_face)
            self._show_count(count.quads)
            if missed:
                self.estimate.setText(translate("Quadrille", "{}: its {} faces need more than {}, unless elements are larger than a tenth "
                                                "of the part").format(self.estimate.text(), len(count.by_face), preferences.suggested_quads()))
        if self._mesh_when_suggested:
            self._mesh_when_suggested = False
            self._start()

    def _misses(self, count: Count) -> bool:
        """Whether even the largest size that is suggested gives more quads than wanted."""
        part = self.mesh.Shape
        return part is not None and count.quads > _CLOSE * preferences.suggested_quads() and \
            count.size > _LARGEST * part.Shape.BoundBox.DiagonalLength

    def _take_suggestion(self, size: float) -> None:
        self._suggests = False
        if self._session.made_by and not self.mesh.Size:
            do(f"{path_of(self.mesh)}.Size = {size!r}")
        self.settings["Size"].show(size)
        self._show_minimum()

    def _show_no_count(self, problem: Optional[Exception]) -> None:
        """Shows that there is no count, and why: at the field concerned, or here."""
        self.by_face.show_counts({})
        self.estimate.setText("–")
        self._show_errors(problem)

    def _show_status(self, wanted: state.Wanted, found) -> None:
        """Says whether the mesh is that of the settings in the panel, which the document may not have yet."""
        status = self.mesh.Status
        other_part = status in (state.PART_CHANGED, state.BOTH_CHANGED)
        if (other_part or status in (state.UP_TO_DATE, state.SETTINGS_CHANGED)) and self.mesh.MeshedSettings:
            self.quality.show_status(state.changed(self.mesh, wanted, found, other_part))

    def _show_count(self, count: float) -> None:
        self.estimate.setText(translate("Quadrille", "about {} quads").format(_rounded(round(count))))

    def _suggest(self) -> None:
        if self._told(lambda: state.part_of(self.mesh)) is None:
            return
        self._suggests = True
        self._update_estimate()

    def _take_selection(self) -> None:
        names = mesh_clicks.picked_on(self.mesh, "Face")
        if names:
            self._anew.add("Faces")
            self.settings["Faces"].show(names)
            self._update_estimate()

    def _refine_selection(self) -> None:
        names = mesh_clicks.picked_on(self.mesh, "Face", "Edge", "Vertex")
        if not names:
            return
        usual = self._told(self._usual_size)
        if usual is not None:
            self.refinements.add(links.link(self.mesh.Shape, names), float(digits(usual / 2)))

    def _refine_here(self, ball: Ball) -> None:
        """Adds a size at a place, and shows its row."""
        self.entries.add("SizeIn", {ball.place: digits(ball.size)})
        self.form.findChild(QtGui.QToolButton, "QuadrilleRefinements").setChecked(True)
        self.form.bring(self.entries.select("SizeIn", ball.place))
        self._refined_here = True

    def _keep(self, names: Sequence[str], on: bool) -> Sequence[str]:
        """Adds faces and edges to those to keep, or takes them away. Returns all that are to be kept."""
        self.entries.keep(names, on)
        return self.entries.names()

    def _divide_selection(self) -> None:
        names = mesh_clicks.picked_on(self.mesh, "Edge")
        usual = self._told(self._usual_size) if names else None
        if usual is not None:
            shape = self.mesh.Shape.Shape
            self.entries.add("Segments", {name: f"{max(1, round(shape.getElement(name).Length / usual))}" for name in names})

    def _place_nodes(self) -> None:
        part = state.part_of(self.mesh)
        try:
            points = picks.points_of(part, mesh_clicks.picked(self.mesh.Document))
        except Error as error:
            tell(str(error))
            return
        if not points:
            tell(translate("Quadrille", "Select vertices or points in the 3-D view or the tree first."))
            return
        taken = {entry.split("=")[0] for entry in self.entries.values()["NodesAt"]}
        named: Dict[str, str] = {}
        for name, point in points.items():
            free = name if name not in taken else next(f"Node{k}" for k in range(1, 10 ** 6) if f"Node{k}" not in {*taken, *points, *named})
            named[free] = ",".join(f"{value:.15g}" for value in point)
        self.entries.add("NodesAt", named)

    def _usual_size(self) -> float:
        """The global size. Raises Error if it cannot be read."""
        return self.settings["Size"].value() or default_size(state.part_of(self.mesh).Shape.BoundBox.DiagonalLength)

    @staticmethod
    def _told(find: Callable[[], Any]) -> Any:
        """What a function finds. None, with a message box, if it raises Error."""
        try:
            return find()
        except Error as error:
            tell(str(error))
            return None

    # Meshing

    def _start(self) -> None:
        if self._job is not None:
            return
        if self._suggests and self._counting.busy:
            self._mesh_when_suggested = True
            self.mesh_button.setEnabled(False)
            return
        self.mesh_button.setEnabled(True)
        self.log.clear()
        self.log.hide()
        self._refused.clear()
        self._show_errors()
        try:
            self._job_wanted = self._wanted()
            job = core.start(self.mesh, wanted=self._job_wanted)
        except Error as error:
            self._show_errors(error)
            if not self._point_out(error):
                tell(str(error))
            return
        self._follow(job)

    def _follow(self, job: core.ShapeJob) -> None:
        """Shows the progress of a job, until it ends."""
        self._job = job
        self._show_progress(0)
        self.mesh_button.setEnabled(False)
        self.stop_button.setEnabled(True)
        self._say(translate("Quadrille", "meshing"))
        self._timer.start()

    def _poll(self) -> None:
        if self._job is None:
            self._timer.stop()
            return
        for stage, fraction in self._job.poll():
            self._show_progress(fraction, stage)
        if self._job.running:
            return
        self._end(self._job)

    def _end(self, job: core.ShapeJob) -> None:
        """Stores and shows the result of a job that has ended."""
        self._job = None
        self._timer.stop()
        QtCore.QTimer.singleShot(_STAND_BY_MILLISECONDS, self._stand_by)
        self.mesh_button.setEnabled(True)
        self.stop_button.setEnabled(False)
        ended, worst_before = time.monotonic(), self.mesh.WorstQuality
        try:
            _, report = job.result()
            with self._session.step("Quad mesh"):
                self._store(self._commands(self._job_wanted))
                background.store(self.mesh, job)
        except Error as error:
            core.forget(self._document_name, self._name)
            self._show_progress(0)
            self.bar.hide()
            self.log.clear()
            if error.kind == "cancelled":
                self._say(str(error))
                return
            self.log.hide()
            self._refused[self._field_of(error)] = str(error)
            self._show_errors()
            if not self._point_out(error):
                tell(str(error))
            return
        self.preview.button.setChecked(False)
        for line in job.messages:
            if not line.startswith(_LISTED):
                self._say(line)
        self._show_progress(1)
        self._say(translate("Quadrille", "{} quads: mesher {} s, into FreeCAD {} s").format(
            self.mesh.QuadCount, digits(round(ended - job.started, 2)), digits(round(time.monotonic() - ended, 2))))
        self._tell_if_worse(worst_before)
        background.show(self.mesh)
        self.quality.refresh()
        if preferences.color_after_meshing():
            self.quality.color.setChecked(True)

    def _tell_if_worse(self, before: float) -> None:
        """Says so if the smallest q fell by a refinement at a place, which may force small elements beside large ones."""
        refined, self._refined_here = self._refined_here, False
        worst = f"{self.mesh.WorstQuality:.3f}"
        if refined and float(worst) < float(f"{before:.3f}"):
            text = translate("Quadrille", "refined where asked: the smallest q fell from {} to {}").format(f"{before:.3f}", worst)
            self._say(text)
            tell_briefly(f"{self.mesh.Label}: {text}")

    def _show_progress(self, fraction: float, stage: str = "") -> None:
        self.bar.setVisible(True)
        self.bar.setUpdatesEnabled(False)  # a new value would repaint at once, and Qt would redraw the whole window
        self.bar.setValue(round(100 * fraction))
        self.bar.setFormat(f"{words_of(stage)} %p %".lstrip())
        self.bar.setUpdatesEnabled(True)

    def _stand_by(self) -> None:
        """Starts a mesher that loads its libraries before Mesh is pressed."""
        if self._observing and self._job is None:
            jobs.stand_by()

    def _stop(self) -> None:
        if self._job is not None:
            self._job.cancel()

    def _say(self, text: str) -> None:
        self.log.appendPlainText(text)
        self.log.setVisible(True)

    # Opening and closing

    def getStandardButtons(self):
        """OK and Cancel; Mesh and Stop are in the panel."""
        return standard_buttons("Ok", "Cancel")

    def accept(self) -> bool:
        """Called on OK: keeps mesh and settings; the mesher goes on in the background."""
        try:
            if self._suggests:
                with progress_bar(translate("Quadrille", "Finding a size")) as show:
                    if not self._counting.finish(lambda: show("", 0)):
                        return False
            # If the part has been deleted meanwhile, there is nothing to set.
            lines = self._commands(self._wanted()) if self.mesh.Shape is not None else []
        except Error as error:
            self._show_errors(error)
            if not self._point_out(error):
                tell(str(error))
            return False
        if lines:
            with self._session.step("Quad mesh settings"):
                self._store(lines)
        self._session.keep()
        job, self._job = self._job, None
        self._close()
        if job is not None:
            background.go_on(self.mesh, job)
        self.mesh.Document.recompute()
        return True

    def reject(self) -> bool:
        """Called on Cancel: ends the mesher, and restores the document."""
        if self._job is not None:
            self._job.cancel()
            self._end(self._job)
        part, document = self.mesh.Shape, self.mesh.Document
        self._close()
        self._session.take_back()
        if part in document.Objects and self._part_was_visible:  # parts joined for this mesh no longer exist
            part.ViewObject.show()
        document.recompute()
        return True

    def _close(self) -> None:
        self.quality.release()
        self._leave()
        FreeCADGui.getDocument(self._document_name).resetEdit()

    def _leave(self) -> None:
        self._timer.stop()
        command.dismiss()
        self._counting.release()
        self.preview.release()
        if self._observing:
            self._observing = False
            FreeCAD.removeDocumentObserver(self)

    def _abandon(self) -> None:
        """Called when the mesh object or its document is deleted: ends the mesher and the panel."""
        job, self._job = self._job, None
        if job is not None:
            job.cancel()
            core.forget(self._document_name, self._name)
        self._leave()
        # Not from inside FreeCAD's notification.
        QtCore.QTimer.singleShot(0, FreeCADGui.Control.closeDialog)

    def _form_gone(self, *_) -> None:
        """Called when FreeCAD has closed the panel by itself: ends the mesher, as the settings can no longer be stored."""
        job, self._job = self._job, None
        if job is not None:
            job.cancel()
            core.forget(self._document_name, self._name)
            said = translate("Quadrille", "{}: not meshed, since its panel was closed").format(self._name)
            FreeCAD.Console.PrintWarning(said + "\n")
        self._session.keep()
        self._leave()

    def slotDeletedDocument(self, document) -> None:
        """FreeCAD calls this before a document closes."""
        if document.Name == self._document_name:
            self._abandon()

    def slotUndoDocument(self, document) -> None:
        """FreeCAD calls this after an undo."""
        if document.Name == self._document_name:
            QtCore.QTimer.singleShot(0, self._show_again)  # after other observers have restored the mesh

    slotRedoDocument = slotUndoDocument

    def _show_again(self) -> None:
        """Shows the settings and the quality that the document has now."""
        if self._observing and self._job is None:
            self._load()
            self.quality.refresh()

    def slotDeletedObject(self, obj) -> None:
        """FreeCAD calls this before an object is deleted (or its creation is undone)."""
        if obj.Document.Name != self._document_name:
            return
        if obj.Name == self._name:
            self._abandon()
        elif self.refinements.drop(obj.Name) or obj == self.mesh.Shape:
            QtCore.QTimer.singleShot(0, self._after_deletion)  # after it is deleted

    def _after_deletion(self) -> None:
        if self._observing:
            self._update_estimate()


def _button(name: str, text: str, tip: str):
    button = QtGui.QPushButton(text)
    button.setObjectName(name)
    button.setToolTip(tip)
    return button


def _form():
    form = QtGui.QFormLayout()
    form.setRowWrapPolicy(QtGui.QFormLayout.WrapLongRows)
    form.setFieldGrowthPolicy(QtGui.QFormLayout.AllNonFixedFieldsGrow)
    return form


def _section(name: str, title: str, content, is_open: bool, show_content: Optional[Callable[[bool], None]] = None):
    """A section: content below a title that opens and closes it.

    Args:
        show_content: shows or hides the content, if there is more to it.
    """
    section = QtGui.QWidget()
    head = QtGui.QToolButton()
    head.setObjectName(name)
    head.setText(title)
    head.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
    head.setAutoRaise(True)
    head.setCheckable(True)

    def show(on: bool) -> None:
        head.setArrowType(QtCore.Qt.DownArrow if on else QtCore.Qt.RightArrow)
        (show_content or content.setVisible)(on)

    head.toggled.connect(show)
    show(is_open)
    head.setChecked(is_open)
    layout = QtGui.QVBoxLayout(section)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.addWidget(head)
    layout.addWidget(content)
    return section


def _beside(*widgets):
    row = QtGui.QWidget()
    layout = QtGui.QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    for widget in widgets:
        layout.addWidget(widget, 0 if isinstance(widget, QtGui.QPushButton) and widget is not widgets[0] else 1)
    return row


def _rounded(count: int) -> str:
    if count < 100:
        return str(count)
    digits = len(str(count)) - 2
    return f"{round(count, -digits):,}".replace(",", " ")
