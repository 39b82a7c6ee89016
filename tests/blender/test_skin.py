"""Keep Detail and Feather as users meet them: on a rough sphere with a dent in it."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes

NOISE = 0.01
LIMIT = 0.4  # faces above this height are selected


def dented(rim: int = 48) -> tuple[bpy.types.Object, meshes.Mask, meshes.Floats]:
    """Add a unit sphere, rough and dented within the selection; with the selection, and (n,) its roughness."""
    obj = meshes.sphere(rim)
    points = meshes.positions(obj)
    faces = meshes.faces_where(obj, lambda centre: centre.z > LIMIT)
    noise = NOISE * np.random.default_rng(7).normal(size=len(points)) * (points[:, 2] > LIMIT + 0.1)
    dent = 0.25 * np.clip((points[:, 2] - 0.55) / 0.45, 0, 1) ** 2
    meshes.move(obj, points * (1 + noise - dent)[:, None])
    return obj, faces, noise


def fair(obj: bpy.types.Object, faces: meshes.Mask, **options: Any) -> Any:
    """Run; return which vertices moved, after a look at everything else."""
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces, **options) == {"FINISHED"}
    return meshes.moved(before, meshes.contents(obj))


def test_detail_is_the_engines() -> None:
    """In the mesh is base + detail · (vertices − base) of the engine's own result."""
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    for share in (1.0, 0.3):
        obj, faces, _ = dented(32)
        whole, _, _ = dented(32)
        chosen = np.flatnonzero(faces)
        result = fair_mesh(whole.data, chosen, detail=1.0)
        part = fair_mesh(obj.data, chosen, detail=share)
        assert part.vertices == pytest.approx(result.base + share * (result.vertices - result.base), abs=1e-12)
        own = np.unique([v for face in chosen for v in obj.data.polygons[int(face)].vertices])
        assert meshes.positions(obj)[own] == pytest.approx(part.vertices, abs=1e-6)


def test_feather_moves_the_band_and_no_bit_beyond_it() -> None:
    """The foot of a swelling that reaches beyond the selection goes too."""
    obj = meshes.sphere(32)
    points = meshes.positions(obj)
    faces = meshes.faces_where(obj, lambda centre: centre.z > 0.6)
    free = meshes.free_vertices(obj, faces)
    meshes.move(obj, points * (1 + 0.2 * np.clip(points[:, 2:], 0, 1) ** 2))
    before = meshes.positions(obj)
    changed = fair(obj, faces, falloff=0.15)
    band = changed & ~free
    assert changed[free].all()
    assert band.any()
    gaps = np.linalg.norm(before[band][:, None] - before[free][None], axis=2).min(axis=1)
    moves = np.linalg.norm(meshes.positions(obj) - before, axis=1)[band]
    assert moves[gaps > np.median(gaps)].max() < 0.5 * moves.max()
    assert meshes.report().free_vertices == np.count_nonzero(free)
