"""Each row of scripts/mutants.toml fits the tree: its text is there once, and so are its tests."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROWS = tomllib.loads((ROOT / "scripts" / "mutants.toml").read_text(encoding="utf-8"))["mutant"]
CASES = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests" / "native").glob("*.cpp"))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_a_row_fits_the_tree(row: dict) -> None:
    assert (ROOT / row["file"]).read_text(encoding="utf-8").count(row["find"]) == 1
    assert row["caught_by"]
    for test in row["caught_by"]:
        assert exists(test), test


def exists(test: str) -> bool:
    """Whether there is a C++ case or a Python test of that name."""
    if test.startswith("unit: "):
        name = re.escape(test.removeprefix("unit: "))
        return re.search(rf'TEST_CASE\(\s*"{name}"', CASES) is not None
    path, _, name = test.partition("::")
    text = (ROOT / path).read_text(encoding="utf-8")
    return not name or f"def {name.partition('[')[0]}(" in text
