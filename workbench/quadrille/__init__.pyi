# SPDX-License-Identifier: GPL-3.0-or-later
from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Set, SupportsIndex, Tuple, Union

from numpy import float64, int32
from numpy.typing import ArrayLike, NDArray

from .core.errors import Error as Error

__version__: str

_Path = Union[str, PathLike[str]]
_Entries = Union[Sequence[str], Mapping[str, Union[float, Sequence[float]]]]  # ["Edge4=20"] or {"Edge4": 20}
_Nodes = Union[Sequence[Union[str, Sequence[float]]], Mapping[str, Sequence[float]]]  # [(1, 2, 3)] or {"Tip": (1, 2, 3)}
_Progress = Callable[[str, float], Optional[bool]]
_Limits = Union[str, PathLike[str], None]

class Model:
    face_count: int
    edge_count: int
    vertex_count: int
    solid_count: int
    shell_count: int
    diagonal: float
    area: float
    problems: List[str]
    face_names: Dict[str, Set[int]]
    pieces: List[List[int]]
    box: Tuple[List[float], List[float]]

class Mesh:
    order: int
    points: NDArray[float64]
    quads: NDArray[int32]
    face_ids: NDArray[int32]
    triangles: NDArray[int32]
    triangle_face_ids: NDArray[int32]
    segments: NDArray[int32]
    corners: NDArray[int32]
    faces: List[Dict[str, Any]]
    groups: List[Tuple[str, int, int, List[int]]]
    def __init__(
        self,
        points: ArrayLike,
        quads: ArrayLike,
        *,
        triangles: Optional[ArrayLike] = None,
        face_ids: Optional[ArrayLike] = None,
        triangle_face_ids: Optional[ArrayLike] = None,
        segments: Optional[ArrayLike] = None,
        corners: Optional[ArrayLike] = None,
    ) -> None: ...
    def quality(self, limits: _Limits = None) -> Dict[str, Any]: ...
    def qualities(self) -> NDArray[float64]: ...
    def write(
        self,
        path: _Path,
        *,
        title: str = "",
        msh_version: Optional[str] = None,
        nodes: Optional[int] = None,
        element: Optional[str] = None,
        scale: Optional[float] = None,
        groups: Optional[Sequence[str]] = None,
    ) -> None: ...
    def picture(self, path: _Path, *, width: int = 1600, height: int = 1200) -> None: ...
    def recombined(
        self, *, feature_angle: float = 40.0, merge: Optional[float] = None, improve: bool = True, threads: int = 0
    ) -> Mesh: ...
    @property
    def fidelity(self) -> Optional[Dict[str, Any]]: ...
    def _repr_html_(self) -> str: ...

class MidSurface:
    model: Model
    faces: List[Dict[str, Any]]
    rims: List[Tuple[int, List[int]]]
    volume: float
    shell_volume: float
    parts: int
    free_edges: int
    unpaired: List[int]
    counted_twice: float
    warnings: List[str]
    problems: List[str]
    def write(self, path: _Path) -> None: ...

def read(
    path: _Path,
    *,
    isolated: bool = True,
    imprint: Optional[bool] = None,
    sew: Optional[float] = None,
    read_time_limit: Optional[float] = None,
) -> Model: ...
def read_brep(
    text: str,
    name: str = "shape",
    *,
    isolated: bool = True,
    imprint: Optional[bool] = None,
    sew: Optional[float] = None,
    read_time_limit: Optional[float] = None,
) -> Model: ...
def read_mesh(path: _Path) -> Mesh: ...
def mesh(
    model: Union[Model, MidSurface],
    *,
    progress: Optional[_Progress] = None,
    size: Optional[float] = None,
    elements_per_diagonal: Optional[float] = None,
    size_min: Optional[float] = None,
    elements_per_circle: Optional[float] = None,
    aspect: Optional[float] = None,
    growth: Optional[float] = None,
    gradation: Optional[str] = None,
    chord_error: Optional[str] = None,
    proximity: Optional[float] = None,
    order: Optional[int] = None,
    strategy: Optional[str] = None,
    faces: Optional[Sequence[Union[str, SupportsIndex]]] = None,
    sizes: Optional[Mapping[str, float]] = None,
    size_field: Optional[_Path] = None,
    size_field_scale: Optional[float] = None,
    size_field_unit: Optional[float] = None,
    size_points: Optional[_Path] = None,
    size_in: Optional[Sequence[str]] = None,
    segments: Optional[_Entries] = None,
    bias: Optional[_Entries] = None,
    bias_both: Optional[_Entries] = None,
    merge_tiny: Optional[float] = None,
    rings: Optional[int] = None,
    partial: Optional[bool] = None,
    strict: Optional[bool] = None,
    reach: Optional[float] = None,
    fill_holes: Optional[float] = None,
    keep_features: Optional[bool] = None,
    keep: Optional[_Entries] = None,
    nodes_at: Optional[_Nodes] = None,
    force: Optional[bool] = None,
    time_limit: Optional[float] = None,
    threads: Optional[int] = None,
) -> Mesh: ...
def midsurface(model: Model, *, partial: bool = False, join: bool = False) -> MidSurface: ...
def recombine(
    points: ArrayLike, triangles: ArrayLike, *, tags: Optional[ArrayLike] = None, improve: bool = True, threads: int = 0
) -> Mesh: ...
def remesh(
    surface: Mesh,
    *,
    size: float,
    feature_angle: float = 40.0,
    merge: Optional[float] = None,
    order: int = 1,
    progress: Optional[_Progress] = None,
    force: Optional[bool] = None,
    time_limit: Optional[float] = None,
    threads: Optional[int] = None,
) -> Mesh: ...
def suggested_size(model: Model, quads: int = 5000) -> float: ...
def settings() -> List[Dict[str, Any]]: ...
