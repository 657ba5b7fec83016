# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo for meshes. FreeCAD's undo restores every property except the FEM mesh: the property shares its mesh with the copy kept
for undo, and a new mesh overwrites both (0.20). So each mesh gets a token, which FreeCAD's undo does restore. The last few
meshes are kept, by token. Runs inside FreeCAD."""

import uuid
from collections import OrderedDict
from typing import Any, Dict, Tuple

import Fem

#: Number of meshes kept for each object.
KEPT = 5
#: {(document, object): {token: mesh}}
_meshes: Dict[tuple, "OrderedDict[str, object]"] = {}
#: The token of the mesh that each object holds.
_current: Dict[tuple, str] = {}


#: By object, the token of a mesh that is kept in any case, since an open panel may still cancel.
_held: Dict[tuple, str] = {}


def hold(mesh) -> None:
    """Keeps the current mesh of an object until release()."""
    _held[_key(mesh)] = mesh.MeshToken


def release(document, mesh_name: str) -> None:
    """Ends hold(): the mesh is then kept no longer than others."""
    _held.pop((document.Uid, mesh_name), None)


def _key(mesh) -> tuple:
    return (mesh.Document.Uid, mesh.Name)


def put(mesh, fem_mesh) -> None:
    """Gives a mesh object a new mesh, and keeps the old one for undo."""
    key = _key(mesh)
    kept = _meshes.setdefault(key, OrderedDict())
    if mesh.MeshToken and mesh.MeshToken not in kept and mesh.Document.UndoMode:
        kept[mesh.MeshToken] = mesh.FemMesh.copy()  # the old mesh was read with the document
    mesh.MeshToken = uuid.uuid4().hex
    mesh.FemMesh = fem_mesh
    _keep(mesh, fem_mesh)


def _keep(mesh, fem_mesh) -> None:
    key = _key(mesh)
    _current[key] = mesh.MeshToken
    if not mesh.Document.UndoMode:
        return
    kept = _meshes.setdefault(key, OrderedDict())
    kept[mesh.MeshToken] = fem_mesh
    kept.move_to_end(mesh.MeshToken)
    spare = [token for token in kept if token != _held.get(key)]
    for token in spare[:max(0, len(spare) - KEPT)]:
        del kept[token]


def bring_back(mesh) -> None:
    """After undo or redo: gives the object the mesh of its token, or an empty mesh if that one was not kept."""
    key = _key(mesh)
    if _current.get(key, mesh.MeshToken) == mesh.MeshToken:
        return
    mesh.FemMesh = _meshes.get(key, {}).get(mesh.MeshToken) or Fem.FemMesh()
    _current[key] = mesh.MeshToken


def forget(document) -> None:
    """Drops everything that is kept for a document that closes."""
    tables: Tuple[Dict[tuple, Any], ...] = (_meshes, _current, _held)
    for table in tables:
        for key in [key for key in table if key[0] == document.Uid]:
            del table[key]
