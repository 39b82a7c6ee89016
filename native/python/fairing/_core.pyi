from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing._types import Diagnostic

__version__: str
CODES: tuple[str, ...]
WORDS: dict[str, tuple[str, ...]]
LIMITS: dict[str, float]

class Options:
    detail: float
    def __setattr__(self, name: str, value: object) -> None: ...

class PaperOptions:
    damping: float
    cg_steps: int
    sweeps: int
    vertex_sweeps: int
    epsilon: float
    acceleration: str
    virtual_points: str
    start: str
    levels: int

_Floats = npt.NDArray[np.float64]
_Ints = npt.NDArray[np.int32]

class Solver:
    def __init__(
        self,
        triangles: _Ints,
        fixed: _Ints | None,
        options: Options,
    ) -> None: ...
    def change(self, options: Options) -> None: ...
    def solve(
        self,
        vertices: _Floats,
        fixed_normals: _Floats | None,
        fixed_curvatures: _Floats | None,
        reference: _Floats | None,
        progress: Callable[[float, str], bool | None] | None,
        preview: Callable[[_Floats], object] | None,
    ) -> dict[str, Any]: ...

def fair(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints | None,
    fixed_normals: _Floats | None,
    fixed_curvatures: _Floats | None,
    reference: _Floats | None,
    outside: _Ints | None,
    options: Options,
    progress: Callable[[float, str], bool | None] | None,
    preview: Callable[[_Floats], object] | None,
) -> dict[str, Any]: ...
def mean_curvature(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints | None,
    fixed_normals: _Floats | None,
    normals: str,
) -> _Floats: ...
def vertex_normals(vertices: _Floats, triangles: _Ints, normals: str) -> _Floats: ...
def cotan_laplacian(vertices: _Floats, triangles: _Ints) -> tuple[_Ints, _Ints, _Floats]: ...
def components(triangles: _Ints, fixed: _Ints | None, vertex_count: int) -> _Ints: ...
def boundary_loops(triangles: _Ints) -> list[_Ints]: ...
def turned_triangles(triangles: _Ints, vertex_count: int) -> _Ints: ...
def flipped_triangles(vertices: _Floats, triangles: _Ints, fixed: _Ints | None) -> _Ints: ...
def girth(vertices: _Floats, triangles: _Ints, fixed: _Ints | None) -> tuple[float, float, _Ints, _Ints] | None: ...
def sunken(vertices: _Floats, triangles: _Ints, normals: _Floats, fixed: _Ints | None) -> tuple[float, _Ints]: ...
def is_rougher(vertices: _Floats, inside: _Ints, outside: _Ints) -> bool: ...
def has_lost_grain(before: _Floats, after: _Floats, inside: _Ints, outside: _Ints) -> bool: ...
def flank(
    vertices: _Floats, triangles: _Ints, around: _Ints, fixed: _Ints | None
) -> tuple[_Ints, bool, float] | None: ...
def needles(vertices: _Floats, triangles: _Ints) -> tuple[_Ints, _Ints]: ...
def rounded_edges(before: _Floats, after: _Floats, triangles: _Ints, moved: _Ints, marked: _Ints | None) -> _Ints: ...
def seam_room(
    vertices: _Floats, triangles: _Ints, edges: tuple[list[list[int]], list[list[int]]]
) -> tuple[float, _Floats]: ...
def seam_kinks(vertices: _Floats, triangles: _Ints, held: _Ints, limit: float) -> _Ints: ...
def is_spoilt(vertices: _Floats, inside: _Ints, outside: _Ints) -> bool: ...
def knobs(vertices: _Floats, triangles: _Ints, fixed: _Ints | None, before: float) -> tuple[float, _Ints]: ...
def self_intersections(vertices: _Floats, triangles: _Ints, near: _Ints | None) -> _Ints: ...
def conformal_distortion(reference: _Floats, vertices: _Floats, triangles: _Ints) -> _Floats: ...
def signed_distances(at: _Floats, reference: _Floats, triangles: _Ints) -> _Floats: ...
def hard_edges(vertices: _Floats, triangles: _Ints, marked: _Ints) -> _Ints: ...
def surrounding_normals(vertices: _Floats, triangles: _Ints, at: _Ints, creases: _Ints) -> dict[str, Any]: ...
def boundary_normals(
    vertices: _Floats, inside: _Ints, outside: _Ints, at: _Ints, creases: _Ints, all_inside: bool
) -> dict[str, Any]: ...
def bad_outline(vertices: _Floats, outside: _Ints, outline: _Ints) -> _Ints: ...
def feather_weights(vertices: _Floats, inside: _Ints, outside: _Ints, width: float, stops: _Ints) -> _Floats: ...
def soft_base(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints,
    base: _Floats,
    faired: npt.NDArray[np.bool_],
    sizes: tuple[float, float, float],
    threads: int,
    progress: Callable[[float, str], bool | None] | None,
) -> tuple[_Floats, _Floats]: ...
def mend_outline(vertices: _Floats, outside: _Ints, outline: _Ints) -> dict[str, Any]: ...
def fair_curve(places: _Floats, directions: _Floats, shares: list[float]) -> _Floats: ...
def chain_end(chain: _Floats) -> tuple[_Floats, _Floats]: ...
def visible_join(
    vertices: _Floats, inside: _Ints, outside: _Ints, outline: _Ints, before: _Floats | None
) -> tuple[_Floats, float, _Ints]: ...
def fillet_rows(
    vertices: _Floats,
    triangles: _Ints,
    edges: tuple[list[list[int]], list[list[int]]],
    widths: tuple[_Floats, _Floats],
    spacings: tuple[float, float],
    counted: list[list[int]] | None,
    surface: tuple[_Floats, _Ints, _Ints, _Floats, _Floats],
    progress: Callable[[float, str], bool | None] | None,
) -> dict[str, Any] | None: ...
def cut_fillet(
    vertices: _Floats,
    triangles: _Ints,
    edges: tuple[list[list[int]], list[list[int]]],
    widths: tuple[_Floats, _Floats],
    spacing: float,
    progress: Callable[[float, str], bool | None] | None,
) -> dict[str, Any]: ...
def denoised(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints,
    sizes: _Floats,
    threads: int,
    progress: Callable[[float, str], bool | None] | None,
) -> _Floats: ...
def on_wrong_side(
    vertices: _Floats,
    triangles: _Ints,
    edges: list[list[int]],
    width: float,
    before: _Floats,
    after: _Floats,
    progress: Callable[[float, str], bool | None] | None,
) -> _Ints: ...
def drawn_to(points: _Floats, triangles: _Ints, fixed: _Ints, target: _Floats, pull: _Floats) -> _Floats: ...
def fill_loops(
    vertices: _Floats,
    loops: list[_Ints],
    normals: list[_Floats],
    bridge: bool,
    equation: str,
    progress: Callable[[float, str], bool | None] | None,
) -> dict[str, Any]: ...

