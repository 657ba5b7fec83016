#!/usr/bin/env python3
"""Packs a bundle into a wheel: the Python package, with the command, its modules and its libraries inside.

    make_wheel.py BUNDLE VERSION FOLDER      BUNDLE: the folder that scripts/bundle.sh makes
"""

import base64
import hashlib
import platform
import subprocess
import sys
import zipfile
from pathlib import Path

EPOCH = (1980, 1, 1, 0, 0, 0)  # a fixed date, so that the same contents give the same bytes


def set_rpath(data: bytes, rpath: str) -> bytes:
    """The ELF file with another search path for its libraries."""
    import tempfile

    with tempfile.NamedTemporaryFile(suffix=".so") as file:
        file.write(data)
        file.flush()
        subprocess.run(["patchelf", "--set-rpath", rpath, file.name], check=True)
        return Path(file.name).read_bytes()


def contents(bundle: Path) -> dict:
    """Path in the wheel -> (bytes, whether it is a program). Files that need libraries lie next to the package's Python
    files, where modules are searched too. The libraries are in quadrille/libs."""
    files = {}
    package = bundle / "python" / "quadrille"
    for path in sorted(package.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts and path.name != "command_path":
            files[f"quadrille/{path.relative_to(package)}"] = (path.read_bytes(), False)
    for path in sorted((bundle / "lib" / "quadrille").iterdir()):
        files[f"quadrille/{path.name}"] = (path.read_bytes(), path.name == "quadrille")
    for name, (data, program) in list(files.items()):
        if data[:4] == b"\x7fELF":
            files[name] = (set_rpath(data, "$ORIGIN/libs"), program)
    for path in sorted((bundle / "lib").glob("*.so*")):
        if path.is_file() and not path.is_symlink() and not path.name.startswith("libquadrille"):
            files[f"quadrille/libs/{path.name}"] = (set_rpath(path.read_bytes(), "$ORIGIN"), False)
    files["quadrille/LICENSE"] = ((bundle / "LICENSE").read_bytes(), False)
    return files


def metadata(version: str, tag: str) -> dict:
    info = f"quadrille-{version}.dist-info"
    return {
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: quadrille\nVersion: {version}\n"
        "Summary: All-quad shell meshes of CAD parts\nLicense: GPL-3.0-or-later\nRequires-Python: >=3.8\n"
        "Provides-Extra: arrays\nRequires-Dist: numpy; extra == 'arrays'\n\n"
        "The command `quadrille` with all its libraries; `import quadrille.freecad` in FreeCAD; the compiled module,\n"
        "which needs NumPy, for the Python that it was built for.\n",
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: quadrille\nRoot-Is-Purelib: false\nTag: {tag}\n",
        f"{info}/entry_points.txt": "[console_scripts]\nquadrille = quadrille.__main__:main\n",
    }


def main() -> None:
    bundle, version, folder = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    glibc = platform.libc_ver()[1].replace(".", "_")
    tag = f"py3-none-manylinux_{glibc}_{platform.machine()}"
    files = contents(bundle)
    files.update({name: (text.encode(), False) for name, text in metadata(version, tag).items()})
    record = f"quadrille-{version}.dist-info/RECORD"
    lines = []
    for name, (data, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(data)}")
    lines.append(f"{record},,")
    files[record] = (("\n".join(lines) + "\n").encode(), False)
    wheel = folder / f"quadrille-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, (data, program) in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = (0o100755 if program else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)


if __name__ == "__main__":
    main()
