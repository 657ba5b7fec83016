# SPDX-License-Identifier: GPL-3.0-or-later
"""The one exception type, the translation of sentences, and text that is safe to print."""

import sys


class Error(RuntimeError):
    """What went wrong, as one sentence for the user.

    Attributes:
        kind: "usage" (the request is invalid), "failure" (the input or the machine made it impossible) or
            "cancelled".
        subject: the file, face ("Face3"), object or option concerned; may be empty.
    """

    def __init__(self, sentence: str, kind: str = "failure", subject: str = "") -> None:
        super().__init__(sentence)
        self.kind = kind
        self.subject = subject


def QT_TRANSLATE_NOOP(_context: str, text: str) -> str:  # Qt's tools look for this name
    """Marks a text for translation and returns it unchanged."""
    return text


def translate(context: str, text: str) -> str:
    """The text in FreeCAD's language; unchanged where no FreeCAD runs."""
    qt = getattr(sys.modules.get("FreeCAD"), "Qt", None)
    return text if qt is None else str(qt.translate(context, text))


def printable(text: str) -> str:
    """The text as one line that any terminal or file can take. Control characters, and bytes of a file name that are not text,
    become escapes such as \\n."""
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)
