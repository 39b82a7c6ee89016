"""The report: figures against closed forms, and what is called met or missed."""

from __future__ import annotations

import re
from typing import Any

import bmesh
import bpy
import meshes
import numpy as np
import pytest
import spoiled
from extension import module
from test_restoration import spoil, upper_half

QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])


def checks() -> dict[str, tuple[str, str]]:
    return {check.name: (check.value, check.state) for check in meshes.report().checks}


def test_report_of_a_restored_hemisphere() -> None:
    obj = meshes.sphere(96)
    upper = upper_half(obj)
    spoil(obj, upper)
    meshes.fair(obj, upper)
    found = checks()
    assert list(found) == [
        "Equation solved",
        "Angle at the outline",
        "Curvature inside",
        "Residual",
        "Flipped triangles",
        "Degenerate triangles",
        "Self-intersections",
        "Texture distortion",
    ]
    assert found["Equation solved"] == ("yes", "MET")
    assert found["Angle at the outline"][1] == "MET"
    # H = −1 inside and out: the maximum principle is met with equality
    inside, outline = map(float, re.split(" [≤>] ", found["Curvature inside"][0]))
    assert inside == pytest.approx(1.0, abs=5e-3)
    assert outline == pytest.approx(1.0, abs=5e-3)
    assert found["Curvature inside"][1] == "MET"
    rough, solved = map(float, found["Residual"][0].split(" → "))
    assert solved < 1e-2 * rough
    before, after = found["Flipped triangles"][0].split(" → ")
    assert int(before) > 0
    assert int(after) == 0
    assert found["Self-intersections"][0].endswith("→ 0")
    assert meshes.report().seconds > 0.0


def test_kink_of_a_soap_film_is_no_fault() -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, equation="MINIMAL")
    assert "Equation solved" in checks()
    assert "Angle at the outline" not in checks()


def test_an_angle_that_misses_the_limit_does_not_look_like_it() -> None:
    report = module("core.report")
    texts = {
        1.96: "2°",
        2.0: "2°",
        2.0004: "2.0004°",
        2.04: "2.04°",
        2.06: "2.1°",
        9.96: "10°",
        48.4: "48°",
        0.0312: "0.031°",
    }
    assert {angle: report.angle_text(angle) for angle in texts} == texts


@pytest.mark.parametrize(("equation", "told"), [("MINIMAL", False), ("HARMONIC", True)])
def test_summary_of_a_soap_film_tells_no_angle(equation: str, told: bool) -> None:
    job, report = module("run.job"), module("core.report")
    obj, faces = meshes.domed_grid()
    options = module("core.options").FairOptions(equation=equation)
    meshes.select(obj, faces)
    meshes.edit(obj)
    (outcome,) = job.solve(job.read(bpy.context, options), options, lambda *_: True)
    made = report.make_report([(obj.name, outcome)], options, 0.1)
    assert ("largest angle at the outline" in report.summary(made)) == told


def test_unfinished_run_is_missed() -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, max_iterations=1, tolerance=1e-13)
    assert not meshes.report().converged
    assert checks()["Equation solved"][1] == "MISSED"


def test_self_intersections() -> None:
    intersections = module("mesh.crossings").intersections
    # two parallel strips of two triangles, then one of them stood through the other
    other = QUAD + np.array([0.0, 0.0, 1.0])
    triangles = np.vstack([TWO, TWO + 4])
    assert intersections(np.vstack([QUAD, other]), triangles) == 0
    upright = QUAD[:, [0, 2, 1]] + np.array([0.0, 0.4, -0.5])
    pairs = intersections(np.vstack([QUAD, upright]), triangles)
    # the line y = 0.4, z = 0 crosses both triangles of each: four pairs, one of which meets at most in a point
    assert pairs in (3, 4)


def crossings() -> str:
    found: str = checks()["Self-intersections"][0].split(" → ")[1]
    return found


def test_islands_that_run_into_each_other_are_counted() -> None:
    """Two flat squares become domes; the upper one bulges down through the lower one."""
    lower, faces = meshes.domed_grid()
    points = meshes.grid_points()
    both = meshes.add(
        np.vstack([points, points + np.array([0.05, 0.03, 0.1])]),
        [[v + shift for v in p.vertices] for shift in (0, len(points)) for p in lower.data.polygons],
    )
    meshes.fair(both, np.concatenate([faces, faces]))
    assert crossings() == "0"
    meshes.fair(both, np.concatenate([faces, faces]), equation="CONSTANT", bulge=0.6)
    assert crossings() == "0"  # both bulge upwards
    spoiled.edited(both, lambda bm: bmesh.ops.reverse_faces(bm, faces=bm.faces[len(faces) :]))
    meshes.fair(both, np.concatenate([faces, faces]), equation="CONSTANT", bulge=0.6)
    assert int(crossings()) > 0


@pytest.mark.parametrize("factor", [1.0, 0.999])
def test_a_patch_that_runs_into_itself_is_counted(factor: float) -> None:
    """An outline that goes round twice; at the factor 1 the engine has looked already."""
    obj = meshes.grid(16)
    points = meshes.grid_points(16)
    rim = np.isclose(np.abs(points[:, :2]).max(axis=1), 1.0)
    turn = np.arctan2(points[rim, 1], points[rim, 0])
    points[rim] = np.column_stack([np.cos(2.0 * turn), np.sin(2.0 * turn), 0.3 * np.cos(turn)])
    meshes.move(obj, points)
    meshes.fair(obj, np.ones(len(obj.data.polygons), dtype=bool), factor=factor, equation="MINIMAL")
    assert int(crossings()) > 0


def test_before_and_after() -> None:
    obj, faces = meshes.domed_grid()
    start = meshes.in_edit_mode_once(obj, faces)
    module("run.compare").forget()
    meshes.edit(obj)
    assert not bpy.ops.mesh.fair_compare.poll()
    meshes.run()
    states: list[Any] = [meshes.contents_in_edit_mode()]
    for _ in range(3):
        assert bpy.ops.mesh.fair_compare("EXEC_DEFAULT", True) == {"FINISHED"}
        states.append(meshes.contents_in_edit_mode())
    assert states[1] == start
    assert states[2] == states[0]
    assert states[3] == start
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))
    with pytest.raises(RuntimeError, match="edited since"):
        bpy.ops.mesh.fair_compare("EXEC_DEFAULT", True)
