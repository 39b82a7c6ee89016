"""The notebooks of examples/notebooks, cell by cell, and what they claim; the libraries they need are the real ones."""

import json
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "notebooks"


def run(name: str) -> dict[str, Any]:
    """The names that its cells leave behind. They run as in a notebook, where functions are __main__'s."""
    cells = json.loads((FOLDER / f"{name}.ipynb").read_text(encoding="utf-8"))["cells"]
    names: dict[str, Any] = {"__name__": "__main__"}
    for number, cell in enumerate(cells):
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [], "results of a run are no part of the repository"
            exec(compile("".join(cell["source"]), f"{name}.ipynb, cell {number}", "exec"), names)
    return names


def test_holes() -> None:
    pytest.importorskip("trimesh")
    names = run("holes")
    assert names["result"].converged and names["whole"].is_watertight
    assert len(names["result"].loops) == 3
    assert names["off"] < 1e-3
    assert names["difference"].mean() < 10


def test_part() -> None:
    pytest.importorskip("trimesh")
    names = run("part")
    off = names["off_the_wall"]
    assert off(names["bumpy"]) > 0.1
    assert off(names["mesh"][0]) < 0.01 and off(names["curved"][0]) < 0.01
    assert 0.001 < off(names["skin"][0]) < 0.03


@pytest.mark.filterwarnings("default")  # of the scheduler about its own processes
def test_cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setenv("MESHES", "12")
    names = run("cluster")
    assert [report["seed"] for report in names["reports"]] == list(range(12))
    assert names["verdicts"].count("good") > 6
    assert all(report["off"] < 1e-3 for report in names["good"])
