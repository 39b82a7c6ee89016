"""What `fair` and `Solver` refuse, with which code and elements; what is solved with a warning; wrong arguments."""

import dataclasses
from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import shapes
from bad_inputs import CASES, WARNINGS
from shapes import FAMILIES, Style

CAP = shapes.cap(60)
COUNT = len(CAP.vertices)
# Figures that say how many of the elements named there are; INDEX_RANGE's are an index and the number of vertices.
COUNTS = {"vertices": 1, "triangles": 1, "repeated": 1, "unbounded": 1, "without_area": 1, "closed": 1, "edges": 2}


def call(**options: Any) -> fairing.FairResult:
    settings: dict[str, Any] = {
        "vertices": CAP.vertices, "triangles": CAP.triangles, "fixed": CAP.fixed, "fixed_normals": CAP.fixed_normals,
    }  # fmt: skip
    settings.update(options)
    return fairing.fair(settings.pop("vertices"), settings.pop("triangles"), **settings)


def counts_its_elements(said: fairing.Diagnostic) -> bool:
    if said.code == "INDEX_RANGE":
        return not 0 <= said.figures["vertex"] < said.figures["vertices"]
    return all(said.figures.get(name, len(said.elements) / n) * n == len(said.elements) for name, n in COUNTS.items())


@pytest.mark.parametrize("name", CASES)
def test_refused_meshes(name: str) -> None:
    """By the solver, too: what no positions could mend at once."""
    case = CASES[name]
    with pytest.raises(fairing.MeshError) as caught:
        fairing.fair(case.vertices, case.triangles, **case.options)
    assert caught.value.code == case.code and isinstance(caught.value, ValueError)
    assert set(case.elements) <= set(caught.value.elements) and counts_its_elements(caught.value.diagnostic)
    with pytest.raises(fairing.MeshError, match=case.code) as caught:
        solver = fairing.Solver(case.triangles, fixed=case.options.get("fixed"))
        assert case.code in ("NONFINITE", "INDEX_RANGE", "ZERO_NORMAL")
        solver.solve(case.vertices, case.options.get("fixed_normals"))
    assert set(case.elements) <= set(caught.value.elements)


@pytest.mark.parametrize("name", WARNINGS)
def test_meshes_solved_with_a_warning(name: str) -> None:
    case = WARNINGS[name]
    result = fairing.fair(case.vertices, case.triangles, **case.options)
    assert np.isfinite(result.vertices).all()
    (found,) = (warning for warning in result.warnings if warning.code == case.code)
    assert set(case.elements) <= set(found.elements) and counts_its_elements(found)
    if name == "one triangle turned":
        assert np.abs(result.vertices - call().vertices).max() < 1e-9
    if name == "an island without a border":
        assert np.array_equal(result.vertices[COUNT:], case.vertices[COUNT:])
        assert not np.array_equal(result.vertices, case.vertices)


def test_border_vertices_left_out_of_fixed_are_added_with_a_warning() -> None:
    part = CAP.fixed[3:]
    result = call(fixed=part, fixed_normals=CAP.normals[part])
    assert np.array_equal(result.fixed[: len(part)], part) and set(result.fixed) == set(CAP.fixed)
    (warning,) = (w for w in result.warnings if w.code == "OPEN_BORDER_IN_SELECTION")
    assert set(warning.elements) == set(CAP.fixed[:3])


def test_vertices_without_triangles_may_be_anything() -> None:
    loose = np.vstack([CAP.vertices, [[np.nan, np.inf, 0.0]]])
    result = call(vertices=loose)
    assert np.array_equal(result.vertices[-1], loose[-1], equal_nan=True) and np.isfinite(result.vertices[:-1]).all()


def with_first(array: Any, value: Any) -> Any:
    """A copy, of a wider type if need be, whose first entry is another."""
    kind = np.int64 if type(value) is int else type(value)  # numpy 1 on Windows takes an int for 32 bits
    result = array.astype(np.result_type(array, kind))
    result.reshape(-1)[0] = value
    return result


class Unwilling:
    """Not to be had as an array."""

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise TypeError("no array")


