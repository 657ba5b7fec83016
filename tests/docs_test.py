"""The manual: links lead somewhere, README is short, every page is in the site."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def pages():
    return [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]


def anchors(page):
    """What the headings of a page are called in links, as GitHub and mkdocs make it."""
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", heading)).strip().lower().replace(" ", "-") for heading in headings}


class Docs(unittest.TestCase):
    def test_links_lead_somewhere(self):
        generated = {"command.md", "changelog.md"}  # by scripts/site.sh
        wrong, count = [], 0
        for page in pages():
            for link in LINK.findall(CODE.sub("", page.read_text(encoding="utf-8"))):
                if re.match(r"[a-z]+:", link):
                    continue
                count += 1
                path, _, anchor = link.partition("#")
                target = (page.parent / path).resolve() if path else page
                if page.parent == ROOT / "docs" and path in generated:
                    continue
                if not target.exists():
                    wrong.append(f"{page.relative_to(ROOT)}: {link}")
                elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                    wrong.append(f"{page.relative_to(ROOT)}: {link}: there is no such heading")
        self.assertEqual(wrong, [])
        self.assertGreater(count, 40)

    def test_formats_are_those_of_the_table(self):
        """docs/formats.md has a row for each format: first those that are written, then those that are read."""
        formats = json.loads((ROOT / "workbench" / "quadrille" / "tables.json").read_text(encoding="utf-8"))["formats"]
        page = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
        for way, header in (("written", "| extension | contents |"), ("read", "| extension | what is read |")):
            rows = page.split(header)[1].split("\n\n")[0].splitlines()[2:]
            told = [ending for row in rows for ending in re.findall(r"`(\.\w+)`", row.split("|")[1])]
            self.assertEqual(sorted(told), sorted(row["ending"] for row in formats if row[way]))

    def test_readme_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()), 120)

    def test_every_page_is_in_the_site(self):
        nav = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        for page in (ROOT / "docs").rglob("*.md"):
            self.assertIn(f": {page.relative_to(ROOT / 'docs')}\n", nav)

    def test_a_user_reads_eight_pages(self):
        nav = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        manual = nav.split("  - The manual:")[1].split("\n  - ")[0]
        self.assertLessEqual(manual.count(".md"), 8)

    def test_each_decision_has_a_status_and_is_in_the_index(self):
        folder = ROOT / "docs" / "decisions"
        index = (folder / "README.md").read_text(encoding="utf-8")
        found = sorted(folder.glob("[0-9]*.md"))
        gone = [int(number) for number in re.findall(r"^## (\d+)\. ", (folder / "history.md").read_text(encoding="utf-8"), re.MULTILINE)]
        numbers = sorted([int(page.name.split("-")[0]) for page in found] + gone)
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
        for page in found:
            text = page.read_text(encoding="utf-8")
            self.assertRegex(text, r"\n\*\*Status:\*\* stands", page.name)
            self.assertIn("\n**Decision.** ", text, page.name)
            self.assertIn(f"]({page.name})", index)

    def test_the_picture_of_the_rooms_shows_the_sources(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import rooms_picture
        drawn = rooms_picture.PLACE.read_text(encoding="utf-8")
        self.assertEqual(drawn, rooms_picture.picture(), "draw it again: scripts/rooms_picture.py")

    def test_what_run_sh_builds_can_be_installed(self):
        """README: after ./run.sh, `cmake --install build` installs. The modules come with the targets that open them."""
        run = (ROOT / "run.sh").read_text(encoding="utf-8")
        built = set(re.search(r"^scripts/build\.sh release (.*)$", run, re.MULTILINE).group(1).split())
        install = (ROOT / "cmake" / "install.cmake").read_text(encoding="utf-8")
        installed = set(re.findall(r"^\s*install\(TARGETS (\S+)", install, re.MULTILINE)) - {"${MODULES}"}
        self.assertGreaterEqual(len(installed), 3)
        self.assertLessEqual(installed, built)

    def test_the_manual_has_its_parts(self):
        nav = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        for part in ("tutorial", "install", "sizes", "command", "python", "api", "formats", "method", "verification", "quality",
                     "robustness", "troubleshooting", "glossary", "contributing", "changelog", "decisions/README"):
            self.assertIn(f": {part}.md\n", nav)
        self.assertGreater((ROOT / "docs" / "formats.md").read_text(encoding="utf-8").count("\n| Gmsh "), 4)  # the table that was run
        self.assertRegex((ROOT / "README.md").read_text(encoding="utf-8"), r"!\[[^]]*\]\([^)]*\.(png|svg)\)")

    @unittest.skipUnless(shutil.which("mkdocs"), "NOT TESTED: mkdocs is not installed")
    def test_site_is_made(self):
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run([ROOT / "scripts" / "site.sh", folder, COMMAND], capture_output=True, text=True, check=False)
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            text = (pathlib.Path(folder) / "command.html").read_text(encoding="utf-8")
            for part in ("quadrille recombine", "--feature-angle", "--size-on"):
                self.assertIn(part, text)
            self.assertTrue((pathlib.Path(folder) / "tutorial.html").is_file())


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main(verbosity=2)
