# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo for meshes. FreeCAD's undo brings back every property but the FEM mesh itself: the property for it shares its
mesh with the copy kept for undo, and a new mesh overwrites both (0.20). So each mesh gets a token, which FreeCAD's
undo does bring back, and the last few meshes are kept by their tokens. Runs inside FreeCAD."""

import uuid
from collections import OrderedDict
from typing import Dict

import Fem

#: Meshes kept for each object.
KEPT = 5
#: {(document, object): {token: mesh}}
_meshes: Dict[tuple, "OrderedDict[str, object]"] = {}
#: The token of the mesh that each object holds.
_current: Dict[tuple, str] = {}


#: Tokens of meshes that are kept whatever else is, by object: a panel is open that may take its work back.
_held: Dict[tuple, str] = {}


def hold(mesh) -> None:
    """Keeps the mesh that an object has until release()."""
    _held[_key(mesh)] = mesh.MeshToken


def release(document, mesh_name: str) -> None:
    """Keeps it no longer than others."""
    _held.pop((document.Uid, mesh_name), None)


def _key(mesh) -> tuple:
    return (mesh.Document.Uid, mesh.Name)


def put(mesh, fem_mesh) -> None:
    """Gives a mesh object a new mesh, and keeps the mesh that it had."""
    key = _key(mesh)
    kept = _meshes.setdefault(key, OrderedDict())
    if mesh.MeshToken and mesh.MeshToken not in kept and mesh.Document.UndoMode:
        kept[mesh.MeshToken] = mesh.FemMesh.copy()  # it was read with the document
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
    """After undo or redo: puts the mesh into the object that its token names; none when that was not kept."""
    key = _key(mesh)
    if _current.get(key, mesh.MeshToken) == mesh.MeshToken:
        return
    mesh.FemMesh = _meshes.get(key, {}).get(mesh.MeshToken) or Fem.FemMesh()
    _current[key] = mesh.MeshToken


def forget(document) -> None:
    """Drops what is kept for a document that closes."""
    for table in (_meshes, _current, _held):
        for key in [key for key in table if key[0] == document.Uid]:
            del table[key]
