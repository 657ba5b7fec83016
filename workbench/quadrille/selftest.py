# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests of `freecadcmd -t quadrille.selftest`: is the addon installed correctly? Needs the quadrille command."""

import unittest

import FreeCAD
import Part

from .core import quality
from . import freecad as core


class SelfTest(unittest.TestCase):
    """Meshes a box and measures the mesh."""

    def setUp(self) -> None:
        self.document = FreeCAD.newDocument("QuadrilleSelfTest")
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = Part.makeBox(10, 20, 30)

    def tearDown(self) -> None:
        FreeCAD.closeDocument(self.document.Name)

    def test_the_command_is_found(self) -> None:
        """The command is found on PATH, by the preference or beside the addon, and has the right version."""
        self.assertTrue(core.find_mesher())

    def test_a_box_becomes_quads(self) -> None:
        """The mesh has quads only, of good quality, and a group for each face."""
        mesh = core.mesh_object(self.part, size=2.0)
        fem_mesh = mesh.FemMesh
        self.assertGreater(fem_mesh.FaceCount, 400)
        self.assertEqual(fem_mesh.FaceCount, fem_mesh.QuadrangleCount)
        self.assertGreater(quality.measure(fem_mesh).q.min(), 0.5)
        names = {fem_mesh.getGroupName(number) for number in fem_mesh.Groups}
        self.assertTrue({f"Face{i}" for i in range(1, 7)} <= names)
