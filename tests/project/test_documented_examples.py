"""The Python code of docs/python.md and README.md, run as printed, and what it claims."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairing

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def run(page: str) -> dict[str, Any]:
    """The names that all blocks of a page leave behind, run in order; those for Blender and for files are left out."""
    text = (ROOT / page).read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    for block in BLOCK.finditer(text):
        if "import bpy" in block[1] or "import meshio" in block[1]:
            continue
        first_line = text[: block.start(1)].count("\n")
        code = compile("\n" * first_line + block[1], page, "exec")
        exec(code, names)
    return names


@pytest.fixture(scope="module")
def page() -> dict[str, Any]:
    return run("docs/python.md")


def test_the_package_page() -> None:
    names = run("native/python/README.md")
    assert names["hole"].converged
    assert abs(radius(names["hole"].vertices) - 1).max() < 1e-5


def radius(vertices: Any) -> Any:
    return np.linalg.norm(vertices[:, :2], axis=1)


def test_the_tube_comes_back(page: dict[str, Any]) -> None:
    dented = radius(page["vertices"])
    assert abs(dented - 1).max() > 0.3
    assert page["surroundings"].fitted.all()
    for name in ("result", "first", "even", "textured"):
        result = page[name]
        assert result.converged and result.polished, name
        assert not result.warnings, name
        assert abs(radius(result.vertices) - 1).max() < 5e-5, name
        assert result.residual < 1e-2 * result.initial_residual, name
    unused = np.setdiff1d(np.arange(len(page["vertices"])), page["inside"])
    assert np.array_equal(page["result"].vertices[unused], page["vertices"][unused])
    assert np.array_equal(page["first"].vertices, page["result"].vertices)
    assert page["result"].boundary_angle.max() < 0.1


def test_the_mesh_border_takes_the_patchs_own_normals(page: dict[str, Any]) -> None:
    assert not page["known"].all()
    assert (~page["known"]).sum() == page["columns"]
    assert page["end"].converged
    assert [warning.code for warning in page["end"].warnings] == ["OPEN_BORDER_IN_SELECTION"]
    assert np.array_equal(np.sort(page["end"].warnings[0].elements), page["rim"][~page["known"]])


def test_error_and_cancelling(page: dict[str, Any]) -> None:
    assert page["code"] == "INDEX_RANGE"
    assert page["cancelled"]
    assert page["stages"][0] == "topology"
    assert page["stages"][-1] == "done"


def test_the_solver_follows(page: dict[str, Any]) -> None:
    free = np.setdiff1d(page["inside"], page["boundary"])
    for name in ("second", "third"):
        assert page[name].converged
        assert abs(radius(page[name].vertices[free]) - 1.02).max() < 5e-5
    assert page["second"].iterations <= 5


def test_the_soap_film_is_a_catenoid(page: dict[str, Any]) -> None:
    assert page["film"].converged
    c = 0.9
    for _ in range(100):  # c cosh(1/(3c)) = 1
        c = 1 / np.cosh(1 / (3 * c))
    assert abs(c - 0.9403) < 1e-4
    assert abs(page["waist"] - c) < 1e-3


def test_the_measures(page: dict[str, Any]) -> None:
    inner = np.abs(page["original"][:, 2]) < 0.9
    assert abs(page["curvature"][inner] + 0.5).max() < 2e-3
    outward = page["original"] * [1, 1, 0]
    assert abs(page["unit"] - outward).max() < 1e-2
    assert len(page["loops"]) == 2
    assert page["stretch"].min() >= 1
    sums = np.bincount(page["row"], page["value"])
    assert abs(sums).max() < 1e-9


def test_every_code_of_the_engine_is_listed() -> None:
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    assert [code for code in fairing.results.CODES if f"| `{code}` |" not in text] == []


def test_the_readme_runs() -> None:
    names = run("README.md")
    assert names["result"].converged
    assert abs(radius(names["result"].vertices) - 1).max() < 5e-5
    assert names["hole"].converged
    assert abs(radius(names["hole"].vertices) - 1).max() < 5e-3
