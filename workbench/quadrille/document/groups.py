# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups for FreeCAD's solvers: the nodes and elements of constraints, materials, thicknesses and FEM mesh groups.

A solver writer looks for a group of nodes or faces named `<ConstraintName>_...`. If there is none, it searches nodes by
geometry, which is slow. The mesh holds a group for each face, edge and vertex of the part. From these, the groups of
constraints can be made at any time without a search, even when a constraint is added or changed after meshing.
Runs inside FreeCAD."""

from typing import Any, Callable, Dict, Iterable, List, Set, Tuple

import FreeCAD

from ..core import observers
from ..core.errors import Error
from . import containers, links, shapes, undo

_KINDS = {"Face": "Face", "Edge": "Edge", "Vertex": "Node"}
#: {(group name, element type): ids}
Groups = Dict[Tuple[str, str], Tuple[int, ...]]
#: Called with a result and its analysis once, when the result comes into the analysis of one of our meshes.
Hint = Callable[[object, object], None]


def add_groups(mesh, fem_mesh) -> None:
    """Adds the groups that the mesh object's analysis and group list need, and those of the objects in a container, to a mesh that
    was just read."""
    for (name, kind), ids in _groups(fem_mesh, {**containers.faces_by_part(mesh.Shape), **_references(mesh)}).items():
        number = fem_mesh.addGroup(name, kind)
        fem_mesh.addGroupElements(number, list(ids))


def refresh(mesh) -> bool:
    """Updates the groups of a meshed object to its analysis. Returns True if they have changed."""
    fem_mesh = mesh.FemMesh
    references = _references(mesh)
    wanted = _groups(fem_mesh, references)
    parts = containers.faces_by_part(mesh.Shape).keys() - references.keys()  # theirs stay as they are
    present: Groups = {}
    numbers = {}
    for number in fem_mesh.Groups:
        name = fem_mesh.getGroupName(number)
        if _is_part_group(name) or name.rpartition("_")[0] in parts:
            continue
        key = (name, fem_mesh.getGroupElementType(number))
        present[key] = tuple(sorted(fem_mesh.getGroupElements(number)))
        numbers[key] = number
    if present == wanted:
        return False
    # In place: FreeCAD allows changes to the groups of a property's mesh, and does not draw groups.
    for key, number in numbers.items():
        if present[key] != wanted.get(key):
            fem_mesh.removeGroup(number)
    for key, ids in wanted.items():
        if present.get(key) != ids:
            fem_mesh.addGroupElements(fem_mesh.addGroup(*key), list(ids))
    return True


def _references(mesh) -> Dict[str, List[str]]:
    """What the constraints and mesh groups refer to, by their names; nothing if the part was deleted."""
    found: Dict[str, List[str]] = {}
    if mesh.Shape is None:
        return found
    for name, source in [(member.Name, member) for member in _members(mesh)] + [
            (group.Label if group.UseLabel else group.Name, group) for group in mesh.MeshGroupList]:
        try:
            found[name] = shapes.references_to_names(mesh.Shape.Shape, mesh.Shape, source.References)
        except Error as error:
            FreeCAD.Console.PrintWarning(f"{mesh.Label}: no group for {source.Label}: {error}\n")
    return found


def _groups(fem_mesh, sources: Dict[str, List[str]]) -> Groups:
    """The groups of elements of the part, by name: `<Name>_Nodes` of nodes, `<Name>_Faces` and `<Name>_Edges` of elements."""
    if not sources:
        return {}
    part_groups = PartGroups(fem_mesh)
    wanted: Groups = {}
    for name, elements in sources.items():
        nodes: Set[int] = set()
        members: Dict[str, Set[int]] = {}
        for element in elements:
            nodes |= part_groups.nodes(element)
            kind = element.rstrip("0123456789")
            if kind != "Vertex":
                members.setdefault(kind, set()).update(part_groups.elements(element))
        if nodes:
            wanted[(f"{name}_Nodes", "Node")] = tuple(sorted(nodes))
        for kind, ids in members.items():
            if ids:
                wanted[(f"{name}_{kind}s", kind)] = tuple(sorted(ids))
    return wanted


def referenced(mesh) -> List[str]:
    """The faces and edges of the part that the members of the analysis and the mesh groups refer to, by name."""
    names: Set[str] = set()
    for source in [*_members(mesh), *mesh.MeshGroupList]:
        try:
            names.update(shapes.references_to_names(mesh.Shape.Shape, mesh.Shape, source.References))
        except Error:
            continue  # left_out() reports it
    return sorted(name for name in names if name.startswith(("Face", "Edge")))


def left_out(mesh) -> List[str]:
    """One sentence for each member of the analysis that refers to something that is not in the mesh, since only some faces are
    meshed. FreeCAD's writers would silently omit such loads and supports."""
    part_groups = PartGroups(mesh.FemMesh)
    sentences = []
    for member in _members(mesh):
        try:
            elements = shapes.references_to_names(mesh.Shape.Shape, mesh.Shape, member.References)
        except Error as error:
            sentences.append(f"{member.Label}: {error}")
            continue
        missing = [name for name in elements if not part_groups.elements(name)]
        if missing:
            way = "mesh that face too" if links.names_in(mesh.Faces) else "mesh again, so that it gets nodes of its own"
            sentences.append(f"{member.Label} is on {missing[0]}, which is not in the mesh {mesh.Label}: {way}, or "
                             f"remove it from {member.Label}")
    return sentences


def elements_in(fem_mesh, name: str) -> Iterable[int]:
    """The element ids in a group of faces; empty if there is no such group."""
    for number in fem_mesh.Groups:
        if fem_mesh.getGroupName(number) == name and fem_mesh.getGroupElementType(number) == "Face":
            return fem_mesh.getGroupElements(number)
    return ()


