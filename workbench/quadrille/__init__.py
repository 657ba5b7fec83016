# SPDX-License-Identifier: GPL-3.0-or-later
"""Quadrille: all-quad shell meshes of CAD models.

    import quadrille
    model = quadrille.read("part.step")
    mesh = quadrille.mesh(model, size=2.0)
    mesh.points, mesh.quads        # NumPy arrays
    mesh.write("part.inp")

Inside FreeCAD, use the layer that runs the mesher as a child process and never loads a second OpenCASCADE:

    import quadrille.freecad
    quadrille.freecad.mesh_object(App.ActiveDocument.Part, size=2.0)

The compiled part, `quadrille._quadrille`, is loaded when one of its names is first used. Importing `quadrille` or
`quadrille.freecad` does not need it.
"""

from .core.errors import Error

__all__ = ["Error", "Mesh", "MidSurface", "Model", "__version__", "mesh", "midsurface", "read", "read_brep", "read_mesh",
           "recombine", "remesh", "settings", "suggested_size"]

_COMPILED = frozenset(__all__) - {"Error", "__version__"}


def __getattr__(name: str):
    """Loads the compiled part on demand (PEP 562)."""
    if name == "__version__":  # the addon, which has no compiled part, needs it too
        from .core.command import VERSION

        return VERSION
    if name not in _COMPILED:
        raise AttributeError(f"module 'quadrille' has no attribute '{name}'")
    try:
        from . import _quadrille
    except ImportError as error:
        raise ImportError(f"quadrille.{name} needs the compiled module quadrille._quadrille: {_why_missing(error)}") from error
    return getattr(_quadrille, name)


def _why_missing(error: ImportError) -> str:
    """Why the compiled module cannot be loaded, and what to do about it."""
    from pathlib import Path

    others = sorted(path.name for path in Path(__file__).parent.glob("_quadrille.*"))
    if others:
        return f"{', '.join(others)} cannot be loaded here ({error}); use the Python that it was made for, or the command"
    return f"{error}; build it with ./run.sh and put build/python on sys.path"


def __dir__() -> list:
    return sorted(set(globals()) | set(__all__))
