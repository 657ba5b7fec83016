"""A mesher from a bundle: checksum, download, unpacking; what is refused leaves nothing behind."""

import hashlib
import io
import os
import random
import tarfile
import tempfile
import unittest
from pathlib import Path

from quadrille.core import mesher_setup
from quadrille.core.command import VERSION
from quadrille.core.errors import Error


class Link(str):
    """What a member of an archive points to."""


def bundle(path, version=VERSION, name="bin/quadrille", extra=()):
    """An archive like that of scripts/bundle.sh, whose command is a script."""
    script = f"#!/bin/sh\necho quadrille {version}\n".encode()
    with tarfile.open(path, "w:xz") as archive:
        for member, data in [(f"quadrille-{version}/{name}", script), *extra]:
            entry = tarfile.TarInfo(member)
            if isinstance(data, Link):
                entry.type, entry.linkname = tarfile.SYMTYPE, data
                archive.addfile(entry)
                continue
            entry.size, entry.mode = len(data), 0o755
            archive.addfile(entry, io.BytesIO(data))
    return path


class MesherSetup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.data = self.folder / "data"

    def refused(self, archive, part):
        with self.assertRaises(Error) as raised:
            mesher_setup.install(archive, self.data)
        self.assertIn(part, str(raised.exception))

    def test_a_bundle_is_installed_and_replaced(self):
        archive = bundle(self.folder / "a.tar.xz")
        self.assertEqual(mesher_setup.checksum(archive), hashlib.sha256(archive.read_bytes()).hexdigest())
        command = mesher_setup.install(archive, self.data)
        self.assertEqual(command, str(self.data / "mesher" / "bin" / "quadrille"))
        self.assertTrue(os.access(command, os.X_OK))
        major, minor, _ = VERSION.split(".")
        later = f"{major}.{minor}.99"
        self.assertEqual(mesher_setup.install(bundle(self.folder / "b.tar.xz", later), self.data), command)
        self.assertIn(later, Path(command).read_text())
        self.assertEqual([entry.name for entry in self.data.iterdir()], ["mesher"])

    def test_what_is_refused_changes_nothing(self):
        command = mesher_setup.install(bundle(self.folder / "a.tar.xz"), self.data)
        self.refused(bundle(self.folder / "old.tar.xz", "9.0.0"), "is of version 9.0.0")
        self.refused(bundle(self.folder / "none.tar.xz", name="bin/other"), "has no bin/quadrille")
        top = f"quadrille-{VERSION}"
        for number, (member, data) in enumerate([("../evil", b"x"), ("/evil", b"x"), (f"{top}/../../evil", b"x"),
                                                 (f"{top}/link", Link("../../elsewhere"))]):
            self.refused(bundle(self.folder / f"evil{number}.tar.xz", extra=[(member, data)]), "would lie outside")
        # Each of the links leads one folder up and stays inside of what its name says; the chain of them does not.
        chain = [(f"{top}/a/up", Link("..")), (f"{top}/a/up/up", Link("..")), (f"{top}/a/up/up/evil", b"x")]
        self.refused(bundle(self.folder / "chain.tar.xz", extra=chain), "would lie outside")
        self.refused(bundle(self.folder / "two.tar.xz", extra=[("other/file", b"x")]), "is not a bundle")
        (self.folder / "rubbish.tar.xz").write_bytes(b"rubbish")
        self.refused(self.folder / "rubbish.tar.xz", "cannot be unpacked")
        self.refused(self.folder / "missing.tar.xz", "cannot be unpacked")
        whole = bundle(self.folder / "large.tar.xz", extra=[(f"{top}/large", random.Random(1).randbytes(1 << 20))]).read_bytes()
        (self.folder / "short.tar.xz").write_bytes(whole[:len(whole) // 2])
        self.refused(self.folder / "short.tar.xz", "cannot be unpacked")
        (self.folder / "damaged.tar.xz").write_bytes(whole[:-40] + b"x" + whole[-39:])
        self.refused(self.folder / "damaged.tar.xz", "cannot be unpacked")
        self.assertIn(VERSION, Path(command).read_text())
        self.assertEqual([entry.name for entry in self.data.iterdir()], ["mesher"])

    def test_download(self):
        archive, there = bundle(self.folder / "a.tar.xz"), self.folder / "there"
        there.mkdir()
        shares = []
        got = mesher_setup.download(archive.as_uri(), there, shares.append)
        self.assertEqual(got.read_bytes(), archive.read_bytes())
        self.assertEqual(shares[-1], 1.0)
        got.unlink()
        for address, part in [("file:///nowhere/a.tar.xz", "cannot be downloaded"), ("ftp://a/b", "is not the address"),
                              ("https://host/", "is not the address"), ("", "is not the address"),
                              ("https://local host/a.tar.xz", "cannot be downloaded"),
                              ("http://127.0.0.1:1/a.tar.xz", "cannot be downloaded")]:
            with self.assertRaises(Error) as raised:
                mesher_setup.download(address, there)
            self.assertIn(part, str(raised.exception))
        with self.assertRaises(Error) as raised:
            mesher_setup.download(archive.as_uri(), there, lambda share: False)
        self.assertEqual(raised.exception.kind, "cancelled")
        self.assertEqual(list(there.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
