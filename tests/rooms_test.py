"""Data flows one way: each room of geometry/ and mesher/ includes only itself and rooms that stand before it, and each package of
workbench/quadrille/ imports only itself and packages that stand before it. What they ask of the operating system lies in the files
that docs/porting.md names."""

import ast
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
# In the order of the pipeline. A file in mesher/ itself stands where its name says.
ROOMS = [
    "geometry/base",
    "geometry/cad",
    "geometry/surfaces",
    "geometry/midsurface",
    "geometry/sizing",
    "mesher/mesh",
    "mesher/edges",
    "mesher/faces",
    "mesher/pairing",
    "mesher/quads",
    "mesher/options.hpp",
    "mesher/size_entries.hpp",
    "mesher/size_entries.cpp",
    "mesher/settings.hpp",
    "mesher/settings.cpp",
    "mesher/shell",
    "mesher/stages",
    "mesher/estimate.hpp",
    "mesher/estimate.cpp",
    "mesher/size_map.hpp",
    "mesher/size_map.cpp",
    "mesher/remesh",
    "mesher/io",
    "mesher/adapt",
    "mesher/quadrille.hpp",
    "mesher/mesh.cpp",
    "mesher/command",
]
# What lies in folders of a room belongs to the room.
INCLUDE = re.compile(r'^#include "((?:geometry|mesher)/[^"]+)"', re.MULTILINE)

# Headers that C++ and the libraries do not bring.
SYSTEM = re.compile(r"^#include <(?:(?:sys|linux|X11|arpa|netinet|mach)/[^>]+|(?:unistd|fcntl|dlfcn|link|elf|poll|spawn|pthread|sched|"
                    r"signal|csignal|termios|malloc|pwd)(?:\.h)?)>", re.MULTILINE)
PLACE = re.compile(r"""["'(=](?:/proc/|/dev/|/etc/|/usr/|/sys/)""")


def room_of(path):
    for name in (path, "/".join(path.split("/")[:2])):
        if name in ROOMS:
            return ROOMS.index(name)
    raise AssertionError(f"{path} is in no room that tests/rooms_test.py knows")


def reached(text):
    """The files of geometry/ and mesher/ that a source includes, and those that their sources include."""
    found, left = set(), INCLUDE.findall(text)
    while left:
        name = left.pop()
        if name in found or not (ROOT / name).exists():
            continue
        found.add(name)
        left += INCLUDE.findall((ROOT / name).read_text()) + [name.replace(".hpp", ".cpp")]
    return found


