"""One mesh with a live region, as it was last seen."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np

from ..arrays.region import free_vertices
from ..arrays.types import Floats, Ints
from ..mesh import live_mesh, mesh_io
from ..options.options import FairOptions
from ..run.runner import Run
from ..words.words import said
from .region import Found, LiveRegion

BLINK = 0.02  # seconds that a step of a drag waits for a search to stop


@dataclass
class Session:
    """One mesh with a region, as it was last seen."""

    faces: Ints
    corners: Ints
    counts: tuple[int, int, int]
    region: LiveRegion
    positions: Floats = field(default_factory=lambda: np.empty((0, 3)))  # of region.vertices
    matrix: Floats = field(default_factory=lambda: np.zeros((4, 4)))
    seconds: float = 0.0  # of the last answer
    lost: bool = False  # no fair surface is shown, but the one that there always is
    given_up: bool = False  # as there is none for these positions: a search has ended without
    search: Run[Found] | None = None  # for the surface, under way or about to stop: it alone may ask the region
    checked: bool = True  # an undo may have brought back another region
    key: str = ""  # the shape key that the region is in, as mesh_io.writable_key names it
    object_name: str = ""  # of a candidate

    def is_at(self, positions: Floats, matrix: Floats) -> bool:
        return np.array_equal(positions, self.positions) and np.array_equal(matrix, self.matrix)

    def moved(self, positions: Floats, matrix: Floats) -> bool:
        """Take other positions, for which no search holds any more; return whether they differ."""
        if self.is_at(positions, matrix):
            return False
        self.positions, self.matrix, self.given_up = positions, matrix, False
        self.call_off()
        return True

    def call_off(self) -> None:
        """Stop searching. Nobody may ask the region before it has ended, which may take a step of the engine."""
        if self.search is not None:
            self.search.cancel()
            if self.search.wait(BLINK):
                self.search = None

    def wrote(self, positions: Floats) -> None:
        """Take note of where the region's vertices (k, 3) that move are now: as Blender stores them."""
        at = np.searchsorted(self.region.vertices, self.region.free)
        self.positions = self.positions.copy()  # a search may be reading them
        self.positions[at] = positions.astype(np.float32)


def matrix_of(obj: bpy.types.Object) -> Floats:
    """Return the (4, 4) map to world space."""
    matrix: Floats = np.array(obj.matrix_world, dtype=np.float64)
    return matrix


def where(obj: bpy.types.Object, region: LiveRegion) -> tuple[Floats, Floats]:
    """Return the positions (n, 3) of region.vertices now, and the object's (4, 4) matrix."""
    return live_mesh.positions(obj.data, region.vertices), matrix_of(obj)


def read(obj: bpy.types.Object, options: FairOptions, faces: Ints | None) -> LiveRegion:
    """Read the object's mesh with these faces, or else its selection, as the patch."""
    mesh_io.writable_key(obj)
    if options.boundary_normals == "CUSTOM":
        raise ValueError(said("live_custom_normals"))
    mesh = mesh_io.read_edit_mesh(obj, options, faces)
    if not free_vertices(mesh).any():
        raise ValueError(said("live_no_free"))
    return LiveRegion(mesh, matrix_of(obj), options)


def check_key(obj: bpy.types.Object) -> None:
    """Raise ValueError while another shape key is active than the one that the region was made in, or it is locked."""
    active, own = mesh_io.writable_key(obj), live_mesh.region_key(obj.data)
    if active != own:
        raise ValueError(said("live_other_key", key=own) if own else said("live_other_basis"))


def session_of(obj: bpy.types.Object) -> Session:
    """Open a session with the region of the object that is marked in its mesh."""
    faces = live_mesh.region_faces(obj.data)
    assert faces is not None
    region = read(obj, live_mesh.region_options(obj.data), faces)
    corners, counts = live_mesh.corners(obj.data, faces), live_mesh.counts(obj.data)
    return Session(faces, corners, counts, region, key=live_mesh.region_key(obj.data))


def candidate(obj: bpy.types.Object, options: FairOptions) -> Session:
    """Read the selection as a region to be: nothing is marked yet. Raises ValueError where it can't be one."""
    region = read(obj, options, None)
    corners, counts = live_mesh.corners(obj.data, region.faces), live_mesh.counts(obj.data)
    key = mesh_io.writable_key(obj)
    return Session(region.faces, corners, counts, region, *where(obj, region), key=key, object_name=obj.name)


def is_current(obj: bpy.types.Object, session: Session) -> bool:
    """Return whether an object in edit mode still is as its candidate was read, in that shape key."""
    try:
        same_key = mesh_io.writable_key(obj) == session.key
    except ValueError:  # locked meanwhile
        return False
    return same_key and fits(session, obj.data) and session.is_at(*where(obj, session.region))


def is_of(session: Session, mesh: bpy.types.Mesh) -> bool:
    """Return whether a session put aside is that of the mesh's region as it is now."""
    session.checked = False
    same = session.region.options == live_mesh.region_options(mesh)
    return same and session.key == live_mesh.region_key(mesh) and fits(session, mesh)


def fits(session: Session, mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh still has the connectivity and the region of the session."""
    if live_mesh.counts(mesh) != session.counts:
        return False
    if not session.checked:
        faces = live_mesh.region_faces(mesh)
        session.checked = faces is not None and np.array_equal(faces, session.faces)
    return session.checked and np.array_equal(live_mesh.corners(mesh, session.faces), session.corners)
