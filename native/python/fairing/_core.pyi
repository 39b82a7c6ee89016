from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.results import Diagnostic

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

_Run = Callable[[float, str], bool | None] | None
_F = npt.NDArray[np.float64]
_Fields = dict[str, Any]
_Preview = Callable[[_F], object] | None
_I = npt.NDArray[np.int32]

class Solver:
    def __init__(self, triangles: _I, fixed: _I | None, options: Options) -> None: ...
    def change(self, options: Options) -> None: ...
    def solve(
        self,
        vertices: _F,
        fixed_normals: _F | None,
        fixed_curvatures: _F | None,
        reference: _F | None,
        progress: _Run,
        preview: _Preview,
    ) -> _Fields: ...

def fair(
    vertices: _F,
    triangles: _I,
    fixed: _I | None,
    fixed_normals: _F | None,
    fixed_curvatures: _F | None,
    reference: _F | None,
    outside: _I | None,
    options: Options,
    progress: _Run,
    preview: _Preview,
) -> _Fields: ...
def mean_curvature(vertices: _F, triangles: _I, fixed: _I | None, fixed_normals: _F | None, normals: str) -> _F: ...
def vertex_normals(vertices: _F, triangles: _I, normals: str) -> _F: ...
def cotan_laplacian(vertices: _F, triangles: _I) -> tuple[_I, _I, _F]: ...
def components(triangles: _I, fixed: _I | None, vertex_count: int) -> _I: ...
def boundary_loops(triangles: _I) -> list[_I]: ...
def turned_triangles(triangles: _I, vertex_count: int) -> _I: ...
def flipped_triangles(vertices: _F, triangles: _I, fixed: _I | None) -> _I: ...
def girth(vertices: _F, triangles: _I, fixed: _I | None) -> tuple[float, float, _I, _I] | None: ...
def is_spoilt(vertices: _F, inside: _I, outside: _I) -> bool: ...
def self_intersections(vertices: _F, triangles: _I, near: _I | None) -> _I: ...
def conformal_distortion(reference: _F, vertices: _F, triangles: _I) -> _F: ...
def signed_distances(at: _F, reference: _F, triangles: _I) -> _F: ...
def hard_edges(vertices: _F, triangles: _I, marked: _I) -> _I: ...
def hard_ways(vertices: _F, edges: _I, hard: _I, ends: list[list[int]]) -> _I: ...
def surrounding_normals(vertices: _F, triangles: _I, at: _I, creases: _I) -> _Fields: ...
def boundary_normals(vertices: _F, inside: _I, outside: _I, at: _I, creases: _I, all_inside: bool) -> _Fields: ...
def bad_outline(vertices: _F, outside: _I, outline: _I) -> _I: ...
def feather_weights(vertices: _F, inside: _I, outside: _I, width: float, stops: _I) -> _F: ...
def soft_base(
    vertices: _F,
    triangles: _I,
    fixed: _I,
    base: _F,
    faired: npt.NDArray[np.bool_],
    sizes: tuple[float, float, float],
    threads: int,
    progress: _Run,
) -> tuple[_F, _F]: ...
def mend_outline(vertices: _F, outside: _I, outline: _I) -> _Fields: ...
def fair_curve(places: _F, directions: _F, shares: list[float]) -> _F: ...
def chain_end(chain: _F) -> tuple[_F, _F]: ...
def judged(
    vertices: _F,
    surface: _I,
    others: _I,
    held: _I,
    rim: _I,
    before: _F | None,
    old: _I,
    moved: _I,
    marked: _I,
    is_clear: bool,
    progress: _Run,
) -> _Fields: ...
def visible_join(vertices: _F, inside: _I, outside: _I, outline: _I, before: _F | None) -> tuple[_F, float, _I]: ...
def fillet_rows(
    vertices: _F,
    triangles: _I,
    edges: tuple[list[list[int]], list[list[int]]],
    widths: tuple[_F, _F],
    spacings: tuple[float, float],
    counted: list[list[int]] | None,
    surface: tuple[_F, _I, _I, _F, _F, list[bool]],
    progress: _Run,
) -> _Fields | None: ...
def cut_fillet(
    vertices: _F,
    triangles: _I,
    edges: tuple[list[list[int]], list[list[int]]],
    widths: tuple[_F, _F],
    spacing: float,
    through: bool,
    progress: _Run,
) -> _Fields: ...
def seam_room(vertices: _F, triangles: _I, edges: tuple[list[list[int]], list[list[int]]]) -> tuple[float, _F]: ...
def denoised(vertices: _F, triangles: _I, fixed: _I, sizes: _F, threads: int, progress: _Run) -> _F: ...
def on_wrong_side(
    vertices: _F, triangles: _I, edges: list[list[int]], width: float, before: _F, after: _F, progress: _Run
) -> _I: ...
def drawn_to(points: _F, triangles: _I, fixed: _I, target: _F, pull: _F) -> _F: ...
def fill_loops(
    vertices: _F, loops: list[_I], normals: list[_F], bridge: bool, equation: str, progress: _Run
) -> _Fields: ...

