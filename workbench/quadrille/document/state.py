# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a mesh object, and whether its mesh still matches them. Runs inside FreeCAD."""

import hashlib
import json
from pathlib import Path
from typing import Any, Dict, FrozenSet, List, NamedTuple, Optional, Tuple

import FreeCAD

from ..core.errors import Error
from ..core.setting_table import SETTINGS, MeshSettings, from_property
from . import groups, links, shapes, translate

#: The type of the Python side of our mesh objects.
TYPE = "Fem::FemMeshQuadrille"
#: The type of the Python side of meshes made of FreeCAD's mesh objects (triangles).
SURFACE_TYPE = "Fem::FemMeshQuadrilleSurface"

#: Two properties for sizes that follow results, see adaption.py: the file with the sizes, which the document stores, and
#: whether to use it. The second is needed since FreeCAD cannot empty the first.
ADAPTED, FOLLOWS = "AdaptedSizes", "FollowResults"
#: Property with the stress peaks on the mesh that was adapted last, as the command reports them.
PEAKS = "StressPeaks"

# The values of the property Status.
UP_TO_DATE = "up to date"
NOT_MESHED = "not meshed yet"
PART_CHANGED = "the part has changed: mesh again"
SETTINGS_CHANGED = "the settings have changed: mesh again"
PART_GONE = "the part is gone"
LOST = "the part has changed: choose faces, edges, vertices again"
SENSELESS = "the settings make no sense"
OTHER_MEANS = "made by other means: mesh again"
BOTH_CHANGED = "the part and the settings have changed: mesh again"
STATUSES = (NOT_MESHED, UP_TO_DATE, PART_CHANGED, SETTINGS_CHANGED, PART_GONE, LOST, SENSELESS, OTHER_MEANS, BOTH_CHANGED)
#: Settings that name faces, edges and vertices: in a changed part, other names may mean the same elements.
_NAMING = frozenset(("flipped", *(setting["name"] for setting in SETTINGS if setting["kind"] in ("names", "entries"))))


class Refinement(NamedTuple):
    """A separate size for some faces, edges or vertices."""

    region: str  #: name of FreeCAD's mesh region, which may be deleted while a panel shows it; empty if there is none yet
    references: links.Links
    size: float  #: mm


class Wanted(NamedTuple):
    """What to mesh, and how: as stored in a mesh object, or as its panel shows it."""

    values: Dict[str, Any]  #: values by property
    refinements: Tuple[Refinement, ...]
    anew: FrozenSet[str] = frozenset()  #: properties whose links the user has just chosen on the current part


def is_quad_mesh(obj) -> bool:
    """True for the mesh objects of this addon."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == TYPE


def is_surface_mesh(obj) -> bool:
    """True for meshes that surfaces.py made of FreeCAD's mesh objects."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == SURFACE_TYPE


def source_of(mesh):
    """The part or mesh object that a mesh of this addon is made of; None if it was deleted."""
    return mesh.Surface if is_surface_mesh(mesh) else mesh.Shape


def wanted_of(mesh) -> Wanted:
    """The settings of a mesh object."""
    values = {setting["property"]: getattr(mesh, setting["property"]) for setting in SETTINGS if setting["property"]}
    values.update((name, getattr(mesh, name, default)) for name, default in ((ADAPTED, ""), (FOLLOWS, False)))
    refinements = [Refinement(region.Name, region.References, _length(region)) for region in mesh.MeshRegionList]
    refinements += [Refinement("", links.link(mesh.Shape, names), size)
                    for size, names in sizes_of(mesh).items()]
    return Wanted(values, tuple(refinements))


def sizes_of(mesh) -> Dict[float, List[str]]:
    """The sizes that a mesh object of 0.1.0 holds itself: names of faces, edges and vertices by size. FreeCAD does not allow
    new objects while a document is read, so they stay until mesh_regions() converts them to mesh regions."""
    by_size: Dict[float, List[str]] = {}
    if "Sizes" in mesh.PropertiesList:
        for element, size in mesh.Sizes.items():
            by_size.setdefault(float(size), []).append(element)
    return by_size


def _length(region) -> float:
    length = region.CharacteristicLength
    return float(getattr(length, "Value", length))


def part_of(mesh):
    """The part of a mesh object. Raises Error if it was deleted."""
    if mesh.Shape is None:
        raise Error(translate(
            "Quadrille", "{}: the part that it meshes is gone").format(mesh.Label), "usage", mesh.Name)
    return mesh.Shape


def shape_of(doc_object):
    """The shape of a document object. Raises Error if there is none that can be meshed."""
    shape = getattr(doc_object, "Shape", None)
    if shape is None or not hasattr(shape, "countElement"):
        label = getattr(doc_object, "Label", doc_object)
        raise Error(translate("Quadrille", "{}: has no shape to mesh").format(label), "usage", getattr(doc_object, "Name", ""))
    if shape.isNull() or not shape.countElement("Face"):  # not len(shape.Faces): slow for many faces in 1.0
        raise Error(translate(
            "Quadrille", "{}: its shape has no faces to mesh").format(doc_object.Label), "usage", doc_object.Name)
    return shape


def settings_to_use(mesh, wanted: Wanted, found: Dict[links.Key, str]) -> MeshSettings:
    """The wanted settings for the command, with the current names of faces, edges and vertices."""
    values = dict(wanted.values, Faces=links.names_in(links.renamed("Faces", wanted.values["Faces"], found)))
    settings = MeshSettings(**{setting["name"]: from_property(setting, values[setting["property"]])
                               for setting in SETTINGS if setting["property"]})
    sizes = sizes_wanted(mesh, wanted, found)
    if sizes:
        settings["sizes"] = sizes
    if _follows(wanted):
        settings.update(size_field=wanted.values[ADAPTED], size_field_scale=1.0, size_field_unit=1.0)
    return settings


