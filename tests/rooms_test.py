"""Data flows one way: each room of geometry/ and mesher/ includes only itself and rooms that stand before it. What they ask of
the operating system lies in the files that docs/porting.md names."""

import pathlib
import re
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
    "mesher/boundary.hpp",
    "mesher/estimate.hpp",
    "mesher/estimate.cpp",
    "mesher/size_map.hpp",
    "mesher/size_map.cpp",
    "mesher/shell",
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
                    r"signal|csignal|termios|malloc|pwd|windows)(?:\.h)?)>", re.MULTILINE | re.IGNORECASE)
PLACE = re.compile(r"""["'(=](?:/proc/|/dev/|/etc/|/usr/|/sys/)""")


def room_of(path):
    for name in (path, "/".join(path.split("/")[:2])):
        if name in ROOMS:
            return ROOMS.index(name)
    raise AssertionError(f"{path} is in no room that tests/rooms_test.py knows")


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
        modules = {p.stem for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.?pp")}
        for test in sorted((ROOT / "tests").rglob("*/*_test.cpp")):
            room = test.parent.name
            self.assertIn(room, {name.split("/")[1] for name in ROOMS}, test)
            stem = test.stem.removesuffix("_test")
            self.assertTrue(stem in modules, f"{test} tests no module of that name")

    def test_the_system_is_asked_where_porting_says(self):
        files = {p.relative_to(ROOT).as_posix(): p.read_text() for top in ("geometry", "mesher") for p in (ROOT / top).rglob("*.?pp")}
        asking = {name for name, text in files.items() if SYSTEM.search(text) or PLACE.search(text)}
        told = set(re.findall(r"`((?:geometry|mesher)/[a-z_/]+\.[ch]pp)`", (ROOT / "docs" / "porting.md").read_text()))
        self.assertEqual(asking - told, set())
        self.assertEqual(told - set(files), set())
        self.assertGreater(len(asking), 5)
        builds = [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake"), *ROOT.glob("*/CMakeLists.txt"),
                  *ROOT.glob("tests/*/CMakeLists.txt")]
        wrong = [str(p.relative_to(ROOT)) for p in builds
                 if re.search(r"/usr/(?:lib|bin|include)|X11::|package\(X11|/etc/", p.read_text())
                 and p.name not in ("system.cmake", "packages.cmake")]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    unittest.main()