_Through = tuple[_Floats, list[_Ints], list[_Floats], _Ints, _Ints]

class Holes:
    def __init__(
        self,
        vertices: _Floats,
        triangles: _Ints,
        hard: _Ints,
        named: tuple[list[_Ints], list[_Floats], list[_Floats], _Floats, _Floats, int, float],
        bridge: bool,
        threads: int,
    ) -> None: ...
    @property
    def loops(self) -> list[list[_Ints]]: ...
    def slopes(self, spacing: float) -> list[tuple[_Floats, bool]]: ...
    @property
    def left(self) -> list[tuple[_Ints, Diagnostic, bool]]: ...
    @property
    def outer(self) -> Diagnostic | None: ...
    def around(self, hole: int) -> tuple[_Ints, _Ints]: ...
    def fill(
        self,
        through: list[_Through | None],
        wishes: tuple[bool, bool, bool, float, bool, int],
        options: Options,
        progress: Callable[[float, str], bool | None] | None,
    ) -> list[tuple[list[_Ints], dict[str, Any] | Diagnostic]]: ...

def hierarchy(vertices: _Floats, triangles: _Ints, fixed: _Ints | None, levels: int) -> list[tuple[_Ints, _Ints]]: ...
def hole_loops(vertices: _Floats, triangles: _Ints, border: _Ints | None) -> tuple[list[_Ints], list[_Ints]]: ...
def outer_borders(vertices: _Floats, triangles: _Ints, loops: list[_Ints]) -> list[bool]: ...
def expected_fill(vertices: _Floats, triangles: _Ints, loops: list[_Ints], bridge: bool, spacing: float) -> float: ...
def crossing_edges(edges: _Ints, vertices: _Floats) -> _Ints: ...
def touching_edges(edges: _Ints, vertices: _Floats) -> tuple[_Ints, _Ints]: ...
def quad_mesh(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints | None,
    fixed_normals: _Floats | None,
    progress: Callable[[float, str], bool | None] | None,
) -> dict[str, Any]: ...
def triangulated(vertices: _Floats, corners: _Ints, sizes: _Ints) -> _Ints: ...
def paired_quads(vertices: _Floats, triangles: _Ints, kept: _Ints) -> tuple[_Ints, _Ints, _Ints]: ...
def remesh(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints | None,
    fixed_normals: _Floats | None,
    free_slopes: tuple[_Ints, _Ints],
    kept: _Ints,
    wanted: tuple[float, int, bool, bool],
    threads: int,
    progress: Callable[[float, str], bool | None] | None,
) -> dict[str, Any]: ...
def interpolate(vertices: _Floats, triangles: _Ints, fixed: _Ints, values: _Floats) -> _Floats: ...
def conformal_map(vertices: _Floats, triangles: _Ints, fixed: _Ints, places: _Floats) -> _Floats: ...
def expected_count(
    vertices: _Floats,
    triangles: _Ints,
    fixed: _Ints | None,
    fixed_normals: _Floats | None,
    wanted: tuple[float, int, bool, bool],
) -> float: ...