def sizes_wanted(mesh, wanted: Wanted, found: Dict[links.Key, str]) -> Dict[str, float]:
    """The wanted sizes on faces, edges and vertices of the part, by name. If several apply, the smallest holds."""
    sizes: Dict[str, float] = {}
    shape = shape_of(mesh.Shape)
    for region, references, size in wanted.refinements:
        if not size > 0:
            label = getattr(mesh.Document.getObject(region), "Label", "Refinement")
            raise Error(translate(
                "Quadrille", "{}: a mesh region needs a length larger than 0").format(label), "usage", region)
        for name in shapes.references_to_names(shape, mesh.Shape, links.renamed(region, references, found)):
            sizes[name] = min(size, sizes.get(name, size))
    return sizes


def flipped(mesh, found: Dict[links.Key, str]) -> List[str]:
    """The names of the faces whose normals are flipped."""
    return links.names_in(links.renamed("FlippedFaces", mesh.FlippedFaces, found))


def settings_key(mesh, wanted: Wanted, found: Dict[links.Key, str]) -> str:
    """Everything that a mesh depends on besides its part, as text for comparison."""
    settings = settings_to_use(mesh, wanted, found).of_the_mesh()
    settings["flipped"] = flipped(mesh, found)
    if _follows(wanted):  # a digest, since the path of the document's file changes each time
        settings["size_field"] = _digest(mesh, wanted.values[ADAPTED])
    return json.dumps(settings, sort_keys=True, default=list)


def _follows(wanted: Wanted) -> bool:
    return bool(wanted.values[FOLLOWS] and wanted.values[ADAPTED])


def _digest(mesh, path: str) -> str:
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise Error(translate(
            "Quadrille", "{}: its sizes from results cannot be read ({}): switch {} off").format(
                mesh.Label, error.strerror, FOLLOWS), "failure",
                    mesh.Name) from error


def same_settings(one: str, other: str, by_name: bool = True) -> bool:
    """Compares two keys of settings_key(). A setting that is missing in one of them counts as having its current default.

    Args:
        by_name: whether to compare settings that name faces, edges and vertices, too.
    """
    defaults = {setting["name"]: setting["default"] for setting in SETTINGS if setting["default"] is not None}
    both = [{**defaults, **json.loads(key or "{}")} for key in (one, other)]
    if not by_name:
        both = [{**{name: value for name, value in settings.items() if name not in _NAMING},
                 "sizes": sorted(set(settings.get("sizes", {}).values()))} for settings in both]
    return both[0] == both[1]


def changed(mesh, wanted: Wanted, found: Dict[links.Key, str], part_too: bool) -> str:
    """The status of a mesh whose part has changed, or not, with the wanted settings."""
    same = same_settings(settings_key(mesh, wanted, found), mesh.MeshedSettings, not part_too)
    if part_too:
        return PART_CHANGED if same else BOTH_CHANGED
    return UP_TO_DATE if same else SETTINGS_CHANGED


def name_statuses(mesh) -> None:
    """Gives the property Status of a mesh object, also one of an older version, all the values that it can have."""
    known = mesh.getEnumerationsOfProperty("Status")
    if known != list(STATUSES):
        value = mesh.Status if known else ""
        mesh.Status = list(STATUSES)
        if value in STATUSES:
            mesh.Status = value


def judge(mesh) -> Tuple[str, str]:
    """The status of a mesh object, and a sentence with the reason."""
    if mesh.Shape is None:
        return PART_GONE, PART_GONE
    if mesh.FemMesh.FaceCount == 0:
        return NOT_MESHED, NOT_MESHED
    if not mesh.MeshedShape:
        return OTHER_MEANS, OTHER_MEANS
    try:
        found = links.follow(mesh)
    except Error as error:
        return LOST, str(error)
    try:
        other_part = not shapes.same_fingerprint(list(mesh.MeshedShape), shapes.fingerprint(shape_of(mesh.Shape)))
    except Error as error:
        return SENSELESS, str(error)
    try:
        now = changed(mesh, wanted_of(mesh), found, other_part)
    except Error as error:
        return (PART_CHANGED, PART_CHANGED) if other_part else (SENSELESS, str(error))
    return now, now


def update(mesh) -> Optional[str]:
    """Updates the property Status. Returns a sentence with the reason if the mesh was up to date and no longer is, else None."""
    before = mesh.Status
    now, sentence = mesh.Proxy.judge(mesh)
    if before == now:
        return None
    mesh.Status = now
    return sentence if before == UP_TO_DATE else None


def tell_change(mesh) -> None:
    """Updates the property Status, and warns if the mesh was up to date and no longer is."""
    sentence = update(mesh)
    if sentence:
        label = f"{mesh.Label}: "  # some sentences begin with it already
        FreeCAD.Console.PrintWarning(f"{'' if sentence.startswith(label) else label}{sentence}\n")


def complaint(mesh) -> str:
    """Why the mesh of a mesh object should not be used by a solver, as a sentence. Empty if no problem is known, and for mesh
    objects that are not Quadrille's."""
    if not is_quad_mesh(mesh) and not is_surface_mesh(mesh):
        return ""
    now, sentence = mesh.Proxy.judge(mesh)
    if now == OTHER_MEANS:
        return ""
    if now == UP_TO_DATE:
        return "; ".join(groups.left_out(mesh)) if is_quad_mesh(mesh) else ""
    return f"{mesh.Label}: {sentence}; results with this mesh would be wrong"