_Through = tuple[_F, list[_I], list[_F], _I, _I]

class Holes:
    def __init__(
        self,
        vertices: _F,
        triangles: _I,
        hard: _I,
        named: tuple[list[_I], list[_F], list[_F], _F, _F, int, float],
        bridge: bool,
        threads: int,
    ) -> None: ...
    @property
    def loops(self) -> list[list[_I]]: ...
    def slopes(self, spacing: float) -> list[tuple[_F, bool]]: ...
    @property
    def left(self) -> list[tuple[_I, Diagnostic, bool]]: ...
    @property
    def outer(self) -> Diagnostic | None: ...
    def around(self, hole: int) -> tuple[_I, _I]: ...
    def fill(
        self,
        through: list[_Through | None],
        wishes: tuple[bool, bool, bool, float, bool, int],
        options: Options,
        progress: _Run,
    ) -> list[tuple[list[_I], _Fields | Diagnostic]]: ...

def hole_loops(vertices: _F, triangles: _I, border: _I | None) -> tuple[list[_I], list[_I]]: ...
def outer_borders(vertices: _F, triangles: _I, loops: list[_I]) -> list[bool]: ...
def expected_fill(vertices: _F, triangles: _I, loops: list[_I], bridge: bool, spacing: float) -> float: ...
def crossing_edges(edges: _I, vertices: _F) -> _I: ...
def touching_edges(edges: _I, vertices: _F) -> tuple[_I, _I]: ...
def new_patch(
    patch: tuple[_F, _I, _I | None, _F | None, _F | None, _I],
    kept: list[list[int]],
    options: Options,
    wishes: tuple[float, bool, bool, int],
    progress: _Run,
) -> _Fields: ...
def first_mesh(
    vertices: _F, triangles: _I, inside: npt.NDArray[np.bool_], seams: _I, spacings: _F
) -> tuple[npt.NDArray[np.bool_], _I, _I, _I]: ...
def wire_cells(wires: _I, vertices: _F, closed: bool) -> tuple[list[_I], _F, list[_I], _I]: ...
def cells_of_triangles(triangles: _I, loops: list[_I], vertex_count: int) -> _I: ...
def triangulated(vertices: _F, corners: _I, sizes: _I) -> _I: ...
def paired_quads(vertices: _F, triangles: _I, kept: _I) -> tuple[_I, _I, _I]: ...
def remesh(
    vertices: _F,
    triangles: _I,
    fixed: _I | None,
    fixed_normals: _F | None,
    free_slopes: tuple[_I, _I],
    kept: _I,
    wanted: tuple[float | _F, int, bool, bool],
    threads: int,
    progress: _Run,
) -> _Fields: ...
def interpolate(vertices: _F, triangles: _I, fixed: _I, values: _F) -> _F: ...
def conformal_map(vertices: _F, triangles: _I, fixed: _I, places: _F) -> _F: ...
def expected_count(
    vertices: _F, triangles: _I, fixed: _I | None, fixed_normals: _F | None, wanted: tuple[float | _F, int, bool, bool]
) -> float: ...
