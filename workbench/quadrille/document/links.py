# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces, edges and vertices that a mesh object names, stored as FreeCAD's links and identified again after the part was
edited.

FreeCAD renumbers faces when an edit adds or removes some: Face6 may then be another face. FreeCAD 1.0 updates links to
shapes that know where their elements come from (an element map). For other shapes, and in 0.20, a record is kept of each
named element: its measures, and a digest of the part's topology. After an edit, an element keeps its name if its measures
are unchanged, or if nothing lies in its old place and the topology is unchanged (or FreeCAD updates links). If the topology
has changed, the one element that now lies in the old place is taken. Otherwise the user is asked. Runs inside FreeCAD."""

import json
from typing import Any, Container, Dict, Iterable, List, NamedTuple, Sequence, Tuple

from ..core.errors import Error
from . import shapes, translate

#: FreeCAD's type of property for links to faces, edges and vertices, whatever container the part is in.
PROPERTY = "App::PropertyLinkSubListGlobal"
#: A list of links in FreeCAD's form: [(document object, ("Face3", "Edge4")), ...].
Links = Sequence[Tuple[Any, Sequence[str]]]
#: The mesh object's own properties that hold links.
OWN = ("Faces", "FlippedFaces")
#: The prefix that FreeCAD puts before the name of an element that it could not find again.
_MISSING = "?"

#: A named element: its source (a property, or the name of a mesh region), the name of its document object, and its own name.
Key = Tuple[str, str, str]


class Chosen(NamedTuple):
    """A named element."""

    source: str  #: the property, or the name of the mesh region, that names it
    label: str  #: the source as users know it
    target: Any  #: the document object
    name: str  #: such as "Face3"

    @property
    def key(self) -> Key:
        """The key under which follow() returns the element's current name."""
        return (self.source, self.target.Name, self.name)


def link(part, names: Iterable[str]) -> List[Tuple[Any, Tuple[str, ...]]]:
    """Links to elements of a part, by name."""
    names = tuple(names)
    return [(part, names)] if names else []


def names_in(links: Links) -> List[str]:
    """The names in a list of links, in its order."""
    return [name for _, name in shapes.pairs(links)]


def chosen(mesh) -> List[Chosen]:
    """All elements that a mesh object names, in its own properties and in its mesh regions."""
    sources = [(prop, prop, getattr(mesh, prop)) for prop in OWN]
    sources += [(region.Name, region.Label, region.References) for region in mesh.MeshRegionList]
    return [Chosen(source, label, target, name) for source, label, links in sources for target, name in shapes.pairs(links)]


def note(mesh, anew: Container[str] = ()) -> None:
    """Records what the named elements are in the current shapes.

    Records the elements that have no record yet, and all elements of the sources in `anew`, which the user has just chosen."""
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
    """The names of the named elements in the current shapes, except those of the sources in `without`. Raises Error if one of
    them cannot be identified."""
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
    """Gives the named elements their current names and records them. Returns a sentence for each name that has changed."""
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
    """The links of a source, with current names."""
    return [(entry[0], tuple(found.get((source, target.Name, name), name) for target, name in shapes.pairs([entry])))
            for entry in links]


def carried_by_freecad(shape) -> bool:
    """True if FreeCAD updates links to the shape when it renumbers elements."""
    return getattr(shape, "ElementMapSize", 0) > 0


def _now(mesh, entry: Chosen, elements: shapes.Elements, record: Tuple[str, List[float]]) -> str:
    """The current name of an element whose measures no longer match its record."""
    together, measures = record
    shape = entry.target.Shape
    there = elements.find(entry.name.rstrip("0123456789"), measures)
    as_before = carried_by_freecad(shape) or shapes.topology(shape) == together
    # Nothing is in the old place, and the topology is unchanged or FreeCAD updates links: the element has moved or grown.
    if not there and as_before:
        return entry.name
    if len(there) == 1 and not as_before:
        return there[0]
    raise _lost(mesh, entry)


def _lost(mesh, entry: Chosen) -> Error:
    name = entry.name.lstrip(_MISSING)
    return Error(translate(
        "Quadrille", "{}: which face, edge or vertex of {} {} was ({}) cannot be identified since the part was "
        "changed: choose it again").format(mesh.Label, entry.target.Label, name, entry.label), "usage", name)


def _has_shape(target) -> bool:
    shape = getattr(target, "Shape", None)
    return shape is not None and hasattr(shape, "Faces") and not shape.isNull()


#: For each object and element: the topology digest of the object's shape, and the element's measures.
Records = Dict[str, Dict[str, Tuple[str, List[float]]]]


def _read(mesh) -> Records:
    return json.loads(mesh.ChosenElements) if mesh.ChosenElements else {}


def _write(mesh, records: Records, present: Sequence[Chosen]) -> None:
    """Stores the records of the elements that are still named, and drops all others."""
    kept: Records = {}
    for entry in present:
        kept.setdefault(entry.target.Name, {})[entry.name] = records[entry.target.Name][entry.name]
    text = json.dumps(kept, sort_keys=True) if kept else ""
    if mesh.ChosenElements != text:
        mesh.ChosenElements = text
