"""All patches of the real meshes, from edit mode with default options, and textures on a head."""

from __future__ import annotations

from typing import Any

import meshes
import pytest
import real

PATCHES = real.patches()
needs_meshes = pytest.mark.skipif(not PATCHES, reason="the folder with the real meshes is not here")


def run(patch: dict[str, Any], **options: Any) -> Any:
    obj = real.load(patch["mesh"])
    faces = real.faces_of(obj, patch)
    assert faces.sum() == patch["faces"]
    assert meshes.fair(obj, faces, **options) == {"FINISHED"}
    return meshes.report()


def counts(report: Any, name: str) -> tuple[int, int]:
    before, after = report.checks[name].value.split(" → ")
    return int(before), int(after)


@needs_meshes
@pytest.mark.slow
@pytest.mark.parametrize("patch", PATCHES, ids=[real.name(patch) for patch in PATCHES])
def test_patch_converges_without_new_flips(patch: dict[str, Any]) -> None:
    report = run(patch)
    assert report.converged
    assert report.verdict != "UNUSABLE"
    before, after = counts(report, "Folded faces")
    assert after <= before


@needs_meshes
@pytest.mark.slow
@pytest.mark.parametrize("name", ["ear_left", "nose", "cheek"])
def test_keep_texture_distorts_less(name: str) -> None:
    (patch,) = (p for p in PATCHES if p["mesh"] == "ict_head.obj" and p["patch"] == name)
    even = run(patch, inner_fairness="UNIFORM").distortion
    kept = run(patch, inner_fairness="CONFORMAL").distortion
    assert kept < even
