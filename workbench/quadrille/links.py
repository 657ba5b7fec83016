# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces, edges and vertices that a mesh object names, kept as FreeCAD's links, and what became of them when the part
is edited.

FreeCAD numbers faces anew when an edit adds or takes some: Face6 may then be another face. FreeCAD 1.0 carries links over
for shapes that know where their elements come from (an element map). For others, and in 0.20, a record is kept of what each
named element was: its measures, and which faces, edges and vertices of the part belong together. After an edit an element
keeps its name where the part is put together as before; where it is not, the one element that lies where the named one lay
takes its place; otherwise nobody can tell, and the user is asked. Runs inside FreeCAD."""

import json
from typing import Any, Container, Dict, Iterable, List, NamedTuple, Sequence, Tuple

from . import shapes
from .errors import Error

#: FreeCAD's type of property for links to faces, edges and vertices, whatever container the part is in.
PROPERTY = "App::PropertyLinkSubListGlobal"
#: A list of links as FreeCAD has it: [(document object, ("Face3", "Edge4")), ...].
Links = Sequence[Tuple[Any, Sequence[str]]]
#: The mesh object's own properties of links.
OWN = ("Faces", "FlippedFaces")
#: What FreeCAD puts before the name of an element that it could not carry over.
_MISSING = "?"

#: A named element: what names it (a property, or the name of a mesh region), the name of its object, and its own.
Key = Tuple[str, str, str]


class Chosen(NamedTuple):
    """A named element."""

    source: str  #: the property, or the name of the mesh region, that names it
    label: str  #: the same for users
    target: Any  #: document object
    name: str  #: such as "Face3"

    @property
    def key(self) -> Key:
        """What changes of names are kept by."""
        return (self.source, self.target.Name, self.name)


def link(part, names: Iterable[str]) -> List[Tuple[Any, Tuple[str, ...]]]:
    """Names of elements of a part as links."""
    names = tuple(names)
    return [(part, names)] if names else []


def names_in(links: Links) -> List[str]:
    """The names in a list of links, in its order."""
    return [name for _, names in links for name in ([names] if isinstance(names, str) else names)]


def chosen(mesh) -> List[Chosen]:
    """All elements that a mesh object names: its own, and those of its mesh regions."""
    sources = [(prop, prop, getattr(mesh, prop)) for prop in OWN]
    sources += [(region.Name, region.Label, region.References) for region in mesh.MeshRegionList]
    return [Chosen(source, label, target, name) for source, label, links in sources for target, names in links
            for name in ([names] if isinstance(names, str) else names)]


def note(mesh, anew: Container[str] = ()) -> None:
    """Records what the named elements are in the present shapes: those that have no record yet, and those that the sources
    given name, since the user has just chosen them."""
    records = _read(mesh)
    present = [entry for entry in chosen(mesh) if _has_shape(entry.target)]
    topologies: Dict[str, str] = {}
    elements: Dict[str, shapes.Elements] = {}
    for entry in present:
        target, of_target = entry.target, records.setdefault(entry.target.Name, {})
        if entry.source in anew or entry.name not in of_target:
            if target.Name not in topologies:
                topologies[target.Name] = shapes.topology(target.Shape)
                elements[target.Name] = shapes.Elements(target.Shape)
            of_target[entry.name] = (topologies[target.Name], elements[target.Name].measures_of(entry.name))
    _write(mesh, records, present)


def follow(mesh, without: Container[str] = ()) -> Dict[Key, str]:
    """What the named elements are called in the present shapes, but those of the sources left out. Raises Error when that
    cannot be told of one."""
    found: Dict[Key, str] = {}
    records = _read(mesh)
    elements: Dict[str, shapes.Elements] = {}
    for entry in chosen(mesh):
        if entry.source in without or entry.key in found:
            continue
        if entry.name.startswith(_MISSING):
            raise _lost(mesh, entry)
        record = records.get(entry.target.Name, {}).get(entry.name)
        if record is None or not _has_shape(entry.target):
            found[entry.key] = entry.name
            continue
        if entry.target.Name not in elements:
            elements[entry.target.Name] = shapes.Elements(entry.target.Shape)
        of_target = elements[entry.target.Name]
        found[entry.key] = entry.name if of_target.is_as_measured(entry.name, record[1]) else _now(mesh, entry, of_target, record)
    return found


def rename(mesh, found: Dict[Key, str]) -> List[str]:
    """Gives the named elements their present names and records them; tells which have changed, a sentence each."""
    changed = {key: now for key, now in found.items() if now != key[2]}
    sources = {source for source, _, _ in changed}
    for prop in sources.intersection(OWN):
        setattr(mesh, prop, renamed(prop, getattr(mesh, prop), found))
    for region in mesh.MeshRegionList:
        if region.Name in sources:
            region.References = renamed(region.Name, region.References, found)
    note(mesh, {entry.source for entry in chosen(mesh)})
    return sorted({f"{mesh.Label}: {name} of {target} is {now} since the part was changed"
                   for (_, target, name), now in changed.items()})


def renamed(source: str, links: Links, found: Dict[Key, str]) -> List[Tuple[Any, Tuple[str, ...]]]:
    """The links of a source with present names."""
    return [(target, tuple(found.get((source, target.Name, name), name)
                           for name in ([names] if isinstance(names, str) else names))) for target, names in links]


def carried_by_freecad(shape) -> bool:
    """True where FreeCAD carries links over when it numbers anew."""
    return getattr(shape, "ElementMapSize", 0) > 0


def _now(mesh, entry: Chosen, elements: shapes.Elements, record: Tuple[str, List[float]]) -> str:
    """The present name of an element that is not what its record says."""
    together, measures = record
    shape = entry.target.Shape
    there = elements.find(entry.name.rstrip("0123456789"), measures)
    as_before = carried_by_freecad(shape) or shapes.topology(shape) == together
    # In its old place there is nothing, and the part is put together as before, or FreeCAD knows: it has moved or grown.
    if not there and as_before:
        return entry.name
    if len(there) == 1 and not as_before:
        return there[0]
    raise _lost(mesh, entry)


def _lost(mesh, entry: Chosen) -> Error:
    name = entry.name.lstrip(_MISSING)
    return Error(f"{mesh.Label}: which face, edge or vertex of {entry.target.Label} {name} was ({entry.label}) cannot be told "
                 "since the part was changed: choose it again", "usage", name)


def _has_shape(target) -> bool:
    shape = getattr(target, "Shape", None)
    return shape is not None and hasattr(shape, "Faces") and not shape.isNull()


#: For each object and element: how its shape was put together, and the element's measures.
Records = Dict[str, Dict[str, Tuple[str, List[float]]]]


def _read(mesh) -> Records:
    return json.loads(mesh.ChosenElements) if mesh.ChosenElements else {}


def _write(mesh, records: Records, present: Sequence[Chosen]) -> None:
    """Keeps the records of what is still named."""
    kept: Records = {}
    for entry in present:
        kept.setdefault(entry.target.Name, {})[entry.name] = records[entry.target.Name][entry.name]
    text = json.dumps(kept, sort_keys=True) if kept else ""
    if mesh.ChosenElements != text:
        mesh.ChosenElements = text
