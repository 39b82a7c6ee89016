"""The figures that warnings and errors carry: numbers by name, from which other words can be made."""

from __future__ import annotations

import pytest

import bad_inputs
import fairing
import shapes

# Figures that say how many of the elements named there are; INDEX_RANGE's are an index and the number of vertices.
COUNTS = {
    "vertices": 1, "triangles": 1, "repeated": 1, "unbounded": 1, "without_area": 1, "closed": 1, "left_alone": 1,
    "edges": 2,
}  # fmt: skip


def diagnostics(name: str) -> tuple[fairing.Diagnostic, ...]:
    """What is said about one of the bad inputs."""
    case = {**bad_inputs.CASES, **bad_inputs.WARNINGS}[name]()
    try:
        result = fairing.fair(case.vertices, case.triangles, **case.options)
    except fairing.MeshError as error:
        return (error.diagnostic,)
    return result.warnings


@pytest.mark.parametrize("name", [*bad_inputs.CASES, *bad_inputs.WARNINGS])
def test_figures_count_the_elements(name: str) -> None:
    for diagnostic in diagnostics(name):
        assert diagnostic.code in fairing.CODES
        if diagnostic.code == "INDEX_RANGE":
            assert not 0 <= diagnostic.figures["vertex"] < diagnostic.figures["vertices"]
            continue
        for figure, each in COUNTS.items():
            assert diagnostic.figures.get(figure, len(diagnostic.elements) / each) * each == len(diagnostic.elements)


def test_a_normal_of_length_zero_names_its_vertex() -> None:
    patch = shapes.cap(100)
    normals = patch.fixed_normals.copy()
    normals[3] = 0.0
    with pytest.raises(fairing.MeshError, match="fixed_normals: row 3") as caught:
        fairing.fair(patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=normals)
    assert caught.value.code == "ZERO_NORMAL"
    assert caught.value.elements.tolist() == [patch.fixed[3]]
    assert caught.value.diagnostic.figures == {"row": 3.0}


def test_a_load_beyond_the_last_surface_tells_the_share_that_was_reached() -> None:
    cap = shapes.cap(150, half_angle=60.0)
    result = fairing.fair(
        cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals, equation="constant", load=30.0
    )
    (partly,) = (w for w in result.warnings if w.code == "NOT_CONVERGED")
    share = partly.figures["load_share"]
    assert 0.0 < share < 1.0
    assert f"{round(100 * share)} % of the load" in partly.message
    assert partly.figures["free_vertices"] == len(cap.free) == len(partly.elements)