NO_ARRAYS: list[Any] = [[[0, 0], [1, 2, 3]], Unwilling(), {"a": 1}, b"mesh", [[None, 1, 2]]]
WRONG: dict[str, list[Any]] = {
    "vertices": [
        None, CAP.vertices.astype(complex), CAP.vertices.astype(object), CAP.vertices > 0, CAP.vertices[None], 1.0,
        "mesh", CAP.vertices.ravel(), np.ma.masked_greater(CAP.vertices, 0.5), np.zeros((0, 3)), *NO_ARRAYS,
    ],
    "triangles": [
        None, CAP.triangles[None], CAP.triangles.astype(float), np.ma.masked_equal(CAP.triangles, 3), CAP.triangles + 1,
        with_first(CAP.triangles.astype(np.uint64), np.uint64(2**63)), *NO_ARRAYS,
    ],
    "fixed": [
        3, CAP.fixed.astype(float), with_first(CAP.fixed, 2**31), with_first(CAP.fixed, -(2**40)), CAP.fixed[:, None],
        with_first(CAP.fixed, -1), with_first(CAP.fixed, COUNT), np.append(CAP.fixed, CAP.fixed[0]),
        np.isin(np.arange(COUNT), CAP.fixed), np.ma.masked_equal(CAP.fixed, CAP.fixed[0]), *NO_ARRAYS,
    ],
    "fixed_normals": [CAP.fixed_normals[:, :2], CAP.normals, 0 * CAP.fixed_normals, *NO_ARRAYS],
    "reference": [CAP.vertices.astype(complex), CAP.vertices[:-1], *NO_ARRAYS],
    "neighbours": [np.array([[0, -1]]), np.array([[0, 1, 2]]), np.array([[0, 100000]]), *NO_ARRAYS],
    "inner_fairness": [
        *(np.array([row]) for row in ([0.0, 1.0], [0.0, 1.0, -1.0], [0.0, 1e6, 1.0], [0.5, 1, 1], [0.0, 1e300, 1.0])),
        "smooth", *NO_ARRAYS,
    ],
    "tolerance": [None, 0.0, np.nan, "small", np.inf],
    "max_iterations": [2.5, True, 2**31, 0],
    "threads": [-1, 1.5, 2**31],
    "levels": [2**31, -1, 2],
    "load": [None, 1.0],
    "progress": [7],
    "method": ["fast"],
    "equation": ["biharmonic"],
    "normals": ["smooth"],
    "otherwise": ["never"],
    "pin_radius": [-0.1],
    "detail": [-0.1, 1.1, np.nan, "much", None, True],
    "detail_size": [-0.1, 1.1],
}  # fmt: skip


@pytest.mark.parametrize(("option", "value"), [(name, value) for name, many in WRONG.items() for value in many])
def test_wrong_arguments_of_every_kind_are_named(option: str, value: Any) -> None:
    with pytest.raises(ValueError, match=option):
        call(**{option: value})


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fixed": np.isin(np.arange(COUNT), CAP.fixed)}, r"fixed: .*np\.flatnonzero\(mask\)"),
        ({"triangles": CAP.triangles + 1}, r"INDEX_RANGE.*subtract 1 from those of an OBJ file"),
        ({"triangles": bad_inputs.with_entry(CAP.triangles, 7, 1, COUNT + 5)}, f"row 7 names vertex {COUNT + 5}, outs"),
        ({"fixed": None}, "fixed_normals"),
        ({"boundary": CAP.fixed}, "fixed: given twice"),
        ({"equation": "biharmonic"}, "'harmonic', 'constant', 'minimal_energy', 'soap_film'"),
        ({"inner_fairness": "smooth"}, "'uniform', 'conformal', 'inverse_distance'"),
    ],
)
def test_messages_say_what_helps(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call(**options)


def test_empty_masks_are_none() -> None:
    masked = np.ma.array(CAP.vertices, mask=np.zeros((COUNT, 3), bool))
    assert np.array_equal(call(vertices=masked).vertices, call().vertices)


def test_the_solver_refuses_fixed_vertices_at_once() -> None:
    for triangles, fixed, message in (
        (CAP.triangles, [1, 1], "fixed names vertex 1 twice"),
        (CAP.triangles, [0, -1], "fixed names vertex -1, outside"),
        ([[0, 1, -1]], None, "triangles: row 0 names vertex -1"),
        ([], None, "NO_FREE_VERTICES"),
        ([[0.5, 1.5, 2.5]], None, "triangles"),
    ):
        with pytest.raises(ValueError, match=message):
            fairing.Solver(triangles, fixed=fixed)
    far = fairing.Solver([[0, 1, 2_000_000_000]])  # no memory for vertices that may never come
    with pytest.raises(fairing.MeshError, match="INDEX_RANGE"):
        far.solve(np.eye(3))


def test_pinched_loops_repeat_the_pinch_and_unique_makes_them_fixed() -> None:
    """Two discs of six triangles that share one border vertex."""
    fan = np.array([[0, 1 + k, 1 + (k + 1) % 6] for k in range(6)])
    triangles = np.vstack([fan, np.where(fan == 1, 1, fan + 7)])
    border = np.concatenate(fairing.boundary_loops(triangles))
    assert (border == 1).sum() == 2
    angle = np.pi / 3 * np.arange(6)
    disc = np.vstack([[[0, 0, 0]], np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])])
    vertices = np.vstack([disc, [2, 0, 0] - disc])
    with pytest.raises(ValueError, match="fixed names vertex 1 twice"):
        fairing.fair(vertices, triangles, fixed=border)
    fixed = np.unique(border)
    result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=np.tile([0.0, 0.0, 1.0], (len(fixed), 1)))
    assert result.converged and np.abs(result.vertices[:, 2]).max() < 1e-9


