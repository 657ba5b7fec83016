"""How each program reads a mesh file: one function a program, path in, Seen out. Their versions beside them."""

import json
import pathlib
import re
import subprocess
from dataclasses import dataclass, field
from importlib import metadata
from typing import Dict, Optional

HERE = pathlib.Path(__file__).resolve().parent


@dataclass
class Seen:
    """What a program made of a file; None = it does not tell."""

    nodes: Optional[int] = None
    quads: Optional[int] = None
    nodes_of_quad: Optional[int] = None
    points: Optional[object] = None  #: (n, 3)
    corners: Optional[object] = None  #: (m, 4 or more), from 0
    groups: Dict[str, int] = field(default_factory=dict)  #: name -> elements (faces, edges) or nodes (vertices)
    group_count: Optional[int] = None


def run(*arguments, timeout=300, stdin=None, folder=None):
    """The output of a program that must succeed."""
    answer = subprocess.run([str(a) for a in arguments], input=stdin or "", capture_output=True, text=True,
                            errors="replace", timeout=timeout, cwd=folder, check=False)
    if answer.returncode != 0:
        raise AssertionError(f"{arguments[0]} ended with {answer.returncode}: {answer.stdout[-2000:]}{answer.stderr[-2000:]}")
    return answer.stdout + answer.stderr


def read_meshio(path):
    """By meshio; the groups as the format's reader there gives them."""
    import meshio
    import numpy

    mesh = meshio.read(path)
    quads = [block for block in mesh.cells if block.type.startswith("quad")]
    seen = Seen(nodes=len(mesh.points), quads=sum(len(block.data) for block in quads), points=mesh.points)
    seen.corners = numpy.concatenate([block.data for block in quads])
    seen.nodes_of_quad = seen.corners.shape[1]
    if path.suffix == ".msh":
        for name, (number, dimension) in mesh.field_data.items():
            tags = [tag for tag, block in zip(mesh.cell_data["gmsh:physical"], mesh.cells)
                    if block.dim == dimension]
            seen.groups[name] = sum(int((tag == number).sum()) for tag in tags)
    elif path.suffix == ".med":
        for block, tags in zip(mesh.cells, mesh.cell_data.get("cell_tags", [])):
            for number, names in mesh.cell_tags.items():
                for name in names:
                    count = int((tags == number).sum())
                    if count:
                        seen.groups[name] = seen.groups.get(name, 0) + count
        for number, names in getattr(mesh, "point_tags", {}).items():
            for name in names:
                seen.groups[name] = int((mesh.point_data["point_tags"] == number).sum())
    elif path.suffix == ".bdf":
        seen.group_count = len(set(numpy.concatenate(mesh.cell_data["nastran:ref"])))
    elif path.suffix == ".su2":  # markers, which meshio numbers
        seen.group_count = len({tag for tags in mesh.cell_data["su2:tag"] for tag in tags if tag > 0})
    elif path.suffix in (".vtu", ".xdmf"):
        for kind in ("face", "edge", "vertex") if path.suffix == ".vtu" else ("face",):
            numbers = numpy.concatenate(mesh.cell_data[kind])
            for number in set(numbers[numbers > 0]):
                seen.groups[f"{kind.title()}{number}"] = int((numbers == number).sum())
    return seen


def read_gmsh(path):
    """By Gmsh, which saves what it has read, for meshio to count."""
    copy = path.with_name(path.name + ".gmsh.msh")
    said = run("gmsh", "-save", "-format", "msh22", "-o", copy, path)
    if re.search("Warning|Error", said):
        raise AssertionError(said)
    seen = read_meshio(copy)
    if path.suffix != ".msh":
        seen.groups = {}
    return seen


def read_vtk(path):
    """By VTK itself."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    types = {"vtkQuad": 4, "vtkQuadraticQuad": 8, "vtkBiQuadraticQuad": 9}
    quads = []
    nodes_of_quad = 0
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        if cell.GetClassName() in types:
            nodes_of_quad = types[cell.GetClassName()]
            quads.append([cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
    seen = Seen(nodes=grid.GetNumberOfPoints(), quads=len(quads), nodes_of_quad=nodes_of_quad,
                points=vtk_to_numpy(grid.GetPoints().GetData()), corners=quads)
    for kind in ("face", "edge", "vertex"):
        array = grid.GetCellData().GetArray(kind)
        for number in vtk_to_numpy(array) if array else ():
            if number:
                name = f"{kind.title()}{number}"
                seen.groups[name] = seen.groups.get(name, 0) + 1
    return seen


FREECAD_SCRIPT = """
import Fem, json
mesh = Fem.read({path!r})
points = {{number: list(point) for number, point in mesh.Nodes.items()}}
quads = [list(mesh.getElementNodes(face)) for face in mesh.Faces]
groups = {{mesh.getGroupName(g): len(mesh.getGroupElements(g)) for g in mesh.Groups}}
json.dump([points, quads, groups], open({out!r}, "w"))
"""


def read_freecad(path):
    """By FreeCAD's FEM workbench."""
    script, out = path.with_name(path.stem + "_freecad.py"), path.with_name(path.stem + "_freecad.json")
    script.write_text(FREECAD_SCRIPT.format(path=str(path), out=str(out)), encoding="utf-8")
    run("freecadcmd", script)
    points, quads, groups = json.loads(out.read_text(encoding="utf-8"))
    place = {int(number): index for index, number in enumerate(points)}
    return Seen(nodes=len(points), quads=len(quads), nodes_of_quad=len(quads[0]), points=list(points.values()),
                corners=[[place[node] for node in quad] for quad in quads], groups=groups)


