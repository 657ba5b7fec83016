# SPDX-License-Identifier: GPL-3.0-or-later
"""Widget to get the mesher. The task panel shows it while there is no mesher, the preferences always."""

import tempfile
import threading
from functools import partial
from pathlib import Path
from typing import Callable, Optional

import FreeCAD
from PySide import QtCore, QtGui

from ..core import mesher_setup
from ..core.command import check_version, which
from ..core.errors import Error
from ..core.jobs import PREFERENCES, find_mesher
from . import translate

_POLL_MILLISECONDS = 100


def is_missing() -> bool:
    """Whether no mesher of the addon's version can be run."""
    try:
        find_mesher()
    except Error:
        return True
    return False


def data_folder() -> Path:
    """The addon's folder in FreeCAD's user data."""
    return Path(FreeCAD.getUserAppDataDir()) / "Quadrille"


class MesherChoice(QtGui.QGroupBox):
    """Uses the command on PATH, a bundle's file, or a bundle from an address. Says what it will do before doing it."""

    def __init__(self, when_there: Callable[[str], None]) -> None:
        """when_there: called with the command's path, once that is stored in the preference."""
        super().__init__(translate("Quadrille", "Get the mesher"))
        self.setObjectName("QuadrilleMesherChoice")
        self._when_there = when_there
        self._archive: Optional[Path] = None
        self._thread: Optional[threading.Thread] = None
        self._outcome: object = None
        self._downloads: Optional[tempfile.TemporaryDirectory] = None
        self._build()
        self._timer = QtCore.QTimer(self)
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)

    def _build(self) -> None:
        self.on_path = QtGui.QPushButton(translate("Quadrille", "Use the one on PATH"))
        self.on_path.setObjectName("QuadrilleMesherOnPath")
        try:
            self._found, why = which("quadrille"), translate("Quadrille", "There is no command quadrille on PATH")
        except Error as error:  # inside Flatpak
            self._found, why = None, str(error)
        self.on_path.setEnabled(self._found is not None)
        self.on_path.setToolTip(self._found or why)
        self.on_path.clicked.connect(self._take_path)
        self.file = QtGui.QPushButton(translate("Quadrille", "Use a bundle file ..."))
        self.file.setObjectName("QuadrilleMesherFile")
        self.file.clicked.connect(self._browse)
        self.address = QtGui.QLineEdit()
        self.address.setObjectName("QuadrilleMesherAddress")
        self.address.setPlaceholderText("https://.../quadrille-...-linux-x86_64.tar.xz")
        self.fetch = QtGui.QPushButton(translate("Quadrille", "Download"))
        self.fetch.setObjectName("QuadrilleMesherDownload")
        self.fetch.clicked.connect(self._download)
        self.text = QtGui.QLabel(translate(
            "Quadrille", "A bundle is unpacked into {}, tested, and entered in the preferences. Nothing else is changed.").format(
                data_folder() / "mesher"))
        self.text.setObjectName("QuadrilleMesherText")
        self.text.setWordWrap(True)
        self.text.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Preferred)  # a panel is narrow
        self.text.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.install = QtGui.QPushButton(translate("Quadrille", "Install it"))
        self.install.setObjectName("QuadrilleMesherInstall")
        self.install.setEnabled(False)
        self.install.clicked.connect(self._install)
        layout = QtGui.QVBoxLayout(self)
        for widget in (self.on_path, self.file, self.address, self.fetch, self.text, self.install):
            layout.addWidget(widget)

    def _take_path(self) -> None:
        assert self._found is not None  # else the button is disabled
        try:
            check_version(self._found)
        except Error as error:
            self.text.setText(str(error))
            return
        self._use(self._found)

    def _browse(self) -> None:
        path, _ = QtGui.QFileDialog.getOpenFileName(self, translate("Quadrille", "A bundle of Quadrille"), "",
                                                    "*.tar.xz *.tar.gz")
        if path:
            self.offer(Path(path))

    def offer(self, archive: Path) -> None:
        """Shows what would be installed, and its checksum."""
        self._work(lambda: (archive, mesher_setup.checksum(archive)))

    def _download(self) -> None:
        address = self.address.text().strip()
        self._downloads = tempfile.TemporaryDirectory(prefix="quadrille-download-")
        folder = self._downloads.name

        def work():
            archive = mesher_setup.download(address, folder)
            return archive, mesher_setup.checksum(archive)

        self.text.setText(translate("Quadrille", "downloading {}").format(address))
        self._work(work)

    def _install(self) -> None:
        archive = self._archive
        assert archive is not None  # else the button is disabled
        self.text.setText(translate("Quadrille", "unpacking {}").format(archive))
        self._work(partial(mesher_setup.install, archive, data_folder()), archive)

    def _work(self, function: Callable[[], object], archive: Optional[Path] = None) -> None:
        """Runs a function in a thread. _poll() takes its result, or the Error that it raises; then `archive` can be
        installed, or the one that the function returns."""
        if self._thread is not None:
            return
        self._archive = archive

        def run() -> None:
            try:
                self._outcome = function()
            except Error as error:
                self._outcome = error

        self._set_busy(True)
        self._thread = threading.Thread(target=run, daemon=True)
        self._thread.start()
        self._timer.start()

    def _set_busy(self, busy: bool) -> None:
        for widget in (self.file, self.fetch, self.address):
            widget.setEnabled(not busy)
        self.on_path.setEnabled(not busy and self._found is not None)
        self.install.setEnabled(not busy and self._archive is not None)

    def _poll(self) -> None:
        if self._thread is None or self._thread.is_alive():
            return
        self._timer.stop()
        self._thread, outcome = None, self._outcome
        if isinstance(outcome, tuple):
            archive, digest = outcome
            self._archive = archive
            digest = "\n".join(digest[i:i + 32] for i in (0, 32))  # a panel is narrow
            self.text.setText(translate(
                "Quadrille", "{} has the SHA-256\n{}\nCompare it with the one published with the file. "
                "Installing unpacks it into {} and runs it.").format(archive.name, digest, data_folder() / "mesher"))
        elif isinstance(outcome, str):
            self._use(outcome)
        else:
            self.text.setText(str(outcome))
        self._set_busy(False)

    def _use(self, command: str) -> None:
        FreeCAD.ParamGet(PREFERENCES).SetString("Command", command)
        self.text.setText(translate("Quadrille", "uses {}").format(command))
        self._when_there(command)
