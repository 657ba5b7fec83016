"""Made version-0.1.0.FCStd, once, with the workbench of version 0.1.0 as of commit 4dd7e40: faces, sizes and flips kept as
texts. Run by a later version it gives another document, so it is kept to tell what is in the file.

    scripts/freecad_gui tests/freecad/data/make_old_document.py OUT.FCStd
"""

import sys

import FreeCAD
import ObjectsFem

import quadrille.freecad as core

document = FreeCAD.newDocument("Old")
box = document.addObject("Part::Box", "Box")
document.recompute()
analysis = ObjectsFem.makeAnalysis(document, "Analysis")
fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Fixed"))[0]
fixed.References = [(box, "Face1")]
mesh = core.make_mesh(box, size=2, name="Whole", analysis=analysis)
core.refine(mesh, [(box, ("Edge1",))], 1.0)
core.flip(mesh, [2])
part = core.mesh_object(box, size=2, order=1, faces=[1, 5], sizes={"Face5": 1.0, "Edge2": 0.5}, name="Part")
stale = core.mesh_object(box, size=2, name="Stale")
stale.Size = 3
document.recompute()
print(mesh.Status, "|", part.Status, "|", stale.Status, [m.QuadCount for m in (mesh, part, stale)])
document.saveAs(sys.argv[1])
