# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs a mesher from a bundle (scripts/bundle.sh) where the addon uses it. Independent of FreeCAD; needs only the standard
library.

A downloaded bundle is not trusted blindly. Its checksum is shown before anything in it is run. Archives with members that
would lie outside their folder are refused. The mesher is tried before it replaces another one.
"""

import hashlib
import http.client
import lzma
import os
import shutil
import subprocess
import tarfile
import tempfile
import urllib.error
import urllib.request
import zlib
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Union
from urllib.parse import urlsplit

from .command import check_version
from .errors import Error, translate

#: Called with the fraction done, in [0, 1]; returning False cancels.
Progress = Callable[[float], Optional[bool]]

_FOLDER = "mesher"
_CHUNK = 1 << 18
_MOST_BYTES = 2 << 30  #: limit on the unpacked size; a bundle has a tenth of that


def checksum(path: Union[str, Path]) -> str:
    """The SHA-256 of a file, in hexadecimal digits."""
    digest = hashlib.sha256()
    try:
        with open(path, "rb") as file:
            for chunk in iter(lambda: file.read(_CHUNK), b""):
                digest.update(chunk)
    except OSError as error:
        raise Error(translate("Quadrille", "{}: cannot be read ({})").format(path, error.strerror), "failure", str(path)) from error
    return digest.hexdigest()


def download(address: str, folder: Union[str, Path], progress: Optional[Progress] = None) -> Path:
    """Downloads a file from an address (https, http, file) into a folder, completely or not at all. Returns its path."""
    parts = urlsplit(address.strip())
    name = os.path.basename(parts.path)
    if parts.scheme not in ("https", "http", "file") or not name:
        raise Error(translate("Quadrille", "{}: is not the address of a file (https://.../quadrille-...tar.xz)").format(address), "usage",
                    address)
    target = Path(folder) / name
    part = target.with_name(name + ".part")
    try:
        with urllib.request.urlopen(address.strip(), timeout=30) as answer, open(part, "wb") as file:
            whole, done = int(answer.headers.get("Content-Length") or 0), 0
            for chunk in iter(lambda: answer.read(_CHUNK), b""):
                file.write(chunk)
                done += len(chunk)
                if progress and progress(min(1.0, done / whole) if whole else 0.0) is False:
                    raise Error(translate("Quadrille", "{}: was cancelled").format(address), "cancelled", address)
            if whole and done != whole:
                raise Error(translate("Quadrille", "{}: ended after {} of {} bytes").format(address, done, whole), "failure", address)
        os.replace(part, target)
    except (OSError, ValueError, http.client.HTTPException) as error:  # URLError is an OSError
        reason = getattr(error, "reason", error)
        raise Error(translate("Quadrille", "{}: cannot be downloaded ({})").format(address, reason), "failure", address) from error
    finally:
        if part.exists():
            part.unlink()
    return target


def _members(archive: tarfile.TarFile, path: Path) -> list:
    """The archive's members, all below one folder. Raises Error if a member would lie, or a link would lead, outside it."""
    members, tops, size = archive.getmembers(), set(), 0
    links = {Path(member.name) for member in members if member.issym()}
    for member in members:
        parts = Path(member.name).parts
        inside = parts and not member.name.startswith("/") and ".." not in parts
        inside = inside and links.isdisjoint(Path(member.name).parents)  # a chain of links could lead anywhere
        if member.issym():
            inside = inside and not member.linkname.startswith("/") and \
                len(parts) - 1 > Path(member.linkname).parts.count("..")
        if not inside or not (member.isfile() or member.isdir() or member.issym()):
            raise Error(translate("Quadrille", "{}: is refused: {} would lie outside of its folder").format(path, repr(member.name)), "failure",
                        str(path))
        tops.add(parts[0])
        size += member.size
    if len(tops) != 1 or size > _MOST_BYTES:
        raise Error(translate("Quadrille", "{}: is not a bundle of Quadrille").format(path), "failure", str(path))
    return members


def install(archive: Union[str, Path], data_folder: Union[str, Path]) -> str:
    """Unpacks a bundle into `mesher` inside data_folder and replaces what is there. Returns the path of the command. The new
    mesher is tried first: if it does not run, nothing changes."""
    path, folder = Path(archive), Path(data_folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(prefix=f"{_FOLDER}-", dir=folder))
    except OSError as error:
        raise Error(translate("Quadrille", "{}: cannot be written ({})").format(folder, error.strerror), "failure", str(folder)) from error
    try:
        with tarfile.open(path) as bundle:
            members = _members(bundle, path)
            extra: Dict[str, Any] = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}
            bundle.extractall(fresh, members, **extra)
        root = fresh / Path(members[0].name).parts[0]
        if not (root / "bin" / "quadrille").is_file():
            raise Error(translate("Quadrille", "{}: is not a bundle of Quadrille: it has no bin/quadrille").format(path), "failure", str(path))
        check_version(str(root / "bin" / "quadrille"))
        target, old = folder / _FOLDER, fresh / "replaced"
        if target.exists():
            os.rename(target, old)
        try:
            os.rename(root, target)
        except OSError:
            if old.exists():
                os.rename(old, target)
            raise
    except (OSError, tarfile.TarError, lzma.LZMAError, zlib.error, EOFError, subprocess.SubprocessError) as error:
        raise Error(translate("Quadrille", "{}: cannot be unpacked ({})").format(path, error), "failure", str(path)) from error
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return str(folder / _FOLDER / "bin" / "quadrille")
