"""How method "paper" gets there: start, hierarchy, updates, acceleration and the options of each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import blend
import fairing
import shapes
from fairing import _core
from test_paper import PAPER_FIELDS, fair, solved


@pytest.mark.parametrize(
    "options",
    [
        {"damping": 0.6}, {"cg_steps": 20}, {"sweeps": 5}, {"vertex_sweeps": 1},
        {"acceleration": "none"}, {"acceleration": "none", "damping": 0.6},
    ],
    ids=lambda options: ",".join(options),
)  # fmt: skip
def test_what_the_paper_lets_one_choose_changes_the_way_only(options: dict[str, Any]) -> None:
    patch, result = solved("clothoid")
    other = fair(patch, **{"tolerance": 1e-7, **options})
    assert other.converged
    assert np.abs(other.vertices - result.vertices).max() < 2e-6 * patch.diameter


def test_the_interior_given_leaves_no_trace() -> None:
    patch = shapes.cap(300)
    noise = np.random.default_rng(1).normal(scale=0.05, size=patch.vertices.shape)
    noise[patch.fixed] = 0
    one, other = (fair(patch, vertices=patch.vertices + sign * noise, max_iterations=20) for sign in (1, -1))
    assert np.array_equal(one.vertices, other.vertices)


@pytest.mark.parametrize("kind", ["uniform", "conformal", "inverse_distance"])
@pytest.mark.parametrize("n_free", [70, 824], ids=["coarse within a fine outline", "Fig. 1"])
def test_both_methods_solve_the_same_discrete_equation(n_free: int, kind: str) -> None:
    """Same normals, same virtual points, same λ: 1e-4 D is asked."""
    patch = blend.cylinder_blend(n_free)
    paper = fair(patch, inner_fairness=kind)
    fast = fair(patch, inner_fairness=kind, method="global", max_iterations=200, normals="averaged")
    assert paper.converged
    assert fast.converged
    assert np.abs(paper.vertices - fast.vertices).max() < 1e-5 * patch.diameter


# Options


def test_options_of_the_paper_are_refused_by_the_global_method() -> None:
    for options in (fairing.PaperOptions(), fairing.PaperOptions(damping=0.5)):
        with pytest.raises(ValueError, match="paper: holds options of method 'paper'"):
            fair(shapes.cap(60), method="global", paper=options)
    with pytest.raises(ValueError, match=r"paper: a fairing\.PaperOptions is needed"):
        fair(shapes.cap(60), paper={"damping": 0.5})


def test_defaults_of_the_paper_are_the_engines() -> None:
    """One list: what the caller leaves out is what the C++ struct says, and no field is lost on the way."""
    engine, python = _core.PaperOptions(), fairing.PaperOptions()
    for name in PAPER_FIELDS:
        assert getattr(engine, name) == (0.0 if name == "epsilon" else getattr(python, name)), name
    assert (python.acceleration, python.vertex_sweeps) == ("anderson", 2)
    assert fairing.PaperOptions(acceleration="none").vertex_sweeps == 1
    assert fairing.PaperOptions(acceleration="none", vertex_sweeps=3).vertex_sweeps == 3


@pytest.mark.parametrize(
    ("option", "value", "accepted"),
    [
        ("damping", 1.5, "up to 1"),
        ("damping", 0.0, "positive"),
        ("cg_steps", 0, "1 or more"),
        ("epsilon", -1.0, "positive"),
        ("virtual_points", "some", "'everywhere'"),
        ("start", "none", "'linear'"),
        ("vertex_sweeps", 0, "1 or more"),
        ("acceleration", "plain", "'anderson'"),
        ("equation", "quadratic", "'minimal_energy'"),
        ("inner_fairness", "smooth", "'shape_preserving'"),
        ("inner_fairness", np.array([[0, 1, -1.0]]), "λ ≥ 0"),
        ("inner_fairness", np.array([[0, 1, 1.0]]), "needs a row"),
        ("levels", -1, "0 or more"),
        ("load", 1.0, "'constant'"),
    ],
)
def test_wrong_options_say_what_is_accepted(option: str, value: Any, accepted: str) -> None:
    with pytest.raises(ValueError, match=option) as caught:
        fair(shapes.cap(60), **{option: value})
    assert accepted in str(caught.value)
