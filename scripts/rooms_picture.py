#!/usr/bin/env python3
"""Draws docs/pictures/rooms.svg: the rooms in the order of tests/rooms_test.py, what each hands on, and who includes whom. The arrows are
those of the sources; one that follows from two others is left out.

    scripts/rooms_picture.py
"""

import pathlib
import sys
from html import escape

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
sys.dont_write_bytecode = True
import rooms_test  # noqa: E402

PLACE = ROOT / "docs" / "pictures" / "rooms.svg"
SETTINGS, STAGES, RUN = "mesher/*.hpp", "mesher/stages", "mesher/mesh.cpp"
ABOUT = {
    "geometry/base": "errors, files, threads, child processes",
    "geometry/cad": "reads and repairs the model",
    "geometry/surfaces": "points on curves and surfaces",
    "geometry/midsurface": "middle surfaces of thin solids",
    "geometry/sizing": "the size at each place",
    "mesher/mesh": "mesh types, criteria, quality",
    "mesher/edges": "counts and nodes on edges",
    "mesher/faces": "grids, points, triangles",
    "mesher/pairing": "triangles to quads",
    "mesher/quads": "clean-up, smoothing, repair",
    SETTINGS: "options, settings",
    "mesher/shell": "one face; remedies; all faces together",
    STAGES: "the stages of a run; estimate, size map",
    "mesher/remesh": "remeshing triangulated surfaces",
    "mesher/io": "mesh files, reports, pictures",
    "mesher/adapt": "sizes from results",
    RUN: "the run, and quadrille.hpp",
    "mesher/command": "the command line",
}
FLOW = [  # from, to, what is handed on
    ("geometry/cad", "geometry/sizing", "CadModel"),
    ("geometry/sizing", "mesher/edges", "SizingField"),
    ("mesher/edges", "mesher/faces", "BoundaryNodes"),
    ("mesher/faces", "mesher/pairing", "FaceTriangulation"),
    ("mesher/pairing", "mesher/quads", "QuadMesh"),
    ("mesher/quads", "mesher/shell", "SurfaceMesh"),
    ("mesher/shell", STAGES, "FaceMesh"),
    (STAGES, "mesher/io", "ShellMesh"),
]
PACKAGES = {
    "core": "command, settings, errors",
    "document": "data of meshes in a document",
    "solvers": "FreeCAD's solvers",
    "features": "the document objects",
    "gui": "panel, commands, views",
    "freecad.py ...": "names for scripts",
}
PITCH, HEIGHT, TOP = 44, 34, 60


def group_of(name):
    room = rooms_test.ROOMS[rooms_test.room_of(name)]
    if room in ABOUT:
        return room
    if room in ("mesher/quadrille.hpp", "mesher/mesh.cpp"):
        return RUN
    return STAGES if room.startswith(("mesher/estimate", "mesher/size_map")) else SETTINGS


def included():
    """The rooms that the sources of each room include."""
    found: dict[str, set[str]] = {room: set() for room in ABOUT}
    for top in ("geometry", "mesher"):
        for path in (ROOT / top).rglob("*.?pp"):
            name = path.relative_to(ROOT).as_posix()
            found[group_of(name)] |= {group_of(other) for other in rooms_test.INCLUDE.findall(path.read_text())} - {group_of(name)}
    return found


def imported():
    """The packages that the modules of each Python package import."""
    modules = rooms_test.python_modules()
    names = list(PACKAGES)

    def package(module):
        top = module.split(".")[0]
        return top if top in names else names[-1]

    found: dict[str, set[str]] = {name: set() for name in names}
    for module, path in modules.items():
        if module:
            found[package(module)] |= {package(other) for other in rooms_test.imports_of(path, modules) if other} - {package(module)}
    return found


def reduced(arrows):
    """Without the arrows that follow from two others."""
    reach = {}
    for room in arrows:
        seen, left = set(), list(arrows[room])
        while left:
            other = left.pop()
            if other not in seen:
                seen.add(other)
                left += arrows[other]
        reach[room] = seen
    return {room: sorted(other for other in others if not any(other in reach[between] for between in others))
            for room, others in arrows.items()}


def column(names, about, x, width, arrows, out):
    """Boxes one below the other, and arrows at their right side from each to those that it uses."""
    rows = {name: TOP + i * PITCH for i, name in enumerate(names)}
    for name, y in rows.items():
        out.append(f'<rect x="{x}" y="{y}" width="{width}" height="{HEIGHT}" rx="5" fill="#eef3f8" stroke="#456"/>')
        out.append(f'<text x="{x + 8}" y="{y + 14}" font-weight="bold">{escape(name)}</text>')
        out.append(f'<text x="{x + 8}" y="{y + 28}" fill="#444">{escape(about[name])}</text>')
    for name, others in arrows.items():
        for other in others:
            a, b = rows[name] + 10, rows[other] + HEIGHT - 10
            reach = 14 + 0.28 * (a - b)
            out.append(f'<path d="M{x + width} {a} C{x + width + reach:.0f} {a} {x + width + reach:.0f} {b} {x + width + 7} {b}" '
                       'fill="none" stroke="#678"/>')
            out.append(f'<path d="M{x + width + 8} {b - 4}L{x + width} {b}L{x + width + 8} {b + 4}z" fill="#678"/>')
    return rows


def picture():
    out: list[str] = []
    rows = column(list(ABOUT), ABOUT, 210, 250, reduced(included()), out)
    packages = column(list(PACKAGES), PACKAGES, 690, 230, reduced(imported()), out)
    flow = [("CAD file", None, "geometry/cad"), *((label, start, end) for start, end, label in FLOW), ("mesh file", "mesher/io", None)]
    for label, start, end in flow:
        a = rows[start] + HEIGHT - 8 if start else rows[end] - 24
        b = rows[end] + 8 if end else rows[start] + HEIGHT + 24
        out.append(f'<path d="M{208 if start else 130} {a} C{150 if start else 130} {a} {150 if end else 130} {b} {202 if end else 130} {b}" '
                   'fill="none" stroke="#b50" stroke-width="2.5"/>')
        head = f"M200 {b - 5}L209 {b}L200 {b + 5}z" if end else f"M125 {b - 9}L130 {b}L135 {b - 9}z"
        out.append(f'<path d="{head}" fill="#b50"/>')
        x, y = (154, (a + b) / 2 + 4) if start and end else (122, a + 4 if end else b + 4)
        out.append(f'<text x="{x}" y="{y:.0f}" text-anchor="end" fill="#930">{label}</text>')
    child = packages["freecad.py ..."] + PITCH + 40
    for i, line in enumerate(("workbench/quadrille/ runs the command as a", "child process (core/jobs.py): BREP in, UNV out.",
                              "In Python outside FreeCAD, workbench/module.cpp", "offers quadrille.hpp.")):
        out.append(f'<text x="690" y="{child + 17 * i}" fill="#444">{line}</text>')
    for x, text in ((210, "C++ rooms"), (690, "Python packages")):
        out.append(f'<text x="{x}" y="28" font-size="15" font-weight="bold">{text}</text>')
    legend = TOP + len(ABOUT) * PITCH + 14
    out.append(f'<text x="20" y="{legend}" fill="#930">thick: how data flows</text>')
    out.append(f'<text x="210" y="{legend}" fill="#456">thin: includes or imports (arrows that follow from two others are left out)</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 {legend + 16}" font-family="sans-serif" font-size="12">\n'
            '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    PLACE.write_text(picture(), encoding="utf-8")
