# SPDX-License-Identifier: GPL-3.0-or-later
"""The one exception type, and text that is safe to print."""


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


def printable(text: str) -> str:
    """The text as one line that any terminal or file can take. Control characters, and bytes of a file name that are not text,
    become escapes such as \\n."""
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)
