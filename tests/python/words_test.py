"""What FreeCAD calls the settings that sentences of the library and of the command name."""

import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "workbench"))

from quadrille.core.setting_table import SETTINGS, in_words_of_panel, words_for

LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
#: A setting in a sentence of the library.
QUOTED = re.compile(r"`([a-z_]+)`")
#: What such a name becomes in the command, see option_of() in mesher/settings.cpp.
OPTIONS = {**{setting["name"]: setting["option"] for setting in SETTINGS}, "merge": "--merge", "feature_angle": "--feature-angle"}


def literals(*folders):
    """The texts in C++ sources, without comments: (file and line, text)."""
    for folder in folders:
        for path in sorted((SOURCE / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if line.lstrip().startswith("//"):
                    continue
                for text in LITERAL.findall(line):
                    yield f"{path.relative_to(SOURCE)}:{number}", text


class WordsTest(unittest.TestCase):
    def test_each_setting_that_a_sentence_names_has_a_word_in_freecad(self):
        found = set()
        for place, text in literals("geometry", "mesher"):
            for name in QUOTED.findall(text):
                found.add(name)
                with self.subTest(place, name=name):
                    self.assertIn(name, OPTIONS)
                    self.assertIsNotNone(words_for(OPTIONS[name]))
        self.assertGreater(len(found), 12)  # else the sentences are not found
        self.assertLessEqual({"sew", "force", "merge_tiny", "imprint", "partial", "read_time_limit"}, found)

    def test_the_library_names_no_options(self):
        """Settings are in backquotes there, and each front end has its own words for them."""
        for place, text in literals("geometry", "mesher"):
            if not place.startswith("mesher/command/") and " " in text:  # no bare option, as in option_of()
                with self.subTest(place):
                    self.assertNotRegex(text, r"(?<![\w-])--[a-z]")

    def test_notes_of_the_mesher_name_no_option_in_freecad(self):
        notes = [text for _, text in literals("mesher/command") if text.startswith(("note: ", "--")) and " " in text]
        self.assertGreater(sum("--report" in text for text in notes), 1)
        for text in notes:
            with self.subTest(text):
                self.assertNotRegex(in_words_of_panel(text), r"(?<![\w-])--[a-z]")

    def test_every_setting_has_a_word(self):
        for setting in SETTINGS:
            sentence = in_words_of_panel(f"{setting['option']} must be positive: {setting['option']}, or {setting['option']}.")
            self.assertNotIn("--", sentence)
            if setting["label"]:
                self.assertEqual(sentence.count(f'"{setting["label"]}"'), 3)

    def test_words(self):
        for told, ours in (
                ("--size-min must be at most the size", '"Minimum" must be at most the size'),
                ("--size-on names Face7", '"Refinements" names Face7'),
                ("too many: --force meshes anyway", "too many: the property Force meshes anyway"),
                ("/tmp/a--size.brep: is no --option", "/tmp/a--size.brep: is no --option")):
            self.assertEqual(in_words_of_panel(told), ours)
        self.assertEqual(in_words_of_panel("--sew 1", {"Sew": "Nähen"}.get), '"Nähen" 1')


if __name__ == "__main__":
    unittest.main()