def read_cgx(path):
    """By CalculiX' preprocessor, which lists its sets."""
    script = path.with_name(path.stem + ".fbl")
    script.write_text(f"read {path.name} inp\nprnt se\nquit\n", encoding="utf-8")
    said = run("cgx", "-bg", script.name, folder=path.parent)
    counts = {name: (int(nodes), int(elements))
              for name, nodes, elements in re.findall(r"(\w+) +stat:\w+ n:(\d+) e:(\d+) ", said)}
    seen = Seen(nodes=counts["Nall"][0], quads=counts["Eall"][1])
    for name, (nodes, elements) in counts.items():
        if re.fullmatch(r"Face\d+", name):
            seen.groups[name] = elements
    return seen


def read_libmed(path):
    """By the tools of libmed: medconforme, mdump4."""
    run("medconforme", path)
    said = run("mdump4", path, stdin="1\n1\n")
    seen = Seen(nodes=int(re.search(r"Nombre de noeuds : (\d+)", said).group(1)),
                quads=int(re.search(r"Nombre de mailles de type MED_QUAD\d : (\d+)", said).group(1)))
    seen.nodes_of_quad = int(re.search(r"mailles de type MED_QUAD(\d) : [1-9]", said).group(1))
    names = re.findall(r"gro = ((?:Face|Edge|Vertex)\d+)", said)
    seen.group_count = len(set(names))
    return seen


def read_dolfinx(path):
    """By dolfinx, .msh over Gmsh's Python module."""
    from mpi4py import MPI

    if path.suffix == ".xdmf":
        from dolfinx.io import XDMFFile

        with XDMFFile(MPI.COMM_WORLD, str(path), "r", XDMFFile.Encoding.ASCII) as file:
            mesh = file.read_mesh(name="mesh")
            numbers = file.read_meshtags(mesh, name="mesh").values
        return Seen(nodes=len(mesh.geometry.x), quads=mesh.topology.index_map(2).size_global,
                    groups={f"Face{number}": int((numbers == number).sum()) for number in set(numbers)})
    import dolfinx.io.gmshio
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        gmsh.open(str(path))
        mesh, cells, lines = dolfinx.io.gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=3)
        names = {gmsh.model.getPhysicalName(*pair): pair for pair in gmsh.model.getPhysicalGroups()}
        seen = Seen(nodes=len(mesh.geometry.x), quads=mesh.topology.index_map(2).size_global)
        for name, (dimension, number) in names.items():
            if dimension > 0:
                tags = cells if dimension == 2 else lines
                seen.groups[name] = int((tags.values == number).sum())
        return seen
    finally:
        gmsh.finalize()


def read_sfepy(path):
    """By SfePy."""
    from sfepy.base.base import output
    from sfepy.discrete.fem import Mesh

    output.set_output(quiet=True)
    mesh = Mesh.from_file(str(path))
    return Seen(nodes=mesh.n_nod, quads=mesh.n_el, points=mesh.coors, corners=mesh.get_conn("2_4"), nodes_of_quad=4)


def read_getfem(path):
    """By GetFEM: groups are its regions, known by number alone."""
    import getfem

    mesh = getfem.Mesh("import", "gmsh", str(path))
    return Seen(nodes=mesh.nbpts(), quads=mesh.nbcvs(), group_count=len([r for r in mesh.regions() if len(mesh.region(r)[0])]))


def built_reader(name, path):
    """The program in the folder `name` beside this file, built once beside the meshes."""
    program = path.parent / name / f"{name}_reader"
    if not program.exists():
        run("cmake", "-S", HERE / name, "-B", program.parent, "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", program.parent, timeout=600)
    return program


def read_dealii(path):
    """By deal.II."""
    nodes, quads, materials = map(int, run(built_reader("dealii", path), path).split())
    return Seen(nodes=nodes, quads=quads, group_count=materials)


def read_mfem(path):
    """By MFEM, which takes faces from .msh alone."""
    nodes, quads, attributes = map(int, run(built_reader("mfem", path), path).splitlines()[-1].split())
    return Seen(nodes=nodes, quads=quads, group_count=attributes if path.suffix == ".msh" else None)


def package_version(package):
    """Of a Debian package; None = not installed."""
    answer = subprocess.run(["dpkg-query", "-W", "-f", "${db:Status-Status} ${Version}", package], capture_output=True,
                            text=True, check=False)
    status, _, version = answer.stdout.partition(" ")
    if status != "installed":
        return None
    if package == "python3-meshio":  # Debian's number is another
        return metadata.version("meshio")
    return re.sub(r"^\d+:|[+~-].*$", "", version)


#: name: (read, Debian package, comes with scripts/install_dependencies.sh)
READERS = {
    "Gmsh": (read_gmsh, "gmsh", True),
    "meshio": (read_meshio, "python3-meshio", True),
    "VTK": (read_vtk, "python3-vtk9", True),
    "FreeCAD": (read_freecad, "freecad", True),
    "cgx": (read_cgx, "calculix-cgx", True),
    "libmed's tools": (read_libmed, "libmed-tools", True),
    "dolfinx": (read_dolfinx, "python3-dolfinx", False),
    "deal.II": (read_dealii, "libdeal.ii-dev", False),
    "MFEM": (read_mfem, "libmfem-dev", False),
    "SfePy": (read_sfepy, "python3-sfepy", False),
    "GetFEM": (read_getfem, "python3-getfem++", False),
}
