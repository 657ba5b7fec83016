"""A project of somebody else's is built against the installed library, which is then moved, and against the source."""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def run(*arguments):
    answer = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=600, check=False)
    if answer.returncode != 0:
        raise AssertionError(f"{arguments}: {answer.returncode}\n{answer.stdout[-3000:]}\n{answer.stderr[-3000:]}")
    return answer.stdout


class Consumer(unittest.TestCase):
    build = None

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="quadrille-consumer-")
        self.folder = pathlib.Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def check(self, program):
        outputs = [self.folder / f"out.{ending}" for ending in ("msh", "vtu", "med")]
        said = run(program, ROOT / "examples/models/bracket.step", *outputs)
        self.assertIn("0 inverted", said)
        self.assertIn(" 0 problems", said)
        self.assertIn("refused: `size`", said)
        for output in outputs:
            self.assertGreater(output.stat().st_size, 1000)

    def test_installed(self):
        first, moved = self.folder / "first", self.folder / "moved"
        run("cmake", "--install", self.build, "--prefix", first)
        # Nothing of the place where it was built or installed may matter.
        shutil.move(first, moved)
        self.assertEqual([p.name for p in (moved / "include").iterdir()], ["quadrille"])
        for header in (moved / "include").rglob("*.hpp"):
            for included in re.findall(r'#include "([^"]+)"', header.read_text()):
                self.assertTrue((moved / "include" / included).exists() and included.startswith("quadrille/"), f"{header}: {included}")
        run("cmake", "-S", HERE, "-B", self.folder / "build", f"-DCMAKE_PREFIX_PATH={moved}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", self.folder / "build")
        self.check(self.folder / "build/consumer")
        self.assertIn("mesh a CAD model", run(moved / "bin/quadrille", "--help"))
        run(moved / "bin/quadrille", "mesh", ROOT / "examples/models/bracket.step", "-o", self.folder / "b.med", "--quiet")

    def test_public_headers_are_what_the_two_include(self):
        listed = re.search(r"set\(PUBLIC_HEADERS([^)]*)\)", (ROOT / "cmake/public_headers.cmake").read_text())[1].split()
        found, left = set(), ["mesher/quadrille.hpp", "mesher/settings.hpp"]
        while left:
            header = left.pop()
            if header not in found:
                found.add(header)
                left += re.findall(r'#include "([^"]+)"', (ROOT / header).read_text())
        self.assertEqual(sorted(listed), sorted(found))

    def test_as_a_part_of_the_build(self):
        """Configured only: to build all of it again takes minutes."""
        run("cmake", "-S", HERE, "-B", self.folder / "build", f"-DQUADRILLE_SOURCE={ROOT}", "-DCMAKE_BUILD_TYPE=Release",
            "-G", "Ninja")
        commands = run("ninja", "-C", self.folder / "build", "-t", "commands", "consumer")
        self.assertIn(str(ROOT / "mesher/faces/loop_filling.cpp"), commands)
        compiled = next(line for line in commands.splitlines() if "-c " in line and line.rstrip().endswith("consumer/main.cpp"))
        self.assertNotIn(f"-I{ROOT} ", compiled, "geometry/ and mesher/ are not visible")
        self.assertIn("libquadrille_step.so", commands, "the modules are built with it")
        for other in ("_test.cpp", "bench", "module.cpp.o -c"):
            self.assertNotIn(f"{ROOT}/tests/{other}", commands)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    options, rest = parser.parse_known_args()
    Consumer.build = options.build
    unittest.main(argv=[sys.argv[0], *rest])