def test_a_callback_may_call_again() -> None:
    """A fairing from within the progress of another: no lock is held."""
    inner: list[Any] = []
    result = call(progress=lambda fraction, stage: inner.append(call().vertices) or True)
    assert inner and all(np.array_equal(vertices, result.vertices) for vertices in inner)


# Options in groups: what they hold, fields of them by name, and what is refused.
def patch() -> tuple[Any, Any, fairing.Boundary]:
    made = FAMILIES["hemisphere"](80, Style())
    return made.vertices, made.triangles, fairing.Boundary(made.fixed, made.fixed_normals)


def test_groups_and_keywords_give_the_same_bits() -> None:
    vertices, triangles, boundary = patch()
    options = fairing.Options(
        fairing.Surface("constant", bulge=0.03),
        fairing.Layout("conformal"),
        curves=fairing.Curves(pin_radius=0.2),
        solving=fairing.Solving(tolerance=1e-3, max_iterations=50),
    )
    grouped = fairing.fair(vertices, triangles, boundary, options)
    by_name = fairing.fair(
        vertices, triangles, fixed=boundary.vertices, fixed_normals=boundary.normals, equation="constant",
        bulge=0.03, inner_fairness="conformal", pin_radius=0.2, tolerance=1e-3, max_iterations=50,
    )  # fmt: skip
    assert grouped.vertices.tobytes() == by_name.vertices.tobytes()
    flat = fairing.Options.of(
        equation="constant", bulge=0.03, inner_fairness="conformal", pin_radius=0.2, tolerance=1e-3, max_iterations=50
    )
    assert flat.chosen == options.chosen
    assert fairing.fair(vertices, triangles, boundary, flat).vertices.tobytes() == grouped.vertices.tobytes()
    # Each of the groups counts.
    for name in ("surface", "layout", "solving"):
        without = dataclasses.replace(options, **{name: getattr(fairing.Options(), name)})
        assert fairing.fair(vertices, triangles, boundary, without).vertices.tobytes() != grouped.vertices.tobytes()


def test_options_are_frozen_and_change_by_name() -> None:
    options = fairing.Options()
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.surface = fairing.Surface()  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.surface.load = 1.0  # type: ignore[misc]
    changed = options.changed(load=1.0, detail=0.5)
    assert (changed.surface.load, changed.skin.detail, options.surface.load) == (1.0, 0.5, 0.0)
    assert changed.chosen == {"load": 1.0, "detail": 0.5}


@pytest.mark.parametrize("call", [fairing.fair, fairing.fill, fairing.remesh])
def test_an_option_that_does_not_exist_is_refused(call: Any) -> None:
    vertices, triangles, _ = patch()
    with pytest.raises(TypeError, match="'equations' is no option; there are equation, "):
        call(vertices, triangles, equations="soap_film")
    with pytest.raises(TypeError, match="'equations' is no option; there are equation, "):
        fairing.Options.of(equations="soap_film")


def test_a_group_that_is_something_else_is_refused_by_name() -> None:
    vertices, triangles, boundary = patch()
    with pytest.raises(ValueError, match=r"options: a fairing.Options is needed"):
        fairing.fair(vertices, triangles, boundary, {"equation": "soap_film"})  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"options: surface has to be a fairing.Surface, not 'soap_film'"):
        fairing.fair(vertices, triangles, boundary, fairing.Options("soap_film"))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="equation: 'flat' is not accepted"):
        fairing.fair(vertices, triangles, boundary, fairing.Options(fairing.Surface("flat")))
