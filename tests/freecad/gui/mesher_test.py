"""Where the mesher comes from, in FreeCAD's window: the panel without one, a bundle's file, an address.

    scripts/freecad_gui tests/freecad/gui/mesher_test.py
"""

import hashlib
import io
import os
import sys
import tarfile
import tempfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
from PySide import QtGui

from case import GuiCase, picture, run
from driver import close_panel, find, process, wait_for, window
from quadrille.core import command
from quadrille.core.command import VERSION
from quadrille.core.jobs import PREFERENCES
from quadrille.gui import mesher_choice, task_panel


class MesherTest(GuiCase):
    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        patch = mock.patch.object(mesher_choice, "data_folder", lambda: self.folder / "data")
        patch.start()
        self.addCleanup(patch.stop)
        self.addCleanup(lambda: FreeCAD.ParamGet(PREFERENCES).RemString("Command"))

    def bundle(self):
        """Like that of scripts/bundle.sh, its command a script."""
        path, script = self.folder / "bundle.tar.xz", f"#!/bin/sh\necho quadrille {VERSION}\n".encode()
        with tarfile.open(path, "w:xz") as archive:
            entry = tarfile.TarInfo(f"quadrille-{VERSION}/bin/quadrille")
            entry.size, entry.mode = len(script), 0o755
            archive.addfile(entry, io.BytesIO(script))
        return path

    def installed(self, archive):
        """Presses Install once the checksum is shown; the preference then names the command."""
        digest = hashlib.sha256(archive.read_bytes()).hexdigest()
        wait_for(lambda: digest in find("QuadrilleMesherText").text().replace("\n", ""), what="the checksum")
        picture("mesher_choice")
        self.assertFalse((self.folder / "data").exists())
        find("QuadrilleMesherInstall").click()
        command = str(self.folder / "data" / "mesher" / "bin" / "quadrille")
        wait_for(lambda: FreeCAD.ParamGet(PREFERENCES).GetString("Command", "") == command, what="the command")
        self.assertTrue(os.access(command, os.X_OK))
        process(0.2)
        self.assertTrue(find("QuadrilleMesherChoice").isHidden())

    def test_panel_without_a_mesher_takes_a_bundle(self):
        with mock.patch.object(task_panel, "is_missing", lambda: True):
            self.open_panel(self.box())
        self.assertFalse(find("QuadrilleMesherInstall").isEnabled())
        self.assertIn(str(self.folder / "data" / "mesher"), find("QuadrilleMesherText").text())
        archive = self.bundle()
        find("QuadrilleMesherChoice").offer(archive)
        self.installed(archive)
        close_panel()

    def test_panel_without_a_mesher_takes_an_address(self):
        with mock.patch.object(task_panel, "is_missing", lambda: True):
            self.open_panel(self.box())
        find("QuadrilleMesherAddress").setText("file:///nowhere/bundle.tar.xz")
        find("QuadrilleMesherDownload").click()
        wait_for(lambda: "cannot be downloaded" in find("QuadrilleMesherText").text(), what="the refusal")
        self.assertFalse(find("QuadrilleMesherInstall").isEnabled())
        archive = self.bundle()
        for address, there in ((archive.as_uri(), True), ("file:///nowhere/bundle.tar.xz", False)):
            find("QuadrilleMesherAddress").setText(address)
            find("QuadrilleMesherDownload").click()
            for name in ("QuadrilleMesherInstall", "QuadrilleMesherOnPath", "QuadrilleMesherFile"):
                self.assertFalse(find(name).isEnabled())
            wait_for(lambda: find("QuadrilleMesherFile").isEnabled(), what="the end")
            self.assertEqual(find("QuadrilleMesherInstall").isEnabled(), there)
        find("QuadrilleMesherAddress").setText(archive.as_uri())
        find("QuadrilleMesherDownload").click()
        self.installed(archive)
        close_panel()

    def test_in_flatpak_the_mesher_on_the_hosts_path_is_offered(self):
        host, spawn, info = self.folder / "host", self.folder / "flatpak-spawn", self.folder / "info"
        host.mkdir()
        info.touch()
        spawn.write_text(f'#!/bin/sh\nshift 2\nPATH={host}:/usr/bin:/bin\nexport PATH\nexec "$@"\n')
        (host / "quadrille").write_text(f"#!/bin/sh\necho quadrille {VERSION}\n")
        for path in (spawn, host / "quadrille"):
            path.chmod(0o755)
        used = []
        with mock.patch.object(command, "FLATPAK_INFO", info), mock.patch.dict(os.environ, PATH=str(self.folder)):
            choice = mesher_choice.MesherChoice(used.append)
            self.assertEqual((choice.on_path.isEnabled(), choice.on_path.toolTip()), (True, str(host / "quadrille")))
            choice.on_path.click()
            spawn.unlink()
            choice = mesher_choice.MesherChoice(used.append)
            self.assertFalse(choice.on_path.isEnabled())
            self.assertIn("flatpak override", choice.on_path.toolTip())
        self.assertEqual(used, [str(host / "quadrille")])

    def test_panel_with_a_mesher_does_not_ask(self):
        self.open_panel(self.box())
        self.assertEqual(window().findChildren(QtGui.QWidget, "QuadrilleMesherChoice"), [])
        close_panel()


run(MesherTest)