class PartGroups:
    """The groups Face1..., Edge1..., Vertex1... of a mesh."""

    def __init__(self, fem_mesh) -> None:
        self._mesh = fem_mesh
        self._numbers = {(fem_mesh.getGroupName(i), fem_mesh.getGroupElementType(i)): i for i in fem_mesh.Groups}
        self._nodes: Dict[str, Set[int]] = {}
        self._names: Dict[str, Dict[Any, str]] = {}  # see _named()

    def elements(self, name: str) -> Iterable[int]:
        """The ids in the group of a face, edge or vertex; empty if there is no such group."""
        number = self._numbers.get((name, _KINDS[name.rstrip("0123456789")]))
        return () if number is None else self._mesh.getGroupElements(number)

    def nodes(self, name: str) -> Set[int]:
        """The nodes of a face, edge or vertex."""
        if name not in self._nodes:
            found: Set[int] = set()
            if name.startswith("Vertex"):
                found.update(self.elements(name))
            else:
                for element in self.elements(name):
                    found.update(self._mesh.getElementNodes(element))
            self._nodes[name] = found
        return self._nodes[name]

    def vertex_at(self, node: int) -> str:
        """The vertex that a node stands on; empty if there is none."""
        return self._named("Vertex").get(node, "")

    def edge_along(self, start: int, end: int) -> str:
        """The edge that runs from node to node along the side of an element; empty if there is none."""
        return self._named("Edge").get(frozenset((start, end)), "")

    def face_of(self, element: int) -> str:
        """The face that an element lies on; empty if there is none."""
        return self._named("Face").get(element, "")

    def _named(self, kind: str) -> Dict[Any, str]:
        """The first group of a kind that each of its members is in: nodes on vertices, the ends of elements on edges, elements on faces."""
        if kind not in self._names:
            names = self._names[kind] = {}
            for name in self._of(kind):
                for element in self.elements(name):
                    names.setdefault(frozenset(self._mesh.getElementNodes(element)[:2]) if kind == "Edge" else element, name)
        return self._names[kind]

    def _of(self, kind: str) -> List[str]:
        return [name for name, _ in self._numbers if name.startswith(kind) and _is_part_group(name)]


def _is_part_group(name: str) -> bool:
    kind = name.rstrip("0123456789")
    return kind in _KINDS and kind != name


def analysis_of(obj):
    """The analysis that an object is in, or None."""
    for parent in obj.InList:
        if parent.isDerivedFrom("Fem::FemAnalysis"):
            return parent
    return None


def _members(mesh) -> List:
    """The members of the mesh object's analysis that have references."""
    analysis = analysis_of(mesh)
    if analysis is None:
        return []
    return [member for member in analysis.Group
            if member != mesh and getattr(member, "References", None)]


class _Watcher:
    """A document observer. Constraints that are added or changed after meshing get their groups immediately."""

    def __init__(self, hint: Hint) -> None:
        self._hint_at = hint
        self._told: Set[Tuple[str, str]] = set()

    def slotChangedObject(self, obj, name: str) -> None:
        """FreeCAD calls this after a property has changed."""
        if name not in ("References", "Group", "MeshGroupList", "MeshRegionList", "UseLabel"):
            return
        document = obj.Document
        if document is None or getattr(document, "Restoring", False) or getattr(document, "Transacting", False):
            return
        if name == "Group" and obj.isDerivedFrom("Fem::FemAnalysis"):
            self._hint(obj)
        for mesh in self._meshes(obj, name):
            if obj in mesh.MeshRegionList or obj == mesh:
                links.note(mesh, {obj.Name} if name == "References" else ())
            if mesh.FemMesh.FaceCount and mesh.Shape is not None:
                refresh(mesh)

    def _hint(self, analysis) -> None:
        """Warns once for each result of our meshes that has stresses at the middle of the shell only."""
        if not any(_is_ours(member) for member in analysis.Group):
            return
        # CalculiX in FreeCAD 1.1 gives a pipeline instead of a result object.
        kinds = [[member for member in analysis.Group if member.isDerivedFrom(kind)]
                 for kind in ("Fem::FemResultObject", "Fem::FemPostPipeline")]
        for member in kinds[0] or kinds[1]:
            key = (analysis.Document.Uid, member.Name)
            if key not in self._told:
                self._told.add(key)
                self._hint_at(member, analysis)

    def slotUndoDocument(self, document) -> None:
        """FreeCAD calls this after an undo."""
        for mesh in document.Objects:
            if _is_ours(mesh):
                undo.bring_back(mesh)
                mesh.Proxy.execute(mesh)
                if mesh.FemMesh.FaceCount and mesh.Shape is not None:
                    refresh(mesh)

    slotRedoDocument = slotUndoDocument

    def slotDeletedDocument(self, document) -> None:
        """FreeCAD calls this before a document closes."""
        undo.forget(document)

    @staticmethod
    def _meshes(obj, name: str) -> List:
        if name in ("MeshGroupList", "MeshRegionList"):
            candidates = [obj]
        else:
            analysis = obj if obj.isDerivedFrom("Fem::FemAnalysis") else analysis_of(obj)
            candidates = [*(analysis.Group if analysis else ()), *obj.InList]
        return [mesh for mesh in candidates if _is_ours(mesh)]


def _is_ours(obj) -> bool:
    """True for a mesh object of this addon, made of a part, that has all its properties."""
    return (getattr(getattr(obj, "Proxy", None), "Type", "") == "Fem::FemMeshQuadrille"
            and "MeshToken" in obj.PropertiesList)


def watch(hint: Hint) -> None:
    """Starts to watch documents; further calls do nothing."""
    observers.watch(_Watcher, hint)
