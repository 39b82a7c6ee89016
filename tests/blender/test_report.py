"""The report: figures against closed forms, and what is called met or missed."""

import re

import bpy
import pytest

import meshes
from test_restoration import spoil, upper_half


def checks() -> dict[str, tuple[str, str]]:
    return {check.name: (check.value, check.state) for check in meshes.report().checks}


def details() -> dict[str, bool]:
    return {check.name: check.detail for check in meshes.report().checks}


def test_nothing_is_good_before_it_has_been_looked_at() -> None:
    report = meshes.report()
    report.property_unset("verdict")
    assert report.verdict == "UNUSABLE"


def test_options_that_nothing_looked_at_are_reported_by_their_labels(capfd: pytest.CaptureFixture[str]) -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, shape="MINIMAL_ENERGY", bulge=0.5)
    assert checks()["Without effect"] == ("Bulge", "TOLD")
    assert details()["Without effect"]
    assert "Without effect with these options: Bulge" in capfd.readouterr().out
    meshes.fair(obj, faces, bulge=0.1)
    assert "Without effect" not in checks()


def test_report_of_a_restored_hemisphere() -> None:
    obj = meshes.sphere(96)
    upper = upper_half(obj)
    spoil(obj, upper)
    meshes.fair(obj, upper)
    found = checks()
    assert meshes.report().verdict == "GOOD"
    assert [name for name in found if not details()[name]] == [
        "Shape",
        "Kink at the boundary",
        "Kinks show from",
        "Folded faces",
        "Faces that cross",
        "Needles",
        "Texture distortion",
    ]
    assert found["Shape"] == ("Harmonic", "TOLD")
    assert found["Equation solved"] == ("yes", "TOLD")
    assert found["Kink at the boundary"][1] == "MET"
    # H = −1 inside and out: the maximum principle is met with equality
    inside, outline = map(float, re.split(" [≤>] ", found["Curvature inside"][0]))
    assert inside == pytest.approx(1.0, abs=5e-3)
    assert outline == pytest.approx(1.0, abs=5e-3)
    rough, solved = map(float, found["Residual"][0].split(" → "))
    assert solved < 1e-2 * rough
    before, after = found["Folded faces"][0].split(" → ")
    assert int(before) > 0
    assert int(after) == 0
    assert found["Faces that cross"][0].endswith("→ 0")
    assert 0.0 <= meshes.report().join_typical <= meshes.report().join_worst < 2.0
    assert meshes.report().seconds > 0.0


def test_what_was_edited_since_is_not_compared() -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    meshes.run()
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))
    with pytest.raises(RuntimeError, match="edited since"):
        bpy.ops.mesh.fair_compare("EXEC_DEFAULT", True)