class Rooms(unittest.TestCase):
    def test_flow_is_one_way(self):
        files = sorted(p for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.?pp"))
        self.assertGreater(len(files), 100)
        wrong = []
        for file in files:
            name = str(file.relative_to(ROOT))
            for included in INCLUDE.findall(file.read_text()):
                if room_of(included) > room_of(name):
                    wrong.append(f"{name} includes {included}")
        self.assertEqual(wrong, [])

    def test_tests_mirror_modules(self):
        modules = {p.stem for top in ("geometry", "mesher", "bench") for p in (ROOT / top).rglob("*.?pp")}
        for test in sorted((ROOT / "tests").rglob("*/*_test.cpp")):
            room = test.parent.name
            self.assertIn(room, {name.split("/")[1] for name in ROOMS} | {"bench"}, test)
            stem = test.stem.removesuffix("_test")
            self.assertTrue(stem in modules, f"{test} tests no module of that name")

    def test_modules_have_tests_or_a_reason(self):
        """Each module has a test of its name or stands in untested_modules.txt with the test that covers it, and no other does."""
        modules = {p.relative_to(ROOT).with_suffix("").as_posix()
                   for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.cpp")}
        named = {p.stem.removesuffix("_test") for p in (ROOT / "tests").rglob("*_test.cpp")}
        lines = [line.split(" | ") for line in (ROOT / "tests/untested_modules.txt").read_text().splitlines()
                 if line and not line.startswith("#")]
        listed = [line[0] for line in lines]
        self.assertEqual(listed, sorted(set(listed)))
        untested = {module for module in modules if module.split("/")[-1] not in named}
        self.assertGreater(len(modules - untested), 90)
        self.assertEqual(untested - set(listed), set(), "write a test, or list the one that covers it")
        self.assertEqual(set(listed) - untested, set(), "has a test now, or is gone")
        for module, test, reason in lines:
            name, case = test.split(" ")
            self.assertGreater(len(reason), 5, module)
            text = (ROOT / name).read_text()
            self.assertTrue(re.search(rf", {case}\)" if name.endswith(".cpp") else rf"\b{case}\b", text), f"{name} has no {case}")
            if name.endswith(".cpp") and not name.startswith("tests/command/"):
                self.assertIn(module.rpartition("/")[0], {file.rpartition("/")[0] for file in reached(text)}, f"{test}, {module}")

    def test_a_face_is_sorted_once(self):
        """Its kind is decided in face_sides and known to the maker of grids; the counting of segments asks what follows from it, and
        all that comes after reads FacePlan."""
        files = {p.relative_to(ROOT).as_posix(): p.read_text() for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.?pp")}
        knowing = {name for name, text in files.items() if re.search(r"\bGridKind\b", text)}
        self.assertEqual(knowing, {"mesher/edges/face_sides.hpp", "mesher/edges/face_sides.cpp", "mesher/faces/face_grid.cpp"})
        questions = re.findall(r"  bool (\w+)\(\) const", files["mesher/edges/face_sides.hpp"])
        self.assertGreater(len(questions), 2)
        asking = re.compile(rf"[sS]ides_?(?:\[\w+\])?\.(?:{'|'.join(questions)})\(\)")
        self.assertTrue(asking.search(files["mesher/edges/face_plan.cpp"]))
        self.assertEqual([name for name, text in files.items() if not name.startswith("mesher/edges/") and asking.search(text)], [])

    def test_the_system_is_asked_where_porting_says(self):
        files = {p.relative_to(ROOT).as_posix(): p.read_text() for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.?pp")}
        asking = {name for name, text in files.items() if SYSTEM.search(text) or PLACE.search(text)}
        told = set(re.findall(r"`((?:geometry|mesher)/[a-z_/]+\.[ch]pp)`", (ROOT / "docs" / "porting.md").read_text()))
        self.assertEqual(asking - told, set())
        self.assertEqual(told - set(files), set())
        self.assertGreater(len(asking), 5)
        # No file asks which system it is built for.
        asks = re.compile(r"^ *#.*(_WIN32|__MINGW|__linux__|__APPLE__)", re.MULTILINE)
        self.assertEqual([name for name, text in files.items() if asks.search(text)], [])
        builds = [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake"), *ROOT.glob("*/CMakeLists.txt"),
                  *ROOT.glob("tests/*/CMakeLists.txt")]
        wrong = [str(p.relative_to(ROOT)) for p in builds
                 if re.search(r"/usr/(?:lib|bin|include)|/etc/", p.read_text())
                 and p.name not in ("system.cmake", "packages.cmake")]
        self.assertEqual(wrong, [])


# What a file in C++ begins with: its comment, in headers after the guard.
PURPOSE = re.compile(r"(?:#pragma once\n)?/// ?\S.{10}")


def sources(*patterns):
    """The files in the repository of such names; in a tree without .git, all files of such names outside the builds."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", *patterns], capture_output=True, text=True)
    if listed.returncode == 0:
        return [ROOT / name for name in listed.stdout.splitlines() if (ROOT / name).exists()]
    found = [p for pattern in patterns for p in sorted(ROOT.rglob(pattern))]
    return [p for p in found if not p.relative_to(ROOT).parts[0].startswith("build")]


class Purposes(unittest.TestCase):
    """Each source begins with a comment on what it is for."""

    def test_sources_begin_with_a_comment(self):
        files = sources("*.cpp", "*.hpp")
        self.assertGreater(len(files), 400)
        self.assertEqual([str(p.relative_to(ROOT)) for p in files if not PURPOSE.match(p.read_text())], [])

    def test_python_files_have_docstrings(self):
        files = sources("*.py")
        self.assertGreater(len(files), 100)
        self.assertEqual([str(p.relative_to(ROOT)) for p in files if not ast.get_docstring(ast.parse(p.read_text()))], [])


PACKAGE = ROOT / "workbench" / "quadrille"
# In the order of imports. A file in quadrille/ itself stands after all of them: scripts and FreeCAD begin there.
PACKAGES = ["core", "document", "solvers", "features", "gui"]


def python_modules():
    """The modules of the Python package, by their names within it ("core.errors"; a package's own name for its __init__.py)."""
    modules = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        modules[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return modules


def imports_of(path, modules):
    """The modules of the package that a file imports, at its top or in a function."""
    here = path.relative_to(PACKAGE).parent.parts
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names = [alias.name.partition(".")[2] for alias in node.names if alias.name.split(".")[0] == "quadrille"]
        elif isinstance(node, ast.ImportFrom) and (node.level or (node.module or "").split(".")[0] == "quadrille"):
            base = here[:len(here) - node.level + 1] if node.level else ()
            inner = tuple((node.module or "").split("."))[0 if node.level else 1:]
            above = ".".join((*base, *filter(None, inner)))
            names = [f"{above}.{alias.name}".strip(".") for alias in node.names]
            names = [name if name in modules else above for name in names]
        else:
            continue
        found.update(name for name in names if name in modules)
    return found


def circles(imports):
    """The groups of modules that import each other, directly or through others."""
    reached = {}
    for start in imports:
        seen, left = set(), [start]
        while left:
            new = imports[left.pop()] - seen
            seen |= new
            left += new
        reached[start] = seen
    return sorted({tuple(sorted(other for other in reached[name] if name in reached[other]))
                   for name in imports if name in reached[name]})


class PythonPackage(unittest.TestCase):
    def setUp(self):
        modules = python_modules()
        # The module itself is no import of interest: batch.py imports itself, so that Dask's workers find its functions.
        self.imports = {name: imports_of(path, modules) - {name} for name, path in modules.items()}

    def test_no_circle_of_imports(self):
        self.assertGreater(len(self.imports), 50)
        self.assertIn("core.command", self.imports[""])  # imported in a function
        self.assertEqual(circles(self.imports), [])

    def test_imports_go_one_way(self):
        def place(name):
            top = name.split(".")[0]
            return PACKAGES.index(top) if top in PACKAGES else len(PACKAGES)

        wrong = [f"{name} imports {other}" for name, others in self.imports.items() for other in sorted(others)
                 if place(other) > place(name)]
        self.assertEqual(wrong, [])

    def test_circles_are_found(self):
        self.assertEqual(circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}), [("b", "c")])


if __name__ == "__main__":
    unittest.main()
